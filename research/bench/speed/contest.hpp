// One scene under all detectors, which take turns, so that a busy machine slows all alike.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "research/bench/speed/speed_scenes.hpp"

namespace kinesphere::program {

/// Assumed costs of a move, that is a probe or a step of a body, in the tables (seconds).
constexpr double move_prices[] = {0.0, 100e-9, 1e-6, 10e-6};

/// Times of a detector and of the default engine, one after the other (seconds for a body-second).
struct Turn {
  double own;
  double world;
};

/// Results of a detector for a scene. Times are CPU time.
struct SpeedRow {
  std::string detector;
  std::string settings;        ///< the fastest of those tried
  std::optional<double> rate;  ///< rate of fixed steps
  double detection = 0.0;      ///< seconds for a body-second, without motion and response; the median
  std::vector<Turn> turns{};
  double moves = 0.0;                ///< probes, or steps, in a body-second
  std::optional<double> contacts{};  ///< contacts in a body-second
  std::optional<double> missed{};    ///< part of the contacts that count (SpeedScene), without bounces
  std::optional<double> bytes{};     ///< memory for each body
  std::optional<double> building{};  ///< seconds until all bodies are in
  std::uint64_t hash = 0;            ///< hash of what was found

  /// Returns seconds for a body-second if a move costs `price` seconds.
  double total(double price) const { return detection + price * moves; }
  /// Returns the quotient of the times of this row and of the default engine: the median of the turns.
  double to_world() const;
};

/// Runs all detectors on a scene and returns their rows, the default engine first. Throws ProgramError.
std::vector<SpeedRow> compare_speed(const SpeedScene& scene, const SpeedSettings& settings);

}  // namespace kinesphere::program
