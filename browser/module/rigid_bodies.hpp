// Rigid bodies in tables of numbers.
#pragma once

#include <cstddef>
#include <vector>

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

/// Reads four numbers for each quaternion.
inline std::vector<Quaternion> quaternions_at(const double* numbers, std::size_t count) {
  std::vector<Quaternion> rotations;
  for (std::size_t k = 0; k < count; ++k, numbers += 4)
    rotations.push_back({numbers[0], numbers[1], numbers[2], numbers[3]});
  return rotations;
}

}  // namespace kinesphere::browser
