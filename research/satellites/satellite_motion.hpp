// Satellites on their way around the earth, under the gravity of a point mass and J2. Lengths in km, times in
// s.
#pragma once

#include <cstdint>
#include <vector>

#include "kinesphere/body.hpp"
#include "kinesphere/result.hpp"
#include "research/satellites/arc.hpp"

namespace kinesphere {

/// Each path is made of arcs, one after the other, from time 0 on. At the seams it jumps, as series are cut
/// off and numbers are rounded, by less than `position_error` and `velocity_error`.
class SatelliteMotion {
 public:
  static constexpr double position_error = 1e-6;
  static constexpr double velocity_error = 1e-9;
  /// The first arc after time 0 ends here.
  static constexpr double arc_length = 2.0 * Arc::half_length;

  /// States at time 0. Errors: not_finite; out_of_range for one that is not on an ellipse around the earth,
  /// of an eccentricity of at most 0.95, which nowhere is lower than 100 km under the equator's height.
  static Result<SatelliteMotion> create(const std::vector<State>& start);

  std::uint32_t size() const { return static_cast<std::uint32_t>(arcs_.size()); }
  /// The arc at a time; at a seam the later one. For each satellite, times may go back no farther than to the
  /// begin of the latest arc. Valid until another arc of the satellite is asked for. Cost: 0.5 us for each
  /// new arc.
  const Arc& arc(std::uint32_t satellite, double time) {
    Arc& arc = arcs_[satellite];
    while (arc.end() <= time) arc = Arc(arc.state_at(arc.middle() + arc_length), arc.middle() + arc_length);
    return arc;
  }

  // What the paths at time 0 say of all times, about: whoever relies on it has to look at each arc.
  double largest_acceleration() const;
  double largest_speed() const;

 private:
  std::vector<Arc> arcs_;
  double lowest_ = 0.0;  ///< perigee, from the earth's centre
};

}  // namespace kinesphere
