// Satellites around the earth, under the gravity of a point mass and J2. Lengths are in km, times in s.
#pragma once

#include <cstdint>
#include <vector>

#include "kinesphere/body.hpp"
#include "kinesphere/result.hpp"
#include "research/satellites/arc.hpp"

namespace kinesphere {

/// SatelliteMotion makes each path of arcs, one after the other, from time 0 on. At the seams a path jumps,
/// as series are cut off and numbers are rounded, by less than `position_error` and `velocity_error`.
class SatelliteMotion {
 public:
  static constexpr double position_error = 1e-6;
  static constexpr double velocity_error = 1e-9;
  /// Length of an arc (s). The first arc after time 0 ends here.
  static constexpr double arc_length = 2.0 * Arc::half_length;

  /// Makes the motion from states at time 0. Errors: not_finite; out_of_range for a state that is not on an
  /// ellipse around the earth with an eccentricity of at most 0.95 that is everywhere at least 100 km above
  /// the equator's height.
  static Result<SatelliteMotion> create(const std::vector<State>& start);

  std::uint32_t size() const { return static_cast<std::uint32_t>(arcs_.size()); }
  /// Returns the arc at a time; at a seam the later one. The times of a satellite's calls may go back no
  /// farther than to the begin of its latest arc. The reference is valid until another arc of the satellite
  /// is asked for. Cost: 0.5 us for each new arc.
  const Arc& arc(std::uint32_t satellite, double time) {
    Arc& arc = arcs_[satellite];
    while (arc.end() <= time) arc = Arc(arc.state_at(arc.middle() + arc_length), arc.middle() + arc_length);
    return arc;
  }

  // Estimates from the paths at time 0. They are no bounds: a caller that relies on one has to check each
  // arc.
  double largest_acceleration() const;
  double largest_speed() const;

 private:
  std::vector<Arc> arcs_;
  double lowest_ = 0.0;  ///< lowest perigee, from the earth's centre (km)
};

}  // namespace kinesphere
