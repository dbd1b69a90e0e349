// A motion in the hands of JavaScript.
#pragma once

#include <memory>

#include "kinesphere/kinesphere.hpp"

namespace kinesphere::browser {

/// What a Motion of the package is.
struct MotionHandle {
  std::unique_ptr<Motion> motion;
};

}  // namespace kinesphere::browser
