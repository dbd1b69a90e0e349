// Representation of bodies with shapes in the table of bodies.
#pragma once

#include "bodies/bodies.hpp"

namespace kinesphere {

/// Returns a body of infinite mass that stands still at one point of the shape, with zero motion limits.
BodyDefinition body_of(const StaticDefinition& definition);
/// Returns the body with the radius of the ball (in two dimensions the disc) around its position that
/// contains the shape. Precondition: check_carried_shape().
BodyDefinition body_of(const MovingShape& definition, const WorldDefinition& world);
/// Returns the body with the radius of the ball around its position that contains all parts.
BodyDefinition body_of(const RigidBody& definition);
/// Returns the record of a rigid body that has its defined rotation at a time.
RigidRecord record_of(const RigidBody& definition, double time);
/// Returns a rigid body with the state and the rotation of its last report, or those that were set since.
RigidBody rigid_body(const Bodies& bodies, std::uint32_t number);
StaticDefinition static_definition(const Bodies& bodies, BodyId id);
/// Returns the shape in normal form: the normal of a half-space has length 1 to double precision, a ball is
/// moved into the box in periodic space, a box is unbounded in z in two dimensions. Precondition:
/// check_shape().
Shape normalized(Shape shape, const WorldDefinition& world);
/// Returns a shape for a body that carries it in normal form: in two dimensions a box reaches so far in z
/// that its nearest face is one in the plane. Precondition: check_carried_shape().
Shape normalized_carried(Shape shape, const WorldDefinition& world);

}  // namespace kinesphere
