// A fixed body as the table of bodies holds it.
#pragma once

#include "kinesphere/shape.hpp"

namespace kinesphere {

/// At rest, at one point of the shape, with no promise to break.
BodyDefinition body_of(const FixedDefinition& fixed);

}  // namespace kinesphere
