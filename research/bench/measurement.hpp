// Timed runs of scenes: medians over repetitions, ratios of runs that took turns.
#pragma once

#include <string>
#include <vector>

#include "research/bench/detectors.hpp"
#include "simulation/run/simulate.hpp"
#include "simulation/scene/make_scene.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere::program {

/// CPU time of this process so far.
double cpu_seconds();

/// One simulation, in CPU time of this process.
struct Run {
  SimulationResult result;
  double preparing = 0.0;     ///< seconds until all bodies are in and the clock stands at the start
  double simulating = 0.0;    ///< seconds from there to the end
  DetectorCounters prepared;  ///< as they were when the clock began to move

  double per_simulated_second() const { return simulating / result.simulated_time; }
  /// How much the counter went up while the clock was moving.
  std::uint64_t count(std::uint64_t DetectorCounters::*counter) const {
    return result.counters.*counter - prepared.*counter;
  }
};

/// A median with its error bar: the first and the third quartile, of three values the least and the largest.
struct Spread {
  double median, low, high;
};
/// Expects at least one value.
Spread spread(std::vector<double> values);

/// What one detector took for the same work as the others.
struct Series {
  std::vector<Run> runs;

  double per_simulated_second() const { return spread().median; }
  Spread spread() const;     ///< of the runs (seconds per simulated second)
  double preparing() const;  ///< median of the runs
  /// Of the first run: of the first scene, that is.
  const SimulationResult& result() const { return runs.front().result; }
  std::uint64_t contacts() const;  ///< of bodies and walls, in the first run
  std::string hash() const;        ///< of all that the first run reported
};

double median(std::vector<double> values);
/// How many times as long as `other`, over runs that took turns.
Spread ratio(const Series& series, const Series& other);

/// Every detector on every scene, `repetitions` times, in turns, so that a busy machine is as bad for one as
/// for the others. The answer has one series for each detector. Throws ProgramError.
std::vector<Series> measure(const std::vector<NamedDetector>& detectors, const std::vector<Scene>& scenes,
                            int repetitions);

/// Scenes that differ by their seed alone: 1 ... `seeds`.
std::vector<Scene> seeded_scenes(SceneParameters parameters, std::uint64_t seeds);
/// The paper's first experiment (section 4.2).
SceneParameters first_experiment(std::uint32_t bodies, double seconds);
/// Its second one (section 4.3).
SceneParameters second_experiment(std::uint32_t bodies, double seconds);

}  // namespace kinesphere::program
