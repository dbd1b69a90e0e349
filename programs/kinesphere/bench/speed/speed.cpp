#include "bench/speed/speed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "bench/report.hpp"
#include "bench/speed/contest.hpp"
#include "bench/speed/tree_kernels.hpp"
#include "program_error.hpp"

namespace kinesphere::program {
namespace {

/// What a motion step or probe may cost (seconds).
constexpr double prices[] = {0.0, 100e-9, 1e-6, 10e-6};

using Results = std::map<std::string, std::vector<SpeedRow>>;

Cell cell(const std::optional<double>& value, double scale = 1.0) {
  return value ? Cell(scale * *value) : Cell();
}

const std::vector<std::string> columns{
    "scene",      "n",        "detector", "rate",     "us",       "total_100ns",    "total_1us",
    "total_10us", "to_world", "moves",    "to_floor", "contacts", "per_cpu_second", "missed_percent",
    "bytes",      "build_s",  "settings", "hash"};

void add_row(ResultTable& table, const SpeedScene& scene, const SpeedRow& row) {
  table.row({scene.name, std::uint64_t{scene.bodies}, row.detector, cell(row.rate),
             1e6 * row.total(prices[0]), 1e6 * row.total(prices[1]), 1e6 * row.total(prices[2]),
             1e6 * row.total(prices[3]), row.to_world, row.moves, cell(row.to_floor), cell(row.contacts),
             cell(row.contacts, 1.0 / row.detection), cell(row.missed, 100.0), cell(row.bytes),
             cell(row.building), row.settings, fmt::format("{:016x}", row.hash)});
}

/// The row of this detector at this rate, if it took part.
const SpeedRow* find(const std::vector<SpeedRow>& rows, const std::string& detector,
                     std::optional<double> rate = std::nullopt) {
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const SpeedRow& one) {
    return one.detector == detector && one.rate == rate;
  });
  return row == rows.end() ? nullptr : &*row;
}

Cell microseconds(const SpeedRow* row, double price = 0.0) {
  return row != nullptr ? Cell(1e6 * row->total(price)) : Cell();
}

constexpr double plotted_rates[] = {60.0, 240.0, 1000.0};

void plot_over_n(const Report& report, const std::vector<SpeedScene>& scenes, const Results& results) {
  ResultTable table({"n", "world", "tuned_60", "tuned_240", "tuned_1000"});
  for (const SpeedScene& scene : scenes) {
    const auto found = results.find(scene.name);
    if (found == results.end() || (scene.name != "paper1-1000" && !scene.name.starts_with("dense-")))
      continue;
    std::vector<Cell> row{std::uint64_t{scene.bodies}, microseconds(find(found->second, "world"))};
    for (const double rate : plotted_rates) row.push_back(microseconds(find(found->second, "tuned", rate)));
    table.row(std::move(row));
  }
  report.table("over_n", table);
  report.plot({.name = "over_n",
               .table = "over_n",
               .title = "Detection, spheres as dense as 1000 in the paper''s box",
               .y_label = "microseconds per sphere and simulated second",
               .logarithmic = true,
               .curves = {{"world", "default engine"},
                          {"tuned_60", "tuned, 60 steps a second"},
                          {"tuned_240", "240"},
                          {"tuned_1000", "1000"}}});
}

void plot_over_rate(const Report& report, const std::vector<SpeedRow>& rows) {
  ResultTable table({"rate", "tuned", "swept", "bullet", "fcl", "world"});
  for (const double rate : plotted_rates) {
    std::vector<Cell> row{rate};
    for (const char* name : {"tuned", "swept", "bullet", "fcl"})
      row.push_back(microseconds(find(rows, name, rate)));
    row.push_back(microseconds(find(rows, "world")));
    table.row(std::move(row));
  }
  report.table("over_rate", table);
  report.plot({.name = "over_rate",
               .table = "over_rate",
               .title = "Detection, the paper''s first scene, 1000 spheres",
               .x_column = "rate",
               .x_label = "steps per simulated second",
               .y_label = "microseconds per sphere and simulated second",
               .logarithmic = true,
               .curves = {{"world", "default engine (no steps)"},
                          {"tuned", "tuned"},
                          {"swept", "tuned, swept"},
                          {"bullet", "Bullet"},
                          {"fcl", "FCL"}}});
}

