// CollisionShape decides when two bodies touch and separate: the bound of a body, a shape at rest, or a shape
// that a body carries.
#pragma once

#include <variant>

#include "bound/carried_shape.hpp"
#include "kinesphere/shape.hpp"

namespace kinesphere {

/// Volume of a body. A static ball is represented by a bound that stands still.
struct CollisionShape {
  const Bound& bound;
  bool is_static = false;
  /// Shape of a static body that is not a ball (`bound` then is one point of it), or a carried one, whose
  /// origin is the centre of `bound`.
  const Shape* shape = nullptr;
  double carried_radius = 0.0;  ///< CarriedShape::radius

  bool is_carried() const { return shape != nullptr && !is_static; }
  bool is_ball() const { return shape == nullptr && !is_static; }
};

/// Calls visit(bound, partner), where `partner` is another bound, a HalfSpace, Box or Triangle at rest, or a
/// CarriedShape. Precondition: at most one of the two has a shape.
template <class Visit>
auto visit_shapes(const CollisionShape& a, const CollisionShape& b, Visit visit) {
  if (!a.shape && !b.shape) return visit(a.bound, b.bound);
  const Bound& moving = a.shape ? b.bound : a.bound;
  const CollisionShape& shaped = a.shape ? a : b;
  return std::visit(
      [&]<class Solid>(const Solid& solid) {
        if constexpr (std::is_same_v<Solid, Ball>) {
          return visit(moving, shaped.bound);
        } else {
          if constexpr (!std::is_same_v<Solid, HalfSpace>)
            if (shaped.is_carried())
              return visit(moving, CarriedShape<Solid>{solid, shaped.bound, shaped.carried_radius});
          return visit(moving, solid);
        }
      },
      *shaped.shape);
}

}  // namespace kinesphere
