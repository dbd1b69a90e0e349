// Timed runs of scenes: the detectors, medians over repetitions, ratios of runs that took turns; and the
// contacts that a detector overlooks, in scenes without bounces, so that all detectors watch one motion.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "research/rivals/rivals.hpp"
#include "scenes/named_detector.hpp"
#include "simulation/detector/detector.hpp"
#include "simulation/run/run_scene.hpp"
#include "simulation/scene/make_scene.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere::program {

NamedDetector paper_engine(const PaperOptions& options = {});
NamedDetector hubbard_engine();
NamedDetector hayward_engine();
NamedDetector fixed_step_engine(double step);
NamedDetector world_engine();
/// Returns the default engine with a sensor of this distance (length) on every body.
NamedDetector alarm_engine(double distance);

/// Returns the CPU time of this process so far (seconds).
double cpu_seconds();

/// One simulation, in CPU time of this process.
struct Run {
  SceneResult result;
  double preparing = 0.0;     ///< seconds until all bodies are in and the clock stands at the start
  double simulating = 0.0;    ///< seconds from there to the end
  DetectorCounters prepared;  ///< counters when the clock began to move

  double per_simulated_second() const { return simulating / result.simulated_time; }
  /// Returns the increase of the counter while the clock was moving.
  std::uint64_t count(std::uint64_t DetectorCounters::*counter) const {
    return result.counters.*counter - prepared.*counter;
  }
};

/// A median with its error bar: the first and the third quartile; of three values, the least and the largest.
struct Spread {
  double median, low, high;
};
/// Returns the spread of the values. Precondition: there is at least one.
Spread spread(std::vector<double> values);

/// The runs of one detector, on scenes shared with other detectors.
struct Series {
  std::vector<Run> runs;

  double per_simulated_second() const { return spread().median; }
  Spread spread() const;     ///< spread over the runs (seconds per simulated second)
  double preparing() const;  ///< median over the runs
  /// Returns the result of the first run, which is that of the first scene.
  const SceneResult& result() const { return runs.front().result; }
  std::uint64_t contacts() const;  ///< contacts of bodies and walls, in the first run
  std::string hash() const;        ///< event hash of the first run
};

double median(std::vector<double> values);
/// Returns the quotient of times of the two series, over runs that took turns.
Spread ratio(const Series& series, const Series& other);

/// Runs every detector on every scene, `repetitions` times, in turns, so that a busy machine slows all alike.
/// Returns one series for each detector. Throws ProgramError.
std::vector<Series> measure(const std::vector<NamedDetector>& detectors, const std::vector<Scene>& scenes,
                            int repetitions);

/// Returns scenes that differ by their seed alone: 1 ... `seeds`.
std::vector<Scene> seeded_scenes(SceneParameters parameters, std::uint64_t seeds);
/// Returns the paper's first experiment (section 4.2).
SceneParameters first_experiment(std::uint32_t bodies, double seconds);
/// Returns the paper's second experiment (section 4.3).
SceneParameters second_experiment(std::uint32_t bodies, double seconds);

/// Number of contacts of each pair, or of each body (twice) and wall.
using ContactCounts = std::map<std::tuple<std::uint32_t, std::uint32_t, Wall>, std::uint64_t>;

/// Runs the scene and counts its contacts. Throws ProgramError.
ContactCounts count_contacts(const Scene& scene, const DetectorMaker& make);

/// Returns the contacts of two bodies alone, or of a body and a wall alone.
ContactCounts body_contacts(const ContactCounts& counts);
ContactCounts wall_contacts(const ContactCounts& counts);
std::uint64_t total(const ContactCounts& counts);
/// Returns the number of contacts in `truth` that are not in `seen`.
std::uint64_t missed(const ContactCounts& truth, const ContactCounts& seen);

}  // namespace kinesphere::program
