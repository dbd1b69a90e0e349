// A BodyMap as JavaScript has it.
#pragma once

#include <memory>
#include <vector>

#include "kinesphere/body_map.hpp"
#include "motion.hpp"

namespace kinesphere::browser {

/// The object behind a BodyMap of the package. It keeps its motions alive, also those that JavaScript frees.
struct BodyMapHandle {
  std::unique_ptr<BodyMap> map;
  std::vector<std::shared_ptr<Motion>> motions;
};

}  // namespace kinesphere::browser
