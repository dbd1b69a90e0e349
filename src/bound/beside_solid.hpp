// A solid, at rest or carried, as a partner: motions relative to it, and bounds of its points.
#pragma once

#include "bound/carried_shape.hpp"

namespace kinesphere {

/// The motion of a bound relative to a solid from a time on.
template <class Solid>
BoundBesideBound beside(const Bound& bound, const Solid&, double) {
  return BoundBesideBound(bound);
}
template <class Solid>
BoundBesideBound beside(const Bound& bound, const CarriedShape<Solid>& shape, double time) {
  return {bound, shape.carrier, time, shape.radius};
}
template <class Solid>
const Solid& solid_of(const Solid& solid) {
  return solid;
}
template <class Solid>
const Solid& solid_of(const CarriedShape<Solid>& shape) {
  return shape.solid;
}

/// True for a mesh, at rest or carried.
template <class Shape>
inline constexpr bool is_mesh = false;
template <>
inline constexpr bool is_mesh<Mesh> = true;
template <>
inline constexpr bool is_mesh<CarriedShape<Mesh>> = true;
/// True for a solid, at rest or carried, of several pieces, others of which than the nearest may be
/// approached.
template <class Shape>
inline constexpr bool has_pieces = is_mesh<Shape>;

/// Returns what stands for `other` where it is like a solid: at rest, or carried.
template <class Solid, class Other>
const Other& placed_like(const Solid&, const Other& other) {
  return other;
}
template <class Solid, class Other>
CarriedShape<Other> placed_like(const CarriedShape<Solid>& shape, const Other& other) {
  return {other, shape.carrier, shape.radius};
}

/// The bound of a point of a solid.
template <class Solid>
Bound bound_of_point(const Solid&, const Vec3& point, double time) {
  return {.time = time, .position = point};
}
template <class Solid>
Bound bound_of_point(const CarriedShape<Solid>& shape, const Vec3& point, double) {
  Bound bound = shape.carrier;
  bound.position += point;
  return bound;
}
/// Part of that bound's radius that does not count.
template <class Solid>
double radius_of(const Solid&) {
  return 0.0;
}
template <class Solid>
double radius_of(const CarriedShape<Solid>& shape) {
  return shape.radius;
}

}  // namespace kinesphere
