// Certified times and gaps of rigid bodies: those of their parts, as docs/guarantee.md derives them.
//
// Two bodies meet when the first two parts do, and separate when the last two parts have. Two balls are a
// pair of bounds (bound.hpp). Of a capsule and a partner, two facts hold in any direction, however computed.
// They are apart while a plane that is fixed in space, relative to the partner, has the two ends of the
// capsule on one side and the partner on the other. Their distance is at most that of any two points, one
// fixed in each.
#pragma once

#include "bound/convex.hpp"
#include "bound/placed.hpp"
#include "bound/rigid_extent.hpp"

namespace kinesphere {

/// Like the functions of bound.hpp, for the bodies of a pair. `bound` is ignored: the pair contains both.
template <class Other>
double earliest_meeting(const Bound& bound, const RigidPair<Other>& pair, double from, double until,
                        double distance = 0.0);
/// What the points of two bodies that touch have to keep for some time. Points that approach each other by
/// more than `speed` (length / time), along the direction between the parts, keep a gap of `approaching`; all
/// others may sink to `receding` (length).
struct Sinking {
  double approaching;
  double receding;
  double speed;
};
/// Returns a time before which all points of the two keep that, or +infinity if they do until `until`. One
/// step of earliest_meeting(), along the present directions between parts. Parts whose axes or hulls overlap,
/// which have no such direction, do not count. Precondition: both reports are of `from`, or their bodies
/// stand still.
template <class Other>
double earliest_sinking(const RigidPair<Other>& pair, double from, double until, const Sinking& sinking);
template <class Other>
double earliest_separation(const Bound& bound, const RigidPair<Other>& pair, double from, double until,
                           double distance);
template <class Other>
GapLimits gap_limits(const Bound& bound, const RigidPair<Other>& pair, double t);
/// Returns true if the gap certainly is larger than `distance`, as it is if gap_limits(...).lower is, for
/// less.
template <class Other>
bool is_beyond(const RigidPair<Other>& pair, double t, double distance);

}  // namespace kinesphere
