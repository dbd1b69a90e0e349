// The box in which spheres are placed: which centres are inside, and how far two spheres are apart.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "kinesphere/limits.hpp"
#include "kinesphere/random.hpp"
#include "kinesphere/vec3.hpp"
#include "kinesphere/world_definition.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

/// The largest coordinate of a room (length): squares do not overflow.
inline constexpr double largest_of_room = limits::largest_length * limits::largest_contact_tolerance;

/// Spheres of given radii in a box with walls, or without them on periodic axes.
struct SphereRoom {
  Box box;
  Axes periodic;
  int dimensions;  ///< with 2, all centres have z = 0
  double gap;      ///< least distance of two spheres, and of a sphere and a wall (length)
  std::vector<double> radii{};
  Vec3 half_period = halves();  ///< of the box on each periodic axis, infinite on the others

  std::uint32_t count() const { return static_cast<std::uint32_t>(radii.size()); }
  double size(int axis) const { return box.upper[axis] - box.lower[axis]; }
  /// Returns the least distance of two centres (length).
  double least_distance(std::uint32_t a, std::uint32_t b) const { return radii[a] + radii[b] + gap; }

  /// Returns where the centre of a sphere may be on an axis.
  double lowest(std::uint32_t sphere, int axis) const {
    return periodic[axis] ? box.lower[axis] : box.lower[axis] + (radii[sphere] + gap);
  }
  double highest(std::uint32_t sphere, int axis) const {
    return periodic[axis] ? box.upper[axis] : box.upper[axis] - (radii[sphere] + gap);
  }
  Vec3 random_centre(std::uint32_t sphere, Random& random) const {
    Vec3 centre;
    for (int axis = 0; axis < dimensions; ++axis)
      centre[axis] = random.uniform(lowest(sphere, axis), highest(sphere, axis));
    return wrapped(centre);
  }

  /// Returns the nearest centre that walls allow.
  Vec3 inside_walls(std::uint32_t sphere, Vec3 centre) const {
    for (int axis = 0; axis < dimensions; ++axis)
      if (!periodic[axis])
        centre[axis] = std::clamp(centre[axis], lowest(sphere, axis), highest(sphere, axis));
    return centre;
  }
  /// Returns the image of a point that is in the box.
  Vec3 wrapped(Vec3 point) const {
    for (int axis = 0; axis < dimensions; ++axis) {
      if (!periodic[axis] || (box.lower[axis] <= point[axis] && point[axis] < box.upper[axis])) continue;
      point[axis] -= size(axis) * std::floor((point[axis] - box.lower[axis]) / size(axis));
      if (!(box.lower[axis] <= point[axis] && point[axis] < box.upper[axis])) point[axis] = box.lower[axis];
    }
    return point;
  }
  /// Returns the vector from a point to the nearest image of another, both less than a quarter of a box away
  /// from the box.
  Vec3 offset(const Vec3& from, const Vec3& to) const {
    Vec3 offset = to - from;
    for (int axis = 0; axis < 3; ++axis) {
      const double along = offset[axis];
      if (along > half_period[axis]) offset[axis] = along - size(axis);
      if (along < -half_period[axis]) offset[axis] = along + size(axis);
    }
    return offset;
  }
  bool overlap(std::uint32_t a, const Vec3& centre_a, std::uint32_t b, const Vec3& centre_b) const {
    const double distance = least_distance(a, b);
    return !(norm_squared(offset(centre_a, centre_b)) > distance * distance);
  }

 private:
  Vec3 halves() const {
    Vec3 halves;
    for (int axis = 0; axis < 3; ++axis) halves[axis] = periodic[axis] ? 0.5 * size(axis) : infinity;
    return halves;
  }
};

}  // namespace kinesphere
