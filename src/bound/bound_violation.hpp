// Checks a report against the bound that the previous report and the motion limits imply.
#pragma once

#include <optional>

#include "kinesphere/bound.hpp"

namespace kinesphere {

/// Distance of a report from its bound, for position and velocity; each is zero if the bound holds.
struct BoundViolation {
  double position_excess = 0.0;  ///< length
  double velocity_excess = 0.0;  ///< length / time
};

/// Compares a report of a body of this radius with the bound of the previous report. Returns nullopt if the
/// report satisfies it. `before` and `after` are the bounds made from the previous and from the present
/// report; their error limits differ if the caller has changed them in between. `new_velocity` is the
/// velocity that the caller has set since the previous report: then that report was made at this very time,
/// or only its position counts. Rounding errors up to 1/16 of `contact_tolerance` are not a violation, as the
/// tolerance covers them.
std::optional<BoundViolation> bound_violation(const Bound& before, const Bound& after, double radius,
                                              const std::optional<Vec3>& new_velocity,
                                              double contact_tolerance);

}  // namespace kinesphere
