// CollisionShape decides when two bodies touch and separate: the bound of a body, a shape at rest, a shape
// that a body carries, or the parts of a rigid body.
#pragma once

#include <cmath>
#include <variant>

#include "bodies/rigid_bodies.hpp"
#include "bound/rigid_certificates.hpp"
#include "bound/shape_difference.hpp"
#include "kinesphere/shape.hpp"

namespace kinesphere {

/// Volume of a body. A static ball is represented by a bound that stands still.
struct CollisionShape {
  const Bound& bound;
  bool is_static = false;
  /// Shape of a static body that is not a ball (`bound` then is one point of it), or a carried one, whose
  /// origin is the centre of `bound`.
  const Shape* shape = nullptr;
  double carried_radius = 0.0;         ///< Placed::radius, RigidExtent::radius
  const RigidRecord* rigid = nullptr;  ///< of a rigid body

  bool is_carried() const { return shape != nullptr && !is_static; }
  /// A solid that is where the shape is. Precondition: the body has a shape.
  template <class Solid>
  Placed<Solid> placed(const Solid& solid) const {
    return {solid, is_static ? nullptr : &bound, carried_radius};
  }
  /// Precondition: the body is rigid.
  RigidExtent extent() const {
    return {bound,
            carried_radius,
            rigid->parts,
            rigid->balls,
            rigid->rotation,
            rigid->spin(),
            rigid->angular_acceleration_limit};
  }
};

/// Calls visit(partner) with what stands for a body that is not rigid: `ball`, or its shape, which is a
/// HalfSpace or a Placed solid.
template <class BallLike, class Visit>
auto visit_partner(const CollisionShape& body, const BallLike& ball, Visit visit) {
  if (!body.shape) return visit(ball);
  return std::visit(
      [&]<class Solid>(const Solid& solid) {
        if constexpr (std::is_same_v<Solid, Ball>)
          return visit(ball);
        else if constexpr (std::is_same_v<Solid, HalfSpace>)
          return visit(solid);
        else if constexpr (std::is_same_v<Solid, Mesh>)
          return visit(body.placed(solid));
        else
          return visit(body.placed(Convex(solid)));
      },
      *body.shape);
}

/// Calls visit(bound, pair) for two bodies, at least one of which is rigid, with their RigidPair.
template <class Visit>
auto visit_rigid(const CollisionShape& a, const CollisionShape& b, Visit visit) {
  const CollisionShape& own = a.rigid ? a : b;
  const CollisionShape& other = a.rigid ? b : a;
  const RigidExtent body = own.extent();
  const auto with = [&]<class Other>(const Other& partner) {
    return visit(own.bound, RigidPair<Other>{body, partner});
  };
  if (other.rigid) return with(other.extent());
  const RigidPart ball{.radius = other.bound.radius};
  const PartBall same = ball_around(ball);
  return visit_partner(
      other, RigidExtent{other.bound, other.bound.radius, std::span(&ball, 1), std::span(&same, 1)}, with);
}

/// Calls visit(bound, partner) for two bodies with shapes, one of which at least is carried: a point that
/// moves as that one, and the difference of the two shapes.
template <class Visit>
auto visit_two_shapes(const CollisionShape& a, const CollisionShape& b, Visit visit) {
  const CollisionShape& own = a.is_carried() ? a : b;
  const CollisionShape& other = a.is_carried() ? b : a;
  Bound point = own.bound;
  point.radius -= own.carried_radius;
  if (const auto* wall = std::get_if<HalfSpace>(other.shape)) {
    // The sum of two offsets loses this.
    point.radius += rounding::margin * (std::abs(wall->offset) + own.carried_radius);
    return visit(point, difference_of(*own.shape, *wall));
  }
  const auto* const box = std::get_if<Box>(own.shape);
  const auto* const other_box = std::get_if<Box>(other.shape);
  if (box && other_box) return visit(point, other.placed(Convex(difference_of(*box, *other_box))));
  return visit(point, other.placed(ShapeDifference{*own.shape, *other.shape}));
}

/// Calls visit(bound, partner), where `partner` is another bound, a shape (visit_partner()), a difference of
/// shapes or a RigidPair, valid during the call. Precondition: not both are shapes at rest.
template <class Visit>
auto visit_shapes(const CollisionShape& a, const CollisionShape& b, Visit visit) {
  if (a.rigid || b.rigid) return visit_rigid(a, b, visit);
  if (a.shape && b.shape) return visit_two_shapes(a, b, visit);
  const Bound& moving = a.shape ? b.bound : a.bound;
  const CollisionShape& other = a.shape ? a : b;
  return visit_partner(other, other.bound, [&](const auto& partner) { return visit(moving, partner); });
}

}  // namespace kinesphere
