#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "base/program_error.hpp"
#include "research/bench/benchmark.hpp"
#include "research/bench/commands.hpp"
#include "research/bench/measurement.hpp"
#include "research/measures/games.hpp"
#include "research/measures/steering.hpp"

namespace kinesphere::program {
namespace {

struct FrameSettings {
  std::vector<std::uint32_t> bodies;
  std::uint32_t frames;        ///< after those that settle
  std::uint32_t first_frames;  ///< after the start, which are counted apart
};

const FrameSettings& frame_settings(Effort effort) {
  static const FrameSettings quick{{100}, 100, 20};
  static const FrameSettings usual{{1000, 10000, 50000}, 480, 120};
  static const FrameSettings full{{1000, 10000, 50000}, 3480, 120};
  return chosen(effort, quick, usual, full);
}

struct Play {
  std::string_view name;
  double percent;  ///< of the volume that balls fill
  bool eventful;
};

constexpr Play plays[] = {
    {"thin", 0.3, false}, {"steady", 3.0, false}, {"dense", 10.0, false}, {"eventful", 3.0, true}};

constexpr std::string_view steered_part = "steered";

/// Costs of the frames of a game: times, or counts.
class FrameCosts {
 public:
  FrameCosts(std::vector<double> costs, std::size_t first_frames)
      : first_(costs.begin(), costs.begin() + static_cast<std::ptrdiff_t>(first_frames)),
        sorted_(costs.begin() + static_cast<std::ptrdiff_t>(first_frames), costs.end()) {
    std::sort(sorted_.begin(), sorted_.end());
  }
  /// Returns the least cost that this part of the frames does not exceed.
  double percentile(double part) const {
    const double rank = std::ceil(part * static_cast<double>(sorted_.size()));
    return sorted_[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
  }
  double worst_of_first() const { return *std::max_element(first_.begin(), first_.end()); }
  double mean() const {
    double sum = 0.0;
    for (const double cost : sorted_) sum += cost;
    return sum / static_cast<double>(sorted_.size());
  }

 private:
  std::vector<double> first_;
  std::vector<double> sorted_;
};

void add_costs(ResultTable& table, const Play& play, std::uint32_t bodies, const char* unit,
               const FrameCosts& costs) {
  const double median = costs.percentile(0.5);
  const double worst = costs.percentile(1.0);
  table.row({std::string(play.name), std::uint64_t{bodies}, std::string(unit), median, costs.mean(),
             costs.percentile(0.9), costs.percentile(0.99), costs.percentile(0.999), worst,
             costs.worst_of_first(), median > 0.0 ? Cell(worst / median) : Cell()});
}

/// Plays the game once and adds a row of its times, and one of its work.
void add_play(ResultTable& table, ResultTable& every_frame, const Play& play, std::uint32_t bodies,
              const FrameSettings& settings) {
  std::vector<double> seconds, work;
  std::vector<Counters> counted;
  play_game({.bodies = bodies,
             .packing = 0.01 * play.percent,
             .frames = settings.first_frames + settings.frames,
             .eventful = play.eventful},
            [&](const Counters& counters) {
              seconds.push_back(cpu_seconds());
              counted.push_back(counters);
            });
  std::vector<double> milliseconds;
  for (std::size_t k = 1; k < counted.size(); ++k) {
    const Counters& now = counted[k];
    const Counters& before = counted[k - 1];
    milliseconds.push_back(1e3 * (seconds[k] - seconds[k - 1]));
    work.push_back(estimated_work(now) - estimated_work(before));
    every_frame.row({std::string(play.name), std::uint64_t{bodies}, std::uint64_t{k}, milliseconds.back(),
                     work.back(), now.starts - before.starts, now.restarts - before.restarts,
                     now.searches - before.searches, now.candidates - before.candidates,
                     now.hot_pairs - before.hot_pairs, now.pair_checks - before.pair_checks,
                     now.wall_checks - before.wall_checks, now.probes - before.probes});
  }
  add_costs(table, play, bodies, "ms", FrameCosts(milliseconds, settings.first_frames));
  add_costs(table, play, bodies, "work", FrameCosts(work, settings.first_frames));
}

double median_frame(std::vector<double> seconds) { return FrameCosts(std::move(seconds), 1).percentile(0.5); }

/// Adds a row of a crowd in which all velocities change in each frame.
void add_steered(ResultTable& table, std::uint32_t bodies, int dimensions, std::uint32_t frames) {
  SteeringSettings settings{
      .bodies = bodies, .dimensions = dimensions, .packing = dimensions == 3 ? 0.03 : 0.1, .frames = frames};
  const double grid = median_frame(steer_grid(settings).seconds);
  const double velocities = median_frame(steer_world(settings, SteeringBy::velocities).seconds);
  const double pushed = median_frame(steer_world(settings, SteeringBy::frames).seconds);
  const double game = median_frame(steer_world(settings, SteeringBy::game).seconds);
  const double wall = median_frame(steer_world(settings, SteeringBy::velocities).wall_seconds);
  settings.threads = 2;
  const double wall_of_two = median_frame(steer_world(settings, SteeringBy::velocities).wall_seconds);
  table.row({std::uint64_t{bodies}, std::to_string(dimensions), 1e3 * grid, 1e3 * velocities, 1e3 * pushed,
             1e3 * game, velocities / grid, pushed / grid, game / velocities, wall / wall_of_two});
}

void bench_frames(const BenchOptions& options, const Report& report) {
  const FrameSettings& settings = frame_settings(options.effort());
  report.note(
      fmt::format("Games at 60 frames a second. \"ms\" is CPU time of a frame, with motion and response; "
                  "\"work\" is about a "
                  "thousand instructions, computed from the counters of the world, so it is the same "
                  "everywhere. \"first\" is the worst "
                  "of the first {} frames, which the other columns leave out.",
                  settings.first_frames));
  ResultTable table(
      {"play", "n", "unit", "median", "mean", "p90", "p99", "p999", "worst", "first", "worst_to_median"});
  ResultTable every_frame({"play", "n", "frame", "ms", "work", "starts", "restarts", "searches", "candidates",
                           "hot_pairs", "pair_checks", "wall_checks", "probes"});
  for (const Play& play : plays) {
    if (!options.has(play.name)) continue;
    for (const std::uint32_t bodies : settings.bodies) add_play(table, every_frame, play, bodies, settings);
  }
  report.table("frames", table);
  report.save("every_frame", every_frame);
  if (!options.has(steered_part)) return;
  report.note(
      "All velocities change in each frame (\"steered\"): CPU time of a median frame, in ms, of the world by "
      "set_velocities(), by push() and as a GameWorld, and of a uniform grid that looks at the end of each "
      "frame only; and how many times faster two threads are than one, by the wall.");
  ResultTable steered({"n", "dimensions", "grid", "velocities", "push", "game", "velocities_to_grid",
                       "push_to_grid", "game_to_velocities", "two_threads"});
  for (const int dimensions : {2, 3})
    for (const std::uint32_t bodies : settings.bodies)
      add_steered(steered, bodies, dimensions, settings.first_frames);
  report.table("steered", steered);
}

}  // namespace

Command add_frames(CLI::App& app) {
  std::vector<std::string> parts = names_of_parts(plays);
  parts.emplace_back(steered_part);
  return add_benchmark(
      app, {.name = "frames",
            .description = "What the frames of a game cost: the median, and the worst; takes minutes",
            .full_description = "A minute of each game, not ten seconds",
            .parts = std::move(parts),
            .run = bench_frames});
}

}  // namespace kinesphere::program
