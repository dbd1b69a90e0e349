// Representation of a static body in the table of bodies.
#pragma once

#include "engine/bodies.hpp"

namespace kinesphere {

/// Returns a body of infinite mass that stands still at one point of the shape, with zero motion limits.
BodyDefinition body_of(const StaticDefinition& definition);
StaticDefinition static_definition(const Bodies& bodies, BodyId id);
/// Returns the shape in normal form: the normal of a half-space has length 1 to double precision, a ball is
/// moved into the box in periodic space, a box is unbounded in z in two dimensions. Precondition:
/// check_shape().
Shape normalized(Shape shape, const WorldDefinition& world);

}  // namespace kinesphere
