// Packing of spheres into a box by pushing them apart, for boxes too full for random placement.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "kinesphere/vec3.hpp"

namespace kinesphere {

/// Returns centres as place_spheres() does: starts with random centres and pushes overlapping spheres apart,
/// pair by pair, until no overlap is left; nothing if that makes no more progress. Reaches about 60 % of the
/// box's volume. The result is the same to the bit on every machine. Cost: some hundred sweeps, each about a
/// microsecond per sphere.
std::optional<std::vector<Vec3>> relax_spheres(const std::vector<double>& radii, const Box& box,
                                               double clearance, std::uint64_t seed, bool periodic = false);

}  // namespace kinesphere
