// Rigid bodies in tables of numbers.
#pragma once

#include <cstddef>

#include "kinesphere/kinesphere.hpp"

namespace kinesphere::browser {

/// Where a rigid body is in the memory of the module; putRigidBody() in package/src/rigid_body.ts writes it.
struct RigidNumbers {
  const double* body;   ///< as body_at() reads it
  const double* rigid;  ///< orientation, angular velocity, two limits, inertia
  std::size_t part_count;
  const double* parts;  ///< for each its kind, its radius, the number of its points, and these
};
RigidBody rigid_body_at(const RigidNumbers& numbers);

}  // namespace kinesphere::browser
