// One scene, all detectors: they take turns, so that a busy machine is as bad for one as for the others.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/speed/speed_scenes.hpp"

namespace kinesphere::program {

/// What a detector took for a scene. Times are CPU time.
struct SpeedRow {
  std::string detector;
  std::string settings;              ///< the fastest of those tried
  std::optional<double> rate;        ///< of fixed steps
  double detection = 0.0;            ///< seconds for a body-second, without motion and response; the median
  double to_world = 1.0;             ///< times what the default engine took in the same turn; the median
  double moves = 0.0;                ///< probes, or steps, in a body-second
  std::optional<double> to_floor{};  ///< probes to the probe floor
  std::optional<double> contacts{};  ///< in a body-second
  std::optional<double> missed{};    ///< part of the contacts, where all pass through
  std::optional<double> bytes{};     ///< for each body
  std::optional<double> building{};  ///< seconds until all bodies are in
  std::uint64_t hash = 0;            ///< of what was found

  /// Seconds for a body-second when a move costs `price` seconds.
  double total(double price) const { return detection + price * moves; }
};

/// By scene.
using SpeedResults = std::map<std::string, std::vector<SpeedRow>>;

/// The row of this detector at this rate; null when it did not take part.
const SpeedRow* find_row(const std::vector<SpeedRow>& rows, const std::string& detector,
                         std::optional<double> rate = std::nullopt);

/// The default engine first. Throws ProgramError.
std::vector<SpeedRow> compare_speed(const SpeedScene& scene, const SpeedSettings& settings);

}  // namespace kinesphere::program
