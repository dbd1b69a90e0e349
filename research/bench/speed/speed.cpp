#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/program_error.hpp"
#include "base/standard_output.hpp"
#include "research/bench/commands.hpp"
#include "research/bench/measurement.hpp"
#include "research/bench/speed/bullet_kernel.hpp"
#include "research/bench/speed/contest.hpp"
#include "research/bench/speed/threads.hpp"

namespace kinesphere::program {
namespace {

Cell cell(const std::optional<double>& value, double scale = 1.0) {
  return value ? Cell(scale * *value) : Cell();
}

const std::vector<std::string> columns{
    "scene",          "n",          "detector", "rate",     "us",       "total_100ns",
    "total_1us",      "total_10us", "to_world", "moves",    "contacts", "per_cpu_second",
    "missed_percent", "bytes",      "build_s",  "settings", "hash"};

void add_row(ResultTable& table, const SpeedScene& scene, const SpeedRow& row) {
  table.row({scene.name, std::uint64_t{scene.bodies}, row.detector, cell(row.rate),
             1e6 * row.total(move_prices[0]), 1e6 * row.total(move_prices[1]),
             1e6 * row.total(move_prices[2]), 1e6 * row.total(move_prices[3]), row.to_world(), row.moves,
             cell(row.contacts), cell(row.contacts, 1.0 / row.detection), cell(row.missed, 100.0),
             cell(row.bytes), cell(row.building), row.settings, fmt::format("{:016x}", row.hash)});
}

void explain(const Report& report, const SpeedSettings& settings) {
  report.note(fmt::format(
      "Effort {}. \"us\" is CPU time for detection alone, in microseconds for a sphere and a simulated "
      "second: the default engine (world) gets the answers of its probes, and the kicks, from a run that was "
      "written down before; fixed-step detectors look at recorded steps. \"total\" adds what moving costs, "
      "at so much for each probe or step (\"moves\", per body-second). Medians of {} turns; \"to world\" is "
      "the median ratio to the default engine in the same turn.",
      settings.name, settings.repetitions));
  report.note(
      "tuned: the fastest of several grids and Verlet lists for this scene and rate (\"settings\"), which "
      "sees overlaps at steps; swept: the same, with a test along the straight ways between steps. "
      "\"missed percent\": contacts that are overlooked in the same scene without bounces (bullets: those of "
      "bullets). "
      "\"contacts\" are those of a body-second, \"per cpu second\" those that are found in a second of this "
      "machine.");
  if (!make_bullet_kernel({}))
    report.note("Bullet is left out: it was not installed when this program was built (libbullet-dev).");
}

void bench_threads(const BenchOptions& options, const std::vector<SpeedScene>& scenes,
                   const SpeedSettings& settings, const Report& report) {
  report.note(fmt::format(
      "Effort {}. Seconds of real time for whole simulations, motion and response included, from when all "
      "bodies are in: a loop over advance(), World::run on one thread, and on {}. They take turns; medians "
      "of {} turns. \"cpu_to_one\": the CPU time of all threads to that of one.",
      settings.name, *options.threads, settings.repetitions));
  ResultTable table({"scene", "n", "threads", "loop_s", "one_s", "many_s", "one_to_loop", "one_to_many",
                     "cpu_to_one", "events", "hash"});
  std::vector<ThreadsRow> rows;
  for (const SpeedScene& scene : scenes) {
    const bool usual = scene.name == "dense-100000" || scene.name == "dense-1000000" || scene.name == "crowd";
    if (options.only.empty() ? usual : options.has(scene.name))
      rows.push_back(compare_threads(scene, *options.threads, settings));
  }
  if (options.has(shooting_name)) rows.push_back(compare_threads_in_game(*options.threads, settings));
  for (const ThreadsRow& row : rows) {
    using Turn = const ThreadsTurn&;
    table.row({row.scene, std::uint64_t{row.bodies}, static_cast<std::uint64_t>(row.threads),
               row.median_of([](Turn turn) { return turn.loop; }),
               row.median_of([](Turn turn) { return turn.one; }),
               row.median_of([](Turn turn) { return turn.many; }),
               row.median_of([](Turn turn) { return turn.one / turn.loop; }),
               row.median_of([](Turn turn) { return turn.one / turn.many; }),
               row.median_of([](Turn turn) { return turn.many_cpu / turn.one_cpu; }), row.events,
               fmt::format("{:016x}", row.hash)});
  }
  report.table("threads", table);
}

void bench_speed(const BenchOptions& options, const Report& report) {
  const SpeedSettings& settings = speed_settings(options.effort());
  const std::vector<SpeedScene> scenes = speed_scenes(settings);
  if (options.threads) return bench_threads(options, scenes, settings, report);
  explain(report, settings);
  ResultTable all(columns);
  for (const SpeedScene& scene : scenes) {
    if (!options.has(scene.name)) continue;
    report.heading(fmt::format("{}, {} bodies", scene.name, scene.bodies));
    const std::vector<SpeedRow> rows = compare_speed(scene, settings);
    ResultTable table(columns);
    for (const SpeedRow& row : rows) {
      add_row(table, scene, row);
      add_row(all, scene, row);
    }
    print("{}\n", table.text());
    report.save("speed", all);  // results so far; the rest may take long
  }
}

}  // namespace

Command add_speed(CLI::App& app) {
  return add_benchmark(app, {.name = "speed",
                             .description = "Compare with fixed steps and others; takes half an hour",
                             .full_description = "Up to a million bodies; takes an hour",
                             .parts = names_of_parts(speed_scenes(speed_settings(Effort::full))),
                             .run = bench_speed,
                             .threads_part = shooting_name});
}

}  // namespace kinesphere::program
