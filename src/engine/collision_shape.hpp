// CollisionShape decides when two bodies touch and separate: the bound of a body or, for a static body, its
// shape.
#pragma once

#include <variant>

#include "kinesphere/shape.hpp"

namespace kinesphere {

/// Volume of a body. A static ball is represented by a bound that stands still.
struct CollisionShape {
  const Bound& bound;
  bool is_static = false;
  const Shape* shape =
      nullptr;  ///< shape of a static body that is not a ball; `bound` then is one point of it
};

/// Calls visit(bound, partner), where `partner` is another bound or a HalfSpace, Box or Triangle.
/// Precondition: at most one of the two has a shape.
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
