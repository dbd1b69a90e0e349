// What a world tells of a body.
#pragma once

#include <cstdint>

#include "engine/body_bounds.hpp"
#include "kinesphere/world.hpp"

namespace kinesphere {

/// The body with its last report in the primary box, wherever the engine keeps it.
BodyView body_view(const Bodies& bodies, const BroadPhase& windows, std::uint32_t number, double now);

}  // namespace kinesphere
