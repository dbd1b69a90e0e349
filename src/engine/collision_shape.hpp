// What decides when two bodies meet and part: their bounds or, for a fixed body, its shape.
#pragma once

#include <variant>

#include "kinesphere/shape.hpp"

namespace kinesphere {

/// What a body takes up. A fixed ball is a bound at rest like any other.
struct CollisionShape {
  const Bound& bound;
  bool fixed = false;
  const Shape* shape =
      nullptr;  ///< of a fixed body that is no ball; the bound then stands for one point of it
};

/// Calls visit(bound, partner), where the partner is another bound or a HalfSpace, Box or Triangle. Not both
/// may have a shape.
template <class Visit>
auto visit_shapes(const CollisionShape& a, const CollisionShape& b, Visit visit) {
  if (!a.shape && !b.shape) return visit(a.bound, b.bound);
  const Bound& moving = a.shape ? b.bound : a.bound;
  const Bound& ball = a.shape ? a.bound : b.bound;
  return std::visit(
      [&]<class Solid>(const Solid& solid) {
        if constexpr (std::is_same_v<Solid, Ball>)
          return visit(moving, ball);
        else
          return visit(moving, solid);
      },
      a.shape ? *a.shape : *b.shape);
}

}  // namespace kinesphere
