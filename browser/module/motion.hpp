// Motions whose bodies JavaScript may steer, and scenes with all that happens in them.
#pragma once

#include <memory>

#include "kinesphere/kinesphere.hpp"

namespace kinesphere::browser {

/// What a Motion of the package is.
struct MotionHandle {
  std::unique_ptr<Motion> motion;
};

}  // namespace kinesphere::browser
