// A motion as JavaScript has it.
#pragma once

#include <memory>
#include <optional>

#include "kinesphere/kinesphere.hpp"

namespace kinesphere::browser {

/// The object behind a Motion of the package.
struct MotionHandle {
  std::shared_ptr<Motion> motion;
};

/// Returns why the motion has no state of the body at that time; nothing if it has one. Motion::state() would
/// end the module instead, which cannot catch exceptions.
std::optional<Error> why_unknown(const Motion& motion, double body, double time);

/// Writes six numbers: the state of the body at that time or at the nearest time at which the motion has one;
/// NaN for an absent body or no motion.
void put_nearest_state(const Motion* motion, double body, double time, double* state);

/// Returns true if its bodies accept other velocities; recorded tracks do not.
bool can_be_changed(const Motion& motion);

}  // namespace kinesphere::browser
