#include "research/bench/speed/tuning.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "research/bench/measurement.hpp"
#include "research/bench/speed/bullet_kernel.hpp"
#include "research/bench/speed/step_kernel.hpp"

namespace kinesphere::program {
namespace {

/// Edges of strips and skins that are tried, as parts of the mean distance of spheres. More candidates find
/// faster settings and take longer.
constexpr double row_edges[] = {0.8, 1.25, 2.0, 3.2};
constexpr double skin_parts[] = {0.003, 0.01, 0.03, 0.1, 0.2, 0.4};
constexpr float steps_ahead[] = {0.0f, 5.0f, 10.0f, 20.0f, 40.0f};  ///< values of VerletSettings::steps
constexpr double bullet_margins[] = {0.003, 0.01, 0.03, 0.1, 0.2};
constexpr double column_part = 0.2;  ///< column edge, as a part of the row edge

/// Steps of a trial: at least this many, enough for a few rebuilds of a list.
constexpr std::size_t least_trial = 40;
constexpr std::size_t trial_part = 4;

StripSettings strips(double row_edge, StripOrder order) {
  return {static_cast<float>(row_edge), static_cast<float>(column_part * row_edge), order};
}

double mean_distance_in(const StepRecording& recording) {
  std::vector<State> states;
  const Frame start = recording.frame(0);
  for (std::size_t at = 0; at < recording.radii.size(); ++at)
    states.push_back({{start.x[at], start.y[at], start.z[at]}, {}});
  return mean_distance(states);
}

/// Returns the mean way of a sphere in a step (length).
double mean_move_in(const StepRecording& recording) {
  const Frame start = recording.frame(0), next = recording.frame(1);
  double moved = 0.0;
  for (std::size_t at = 0; at < recording.radii.size(); ++at) {
    moved += std::hypot(static_cast<double>(next.x[at] - start.x[at]),
                        static_cast<double>(next.y[at] - start.y[at]),
                        static_cast<double>(next.z[at] - start.z[at]));
  }
  return moved / static_cast<double>(recording.radii.size());
}

/// Tries kernels and keeps the maker of the fastest.
struct Candidates {
  const StepRecording& recording;
  std::size_t steps;
  double least = std::numeric_limits<double>::infinity();
  KernelMaker best{};

  explicit Candidates(const StepRecording& steps_to_try)
      : recording(steps_to_try),
        steps(std::min(recording.steps(), std::max(least_trial, recording.steps() / trial_part))) {}

  bool try_out(const KernelMaker& make) {
    const double seconds = time_steps(recording, *make(), steps).seconds;
    if (seconds >= least) return false;
    least = seconds;
    best = make;
    return true;
  }
};

std::uint64_t mixed(std::uint64_t step, std::uint64_t a, std::uint64_t b) {
  std::uint64_t word = (step << 40) ^ (std::min(a, b) << 20) ^ std::max(a, b);
  word = (word ^ (word >> 30)) * 0xbf58476d1ce4e5b9u;
  word = (word ^ (word >> 27)) * 0x94d049bb133111ebu;
  return word ^ (word >> 31);
}

}  // namespace

double mean_distance(const std::vector<State>& states) {
  double volume = 1.0;
  int axes = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [least, largest] = std::minmax_element(
        states.begin(), states.end(),
        [axis](const State& a, const State& b) { return a.position[axis] < b.position[axis]; });
    const double extent = largest->position[axis] - least->position[axis];
    if (!(extent > 0.0)) continue;
    volume *= extent;
    ++axes;
  }
  if (axes == 0) return 1.0;
  return std::pow(volume / static_cast<double>(states.size()), 1.0 / axes);
}

StripSettings usual_strips(double mean_distance) { return strips(2.0 * mean_distance, StripOrder::smaller); }

StepTiming time_steps(const StepRecording& recording, StepKernel& kernel, std::size_t steps) {
  std::vector<SpherePair> touching;
  std::vector<std::uint32_t> at_walls;
  std::vector<std::size_t> pair_ends, wall_ends;  // by step
  const double begin = cpu_seconds();
  for (std::size_t step = 1; step <= steps; ++step) {
    const Frame now = recording.frame(step);
    kernel.look(step == 1 ? now : recording.frame(step - 1), now, touching);
    if (recording.box) find_at_walls(now, recording.radii, *recording.box, at_walls);
    pair_ends.push_back(touching.size());
    wall_ends.push_back(at_walls.size());
  }
  StepTiming timing{
      .seconds = cpu_seconds() - begin, .found = touching.size() + at_walls.size(), .bytes = kernel.bytes()};
  std::size_t pair = 0, wall = 0;
  for (std::size_t step = 0; step < steps; ++step) {
    for (; pair < pair_ends[step]; ++pair)
      timing.hash += mixed(step, touching[pair].first, touching[pair].second);
    for (; wall < wall_ends[step]; ++wall) timing.hash += mixed(step, at_walls[wall], at_walls[wall]);
  }
  return timing;
}

KernelMaker tuned_kernel(const StepRecording& recording) {
  Candidates candidates(recording);
  const double distance = mean_distance_in(recording);
  const double move = mean_move_in(recording);
  const auto& radii = recording.radii;
  const SphereTest test = recording.test;
  StripSettings best = usual_strips(distance);
  for (const double edge : row_edges) {
    for (const StripOrder order : {StripOrder::smaller, StripOrder::forward}) {
      const StripSettings settings = strips(edge * distance, order);
      if (candidates.try_out([=, &radii] { return make_grid_kernel(radii, settings, test); }))
        best = settings;
    }
  }
  for (const double part : skin_parts) {
    for (const float ahead : steps_ahead) {
      // Skins that reach beyond the next neighbours make lists too long to be the fastest.
      if (part * distance + static_cast<double>(ahead) * move > distance) continue;
      const VerletSettings settings{best, static_cast<float>(part * distance), ahead};
      candidates.try_out([=, &radii] { return make_verlet_kernel(radii, settings, test); });
    }
  }
  return candidates.best;
}

KernelMaker tuned_bullet_kernel(const StepRecording& recording) {
  const auto& radii = recording.radii;
  if (!make_bullet_kernel({})) return {};
  Candidates candidates(recording);
  for (const double part : bullet_margins) {
    const auto margin = static_cast<float>(part * mean_distance_in(recording));
    candidates.try_out([=, &radii] { return make_bullet_kernel(radii, margin); });
  }
  return candidates.best;
}

}  // namespace kinesphere::program
