// A fixed body as the table of bodies holds it.
#pragma once

#include "engine/bodies.hpp"

namespace kinesphere {

/// At rest, at one point of the shape, with no promise to break.
BodyDefinition body_of(const StaticDefinition& fixed);
StaticDefinition static_definition(const Bodies& bodies, BodyId id);
/// A shape that has been checked: the normal of a half-space made exactly as long as doubles allow, a ball
/// moved into the box where space repeats, a box without ends in z in the plane.
Shape normalized(Shape shape, const WorldDefinition& world);

}  // namespace kinesphere
