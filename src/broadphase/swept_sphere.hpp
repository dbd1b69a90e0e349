// A body over a window of time as a search sees it: a sphere that moves straight on, in single precision.
#pragma once

#include <array>
#include <limits>

#include "bound/quick_reject.hpp"
#include "kinesphere/vec3.hpp"

namespace kinesphere {

/// The units of the swept spheres of one grid level. Lengths count from `base`, times from `origin`. Scale
/// factors keep the numbers at a moderate size in worlds of all scales.
struct SweptSphereFrame {
  Vec3 base{};
  double origin = 0.0;
  double per_length = 1.0;  ///< a power of two
  double per_time = 1.0;

  float time(double t) const { return static_cast<float>((t - origin) * per_time); }
};

/// A sphere that moves straight on. At time s (in units of its frame) the body lies within `radius` of
/// centre + velocity s, from when the swept sphere was made until its end.
struct SweptSphere {
  std::array<float, 3> centre{};
  std::array<float, 3> velocity{};
  float radius = 0.0f;

  friend bool operator==(const SweptSphere&, const SweptSphere&) = default;
};

/// Returns a swept sphere that contains a body, with `margin` around it, from `now` for `duration`.
/// Precondition: `moved` is the body's bound at `now`. The radius is enlarged by 2^-18 of the sum of all
/// lengths that go into a search, which covers the roundings of the search, and by 2^-100 units, which cover
/// underflow (docs/guarantee.md, "The search"). The swept sphere is everywhere (its radius is infinite) if
/// the numbers are too large for a search to compute with: where the square of a velocity overflows, a search
/// would miss bodies that meet.
inline SweptSphere swept_sphere_of(const BoundAt& moved, double now, double duration, double margin,
                                   const SweptSphereFrame& frame) {
  constexpr double part_lost = 0x1p-18;
  constexpr double underflow = 0x1p-100;
  constexpr double largest_speed = 0x1p60;
  constexpr double largest_size = 0x1p120;
  const double back = now - frame.origin;
  const Vec3 centre = moved.centre - frame.base - moved.velocity * back;
  const double radius = moved.radius_after(duration) + margin;
  const double speed = norm_one(moved.velocity);
  const double size = norm_one(moved.centre - frame.base) + 2.0 * speed * back + speed * duration + radius;
  const double per_way = frame.per_length / frame.per_time;
  if (!(speed * per_way < largest_speed && size * frame.per_length < largest_size))
    return {.radius = std::numeric_limits<float>::infinity()};
  SweptSphere sphere;
  for (int axis = 0; axis < 3; ++axis) {
    sphere.centre[static_cast<std::size_t>(axis)] = static_cast<float>(centre[axis] * frame.per_length);
    sphere.velocity[static_cast<std::size_t>(axis)] = static_cast<float>(moved.velocity[axis] * per_way);
  }
  sphere.radius = static_cast<float>((radius + part_lost * size) * frame.per_length + underflow);
  return sphere;
}

}  // namespace kinesphere