void plot_over_price(const Report& report, const std::vector<SpeedRow>& rows) {
  ResultTable table({"price_ns", "world", "tuned_60", "tuned_240", "tuned_1000"});
  for (const double price : {1e-9, 3e-9, 10e-9, 30e-9, 100e-9, 300e-9, 1e-6, 3e-6, 10e-6}) {
    std::vector<Cell> row{1e9 * price, microseconds(find(rows, "world"), price)};
    for (const double rate : plotted_rates) row.push_back(microseconds(find(rows, "tuned", rate), price));
    table.row(std::move(row));
  }
  report.table("over_price", table);
  report.plot({.name = "over_price",
               .table = "over_price",
               .title = "Detection and motion, the paper''s first scene, 1000 spheres",
               .x_column = "price_ns",
               .x_label = "ns per motion step or probe",
               .y_label = "microseconds per sphere and simulated second",
               .logarithmic = true,
               .curves = {{"world", "default engine"},
                          {"tuned_60", "tuned, 60 steps a second"},
                          {"tuned_240", "240"},
                          {"tuned_1000", "1000"}}});
}

std::vector<std::string> names_of(const std::vector<SpeedScene>& scenes) {
  std::vector<std::string> names;
  for (const SpeedScene& scene : scenes) names.push_back(scene.name);
  return names;
}

void explain(const Report& report, const SpeedSettings& settings) {
  report.note(fmt::format(
      "Effort {}. \"us\" is CPU time for detection alone, in microseconds for a sphere and a simulated "
      "second: event-driven detectors get the answers of their probes, and the kicks, from a run that was "
      "written down before; fixed-step detectors look at recorded steps. \"total\" adds what moving costs, "
      "at "
      "so much for each probe or step (\"moves\", per body-second). Medians of {} turns; \"to world\" is "
      "the median ratio to the default engine in the same turn.",
      settings.name, settings.repetitions));
  report.note(
      "tuned: the fastest of several grids and Verlet lists for this scene and rate (\"settings\"), which "
      "sees "
      "overlaps at steps; swept: the same, with a test along the straight ways between steps. \"to floor\": "
      "probes "
      "to the least that a method that knew all other motion would need. \"missed percent\": contacts that "
      "are "
      "overlooked in the same scene without bounces. \"contacts\" are those of a body-second, \"per cpu "
      "second\" "
      "those that are found in a second of this machine.");
  if (!make_bullet_kernel({}))
    report.note("Bullet is left out: it was not installed when this program was built (libbullet-dev).");
  if (!make_fcl_kernel({}))
    report.note("FCL is left out: it was not installed when this program was built (libfcl-dev).");
}

}  // namespace

void add_bench_speed_command(CLI::App& bench, BenchOptions& options) {
  CLI::App* speed = bench.add_subcommand("speed", "Compare with fixed steps and others; takes minutes");
  add_bench_options(*speed, options, names_of(speed_scenes(speed_settings(Effort::full))),
                    "Up to a million bodies; takes an hour");
}

int bench_speed(const BenchOptions& options) {
  const SpeedSettings& settings = speed_settings(effort_of(options));
  const std::vector<SpeedScene> scenes = speed_scenes(settings);
  check_bench_options(options, names_of(scenes));
  const Report report(options.output);
  describe_machine(report);
  explain(report, settings);
  Results results;
  ResultTable all(columns);
  for (const SpeedScene& scene : scenes) {
    if (!is_chosen(options, scene.name)) continue;
    report.heading(fmt::format("{}, {} bodies", scene.name, scene.bodies));
    const std::vector<SpeedRow>& rows = results[scene.name] = compare_speed(scene, settings);
    ResultTable table(columns);
    for (const SpeedRow& row : rows) {
      add_row(table, scene, row);
      add_row(all, scene, row);
    }
    fmt::print("{}\n", table.text());
    report.save("speed", all);  // as far as it is known: the rest may take long
  }
  plot_over_n(report, scenes, results);
  if (const auto found = results.find("paper1-1000"); found != results.end()) {
    plot_over_rate(report, found->second);
    plot_over_price(report, found->second);
  }
  return exit_fine;
}

}  // namespace kinesphere::program
