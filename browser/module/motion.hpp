// A motion in the hands of JavaScript.
#pragma once

#include <memory>
#include <optional>

#include "kinesphere/kinesphere.hpp"

namespace kinesphere::browser {

/// What a Motion of the package is.
struct MotionHandle {
  std::unique_ptr<Motion> motion;
};

/// Why the motion has no state of the body at that time; nothing if it has one. Motion::state() would end the
/// module instead, in which nothing can be caught.
std::optional<Error> why_unknown(const Motion& motion, double body, double time);

/// Whether its bodies take other velocities; those of recorded tracks do not.
bool can_be_changed(const Motion& motion);

}  // namespace kinesphere::browser
