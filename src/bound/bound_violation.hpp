// A report held against the promise of its body.
#pragma once

#include <optional>

#include "kinesphere/bound.hpp"

namespace kinesphere {

/// By how much a report lies outside what was promised; each zero when it is within it.
struct BoundViolation {
  double position_excess = 0.0;  ///< length
  double velocity_excess = 0.0;  ///< length / time
};

/// Nothing for a faithful report. The bounds of a body of this radius are `before` and `after` it: the one
/// tells what was promised at the report before, the other what is promised now, and they differ in the
/// errors when the caller has changed them since. `kicked_to`: the velocity that the body was given since its
/// report before, which was at this very time or is only good for its position. What rounding may do to a
/// faithful report, up to 1/16 of `contact_tolerance`, is no violation: the tolerance covers it.
std::optional<BoundViolation> bound_violation(const Bound& before, const Bound& after, double radius,
                                              const std::optional<Vec3>& kicked_to, double contact_tolerance);

}  // namespace kinesphere
