// One scene, all detectors: they take turns, so that a busy machine is as bad for one as for the others.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "research/bench/speed/speed_scenes.hpp"

namespace kinesphere::program {

/// What a move costs, a probe or a step (seconds), in the tables.
constexpr double move_prices[] = {0.0, 100e-9, 1e-6, 10e-6};

/// What a detector and the default engine took one after the other (seconds for a body-second).
struct Turn {
  double own;
  double world;
};

/// What a detector took for a scene. Times are CPU time.
struct SpeedRow {
  std::string detector;
  std::string settings;        ///< the fastest of those tried
  std::optional<double> rate;  ///< of fixed steps
  double detection = 0.0;      ///< seconds for a body-second, without motion and response; the median
  std::vector<Turn> turns{};
  double moves = 0.0;                ///< probes, or steps, in a body-second
  std::optional<double> to_floor{};  ///< probes to the probe floor
  std::optional<double> contacts{};  ///< in a body-second
  std::optional<double> missed{};    ///< part of the contacts that count (SpeedScene), where all pass through
  std::optional<double> bytes{};     ///< for each body
  std::optional<double> building{};  ///< seconds until all bodies are in
  std::uint64_t hash = 0;            ///< of what was found

  /// Seconds for a body-second when a move costs `price` seconds.
  double total(double price) const { return detection + price * moves; }
  /// How many times what the default engine, whose row is `world`, takes in total: the median of the turns.
  double to_world(const SpeedRow& world, double price = 0.0) const;
};

/// By scene.
using SpeedResults = std::map<std::string, std::vector<SpeedRow>>;

/// The row of this detector at this rate; null when it did not take part.
const SpeedRow* find_row(const std::vector<SpeedRow>& rows, const std::string& detector,
                         std::optional<double> rate = std::nullopt);

/// Of the slowest steps of this detector that miss nothing; null when there are none.
const SpeedRow* find_slowest_safe(const std::vector<SpeedRow>& rows, const std::string& detector);

/// The default engine first. Throws ProgramError.
std::vector<SpeedRow> compare_speed(const SpeedScene& scene, const SpeedSettings& settings);

}  // namespace kinesphere::program
