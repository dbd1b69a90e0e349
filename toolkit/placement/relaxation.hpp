// Packing of spheres by pushing them apart, for boxes too full for random placement.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "placement/sphere_room.hpp"

namespace kinesphere {

/// Returns centres without overlap, or nothing if none were found: spheres at random places push each other
/// apart, pair by pair, and then make some random moves. Precondition: each sphere alone has room. Cost:
/// place_spheres().
std::optional<std::vector<Vec3>> relax_spheres(const SphereRoom& room, std::uint64_t seed);

}  // namespace kinesphere
