#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/program_error.hpp"
#include "research/bench/benchmark.hpp"
#include "research/bench/commands.hpp"
#include "research/bench/measurement.hpp"
#include "research/measures/gas_properties.hpp"
#include "scenes/scene_file.hpp"

namespace kinesphere::program {
namespace {

struct GasSettings {
  std::uint32_t bodies;
  double contacts;  ///< approximate number measured at each packing
};

/// A fifth of the run lets the gas forget its start: at least 100 collisions of each sphere. Shorter
/// equilibration biases the result, longer measurement narrows its error.
constexpr GasBlocks blocks{.equilibration = 10, .measured = 40};

const GasSettings& gas_settings(Effort effort) {
  static constexpr GasSettings quick{100, 2e3};
  static constexpr GasSettings usual{4000, 1e6};
  static constexpr GasSettings full{4000, 1e7};
  return chosen(effort, quick, usual, full);
}

/// Packings (percent).
constexpr int packings[] = {5, 10, 15, 20, 25, 30, 35, 40, 45, 49};

std::vector<std::string> names() {
  std::vector<std::string> names;
  for (const int percent : packings) names.push_back(std::to_string(percent));
  return names;
}

/// Makes a gas that runs long enough for the contacts of the settings.
Scene make_gas(double packing, const GasSettings& settings) {
  SceneParameters gas = find_scene("periodic_gas").parameters;
  gas.bodies = settings.bodies;
  gas.packing = packing;
  const double contacts_per_time = 0.5 * settings.bodies * hard_sphere_collision_rate(packing);
  const double part = static_cast<double>(blocks.measured) / (blocks.equilibration + blocks.measured);
  gas.seconds = settings.contacts / part / contacts_per_time;
  return require(make_scene(gas));
}

/// Deviation of an estimate from theory, and its standard error.
struct Deviation {
  Deviation(const Estimate& estimate, double theory)
      : percent(100.0 * (estimate.value / theory - 1.0)),
        error_percent(100.0 * estimate.standard_error / theory) {}

  double percent;
  double error_percent;
};

const std::vector<std::string> columns{"packing",
                                       "contacts",
                                       "Z",
                                       "Z_theory",
                                       "Z_off",
                                       "Z_error",
                                       "rate",
                                       "rate_theory",
                                       "rate_off",
                                       "rate_error",
                                       "energy_change",
                                       "momentum_change",
                                       "contacts_per_cpu_second"};

/// Adds a row and returns the larger of its two deviations, in percent.
double add_row(ResultTable& table, int percent, const GasSettings& settings) {
  const double packing = 0.01 * percent;
  const Scene scene = make_gas(packing, settings);
  const double begin = cpu_seconds();
  const GasProperties gas = require(measure_gas(scene, make_world_detector, blocks));
  const double seconds = cpu_seconds() - begin;
  const double z = hard_sphere_compressibility(packing);
  const double rate = hard_sphere_collision_rate(packing);
  const Deviation z_off(gas.compressibility, z);
  const Deviation rate_off(gas.collision_rate, rate);
  const auto all_contacts = static_cast<double>(gas.result.counters.count(EventKind::contact_begin));
  table.row({static_cast<std::uint64_t>(percent), gas.contacts, gas.compressibility.value, z, z_off.percent,
             z_off.error_percent, gas.collision_rate.value, rate, rate_off.percent, rate_off.error_percent,
             gas.energy_change, gas.momentum_change, all_contacts / seconds});
  return std::max(std::abs(z_off.percent), std::abs(rate_off.percent));
}

void bench_gas(const BenchOptions& options, const Report& report) {
  const GasSettings& settings = gas_settings(options.effort());
  report.note(fmt::format(
      "{} equal spheres that bounce without loss where space repeats, in units of their diameter, mass and "
      "temperature: Z = p V / (N k T), from the virial, and the rate, collisions of each sphere per unit of "
      "time. Theory is the equation of state of Kolafa, Labik and Malijevsky (2004) and the rate that "
      "belongs to it, 6 (Z - 1) / sqrt(pi). Packing, \"off\" (deviation from theory) and \"error\" "
      "(standard error) are in percent. Changes of energy and momentum are the largest of the run, as parts "
      "of the energy and of N sqrt(m k T).",
      settings.bodies));
  ResultTable table(columns);
  double largest = 0.0;
  for (const int percent : packings) {
    if (!options.has(std::to_string(percent))) continue;
    largest = std::max(largest, add_row(table, percent, settings));
  }
  report.table("gas", table);
  report.note(fmt::format("The largest deviation is {:.2f} %.", largest));
}

}  // namespace

Command add_gas(CLI::App& app) {
  return add_benchmark(
      app, {.name = "gas",
            .description = "Collision rate and pressure of hard spheres, against theory; takes minutes",
            .full_description = "Ten times as many collisions",
            .parts = names(),
            .run = bench_gas});
}

}  // namespace kinesphere::program
