// The public view of one body.
#pragma once

#include <cstdint>

#include "bodies/bodies.hpp"
#include "broadphase/broad_phase.hpp"
#include "kinesphere/world.hpp"

namespace kinesphere {

/// Returns the view of a body, with its last report moved into the primary box of a periodic space.
BodyView body_view(const Bodies& bodies, const BroadPhase& windows, std::uint32_t number, double now);

}  // namespace kinesphere
