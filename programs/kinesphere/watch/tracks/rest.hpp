// Which tracks are at rest: moored, at anchor, parked.
#pragma once

#include <limits>
#include <optional>

#include "kinesphere/vec3.hpp"

namespace kinesphere::program {

/// Whether a track is at rest, and since when it has been slow.
struct Rest {
  bool is_at_rest = false;
  double slow_since = std::numeric_limits<double>::infinity();  ///< +infinity: its latest report was not slow
  Vec3 place{};                                                 ///< where it was then
};

/// A track is at rest once it has been slow for a while, and from its first report on if that is slow; until
/// it is not slow any more, or has moved away.
struct RestRule {
  double speed = 0.0;   ///< a track that is no faster is slow (length / time); with 0 none is at rest
  double room = 0.0;    ///< a track that gets farther than this has moved away (length, in the plane)
  double time = 180.0;  ///< a track that has been slow for so long is at rest

  /// Takes the latest report of a track, with its speed where it is known. Returns true if the track was at
  /// rest and is no more.
  bool take(Rest& rest, const Vec3& position, const std::optional<double>& now, double stamp,
            bool is_first) const;
};

}  // namespace kinesphere::program
