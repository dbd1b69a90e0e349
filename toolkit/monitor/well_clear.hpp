// Well clear with modified tau (RTCA DO-365) of two tracks whose states are known up to errors.
#pragma once

#include "kinesphere/vec3.hpp"

namespace kinesphere {

/// Horizontal position and velocity of one track relative to another at one time: each in a disc, whose
/// radius grows. Vectors have z = 0.
struct RelativeDiscs {
  Vec3 position{};              ///< centre
  Vec3 velocity{};              ///< centre, and velocity of the centre of the position's disc
  double acceleration = 0.0;    ///< length of the acceleration of both centres
  double position_error = 0.0;  ///< radius; it grows by at most `velocity_error`, or not (`grows`)
  double velocity_error = 0.0;  ///< radius; it grows by `velocity_growth` for each unit of time
  double velocity_growth = 0.0;
  bool grows = true;  ///< False: both radii stay as they are.
};

/// A well clear volume in the plane: Separation::horizontal and modified_tau.
struct WellClearLimits {
  double distance = 0.0;
  double modified_tau = 0.0;
};

/// Returns for how long (time) all states in the discs certainly have not lost well clear, as far as modified
/// tau counts: the distance may be below the limit when the two do not close in. A negative result -t says
/// that this is not proved now, and that no proof of this kind exists before t, as long as the discs move as
/// described. Cost: about 50 ns.
double clear_by_tau_for(const RelativeDiscs& discs, const WellClearLimits& limits);
/// Returns for how long all states in the discs certainly have lost well clear, by distance or by modified
/// tau. A negative result is as above.
double lost_for(const RelativeDiscs& discs, const WellClearLimits& limits);

}  // namespace kinesphere
