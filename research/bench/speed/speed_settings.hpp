// How much `kinesphere bench speed` does: every number of it that no option gives.
#pragma once

#include <cstdint>
#include <string_view>

#include "research/bench/settings.hpp"

namespace kinesphere::program {

struct SpeedSettings {
  std::string_view name;
  int repetitions;       ///< of every measurement; medians are shown
  double least_turn;     ///< seconds: shorter runs are repeated
  std::uint32_t divide;  ///< the number of bodies in every scene, at the same density
  double shorten;        ///< the time of every scene
  /// Scenes of more bodies than this are left out.
  std::uint32_t most_bodies;
  std::uint32_t most_with_rivals;  ///< and of more than this without fixed steps
  std::uint64_t most_recorded;     ///< positions that are kept of a scene at a time: they take 12 bytes
  std::uint64_t most_looked;       ///< positions that are looked at to count missed contacts
};

const SpeedSettings& speed_settings(Effort effort);

}  // namespace kinesphere::program
