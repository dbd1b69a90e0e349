#include <fmt/format.h>
#include <CLI/App.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "archive/checksum.hpp"
#include "base/program_error.hpp"
#include "base/standard_output.hpp"
#include "base/validators.hpp"
#include "kinesphere/approaches.hpp"
#include "kinesphere/workers.hpp"
#include "research/bench/arcs.hpp"
#include "research/bench/commands.hpp"
#include "research/bench/measurement.hpp"
#include "research/bench/report.hpp"
#include "research/measures/peak_memory.hpp"
#include "scenes/summary.hpp"

namespace kinesphere::program {
namespace {

constexpr double seconds_in_hour = 3600.0, hours_in_day = 24.0;

struct PathOptions {
  std::uint32_t satellites = 10'000;
  std::uint64_t seed = 1;
  double hours = 24.0;
  double distance = 5.0;
  int turns = 3;
};

struct Search {
  double seconds;      ///< of wall-clock time
  double cpu_seconds;  ///< of all threads
  std::size_t approaches, minima;
  double step;
  std::uint64_t hash;  ///< of times and distances of all minima
};

std::uint64_t hash_of(const Approaches& found) {
  std::vector<double> numbers;
  for (const Approaches::Minimum& minimum : found.minima) {
    numbers.push_back(minimum.time);
    numbers.push_back(minimum.distance);
  }
  return checksum(std::as_bytes(std::span(numbers)));
}

Search search(const Arcs& arcs, double distance, double end, Workers* workers) {
  const auto begin = std::chrono::steady_clock::now();
  const double cpu_begin = cpu_seconds();
  const Approaches found =
      require(Approaches::of(arcs.paths(), distance, {.end = end, .workers = workers, .progress = {}}));
  const double cpu = cpu_seconds() - cpu_begin;
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  return {spent.count(), cpu, found.approaches.size(), found.minima.size(), found.step, hash_of(found)};
}

/// Searches by one thread and by two that took turns.
struct Turns {
  std::array<std::vector<Search>, 2> searches;

  template <class Member>
  double median_of(std::size_t threads, Member Search::*member) const {
    std::vector<double> values;
    for (const Search& one : searches[threads - 1]) values.push_back(one.*member);
    return median(values);
  }
  double times_as_fast() const {
    std::vector<double> ratios;
    for (std::size_t k = 0; k < searches[0].size(); ++k)
      ratios.push_back(searches[0][k].seconds / searches[1][k].seconds);
    return median(ratios);
  }
  bool agree() const {
    const auto same = [&](const Search& one) { return one.hash == searches[0].front().hash; };
    return std::ranges::all_of(searches[0], same) && std::ranges::all_of(searches[1], same);
  }
};

Turns take_turns(const Arcs& arcs, const PathOptions& options, double end) {
  Workers two = require(Workers::create(2));
  Turns turns;
  for (int turn = 0; turn < options.turns; ++turn) {
    turns.searches[0].push_back(search(arcs, options.distance, end, nullptr));
    turns.searches[1].push_back(search(arcs, options.distance, end, &two));
  }
  return turns;
}

void print_turns(const Turns& turns, double object_days) {
  ResultTable table({"threads", "seconds", "cpu_seconds", "ms_per_object_and_day", "times_as_fast"});
  for (const std::size_t threads : {1, 2}) {
    const double cpu = turns.median_of(threads, &Search::cpu_seconds);
    table.row({std::uint64_t{threads}, turns.median_of(threads, &Search::seconds), cpu,
               1e3 * cpu / object_days, threads == 1 ? 1.0 : turns.times_as_fast()});
  }
  print("{}", table.text());
}

int bench_paths(const PathOptions& options) {
  const double seconds = options.hours * seconds_in_hour;
  const Arcs arcs = satellite_arcs(options.satellites, seconds, options.seed);
  const Turns turns = take_turns(arcs, options, seconds);
  const Search& first = turns.searches[0].front();
  print("{} objects, {} arcs of {} terms; {} h within {} km: {} approaches, {} minima, in steps of {} s\n",
        grouped(arcs.errors.size()), grouped(arcs.begins.size()), arcs.terms, options.hours, options.distance,
        grouped(first.approaches), grouped(first.minima), number(first.step));
  print_turns(turns, static_cast<double>(arcs.errors.size()) * options.hours / hours_in_day);
  print("peak memory {:.2f} GB, of which arcs {:.2f} GB; hash {:016x}\n",
        1e-9 * static_cast<double>(peak_memory()), 1e-9 * static_cast<double>(arcs.bytes()), first.hash);
  if (!turns.agree()) print("THE SEARCHES DIFFER\n");
  finish_output();
  return turns.agree() ? exit_fine : exit_disagreement;
}

}  // namespace

Command add_paths(CLI::App& app) {
  const auto options = std::make_shared<PathOptions>();
  CLI::App* const command =
      app.add_subcommand("paths", "Time the search for approaches of bodies on known paths");
  command->add_option("--satellites", options->satellites, "How many are drawn at random")
      ->check(whole_number(1'000'000, 2))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Of the satellites")
      ->check(whole_number(std::numeric_limits<std::uint64_t>::max()))
      ->capture_default_str();
  command->add_option("--hours", options->hours, "How long to search")
      ->check(finite_number() & CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--distance", options->distance, "Within which bodies approach (km)")
      ->check(finite_number() & CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--turns", options->turns, "How often each number of threads is timed")
      ->check(whole_number(1000, 1))
      ->capture_default_str();
  return {command, [options] { return bench_paths(*options); }};
}

}  // namespace kinesphere::program
