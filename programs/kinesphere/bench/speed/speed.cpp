#include "bench/speed/speed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/report.hpp"
#include "bench/speed/contest.hpp"
#include "bench/speed/speed_figures.hpp"
#include "bench/speed/tree_kernels.hpp"
#include "program_error.hpp"

namespace kinesphere::program {
namespace {

/// What a motion step or probe may cost (seconds).
constexpr double prices[] = {0.0, 100e-9, 1e-6, 10e-6};

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

/// Against the slowest fixed steps that miss no contact: how many times as much they take.
void save_verdicts(const Report& report, const std::vector<SpeedScene>& scenes, const SpeedResults& results) {
  ResultTable table({"scene", "n", "safe_detector", "safe_rate", "safe_us", "world_us", "ratio",
                     "ratio_100ns", "ratio_1us", "ratio_10us"});
  for (const SpeedScene& scene : scenes) {
    const auto rows = results.find(scene.name);
    if (rows == results.end()) continue;
    const SpeedRow& world = *find_row(rows->second, "world");
    for (const char* const name : {"tuned", "swept"}) {
      const auto safe = std::find_if(rows->second.begin(), rows->second.end(), [&](const SpeedRow& row) {
        return row.detector == name && row.missed == 0.0;
      });
      if (safe == rows->second.end()) continue;
      std::vector<Cell> row{scene.name,       std::uint64_t{scene.bodies}, std::string(name),
                            cell(safe->rate), 1e6 * safe->detection,       1e6 * world.detection};
      for (const double price : prices) row.emplace_back(safe->total(price) / world.total(price));
      table.row(std::move(row));
    }
  }
  report.note(
      "The slowest steps of those tried that miss no contact where all pass through, and how many times as "
      "much they "
      "take as the default engine, when a step or probe costs nothing, 100 ns, 1 us and 10 us.");
  report.table("verdicts", table);
}

std::vector<std::string> names_of(const std::vector<SpeedScene>& scenes) {
  std::vector<std::string> names;
  names.reserve(scenes.size());
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
  CLI::App* speed =
      bench.add_subcommand("speed", "Compare with fixed steps and others; takes a quarter of an hour");
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
  SpeedResults results;
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
  save_verdicts(report, scenes, results);
  draw_speed_figures(report, scenes, results);
  return exit_fine;
}

}  // namespace kinesphere::program
