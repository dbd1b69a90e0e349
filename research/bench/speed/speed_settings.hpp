// The extent of `kinesphere-bench speed`: every number of it that no option gives.
#pragma once

#include <cstdint>
#include <string_view>

#include "research/bench/settings.hpp"

namespace kinesphere::program {

struct SpeedSettings {
  std::string_view name;
  int repetitions;       ///< repetitions of every measurement; medians are shown
  double least_turn;     ///< seconds: shorter runs are repeated
  std::uint32_t divide;  ///< divisor of the number of bodies in every scene, at constant density
  double shorten;        ///< factor of the time of every scene
  /// Scenes of more bodies than this are left out.
  std::uint32_t most_bodies;
  std::uint32_t most_with_rivals;  ///< scenes of more bodies than this are run without fixed steps
  std::uint64_t most_recorded;     ///< positions of a scene kept at a time, 12 bytes each
  std::uint64_t most_looked;       ///< positions tested to count missed contacts
};

const SpeedSettings& speed_settings(Effort effort);

}  // namespace kinesphere::program
