// A report held against the promise of its body.
#pragma once

#include <optional>

#include "kinesphere/bound.hpp"

namespace kinesphere {

/// By how much a report lies outside what was promised; each zero when it is within it.
struct BrokenPromise {
  double position_excess = 0.0;  ///< length
  double velocity_excess = 0.0;  ///< length / time
};

/// Nothing for a faithful report. The bound tells what the body promised at its last report, `promise` what
/// it promises now: the two differ in the errors, for one, when the caller has changed them since.
/// `kicked_to`: the velocity that the body was given since its last report, which was at this very time or is
/// only good for its position. What rounding may do to a faithful report, up to 1/16 of `contact_tolerance`,
/// is no violation: the tolerance covers it.
std::optional<BrokenPromise> broken_promise(const BodyDefinition& promise, const Bound& bound,
                                            const State& report, double time,
                                            const std::optional<Vec3>& kicked_to, double contact_tolerance);

}  // namespace kinesphere
