// Packing spheres into a box by pushing them apart, for boxes too full to find room at random.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "kinesphere/vec3.hpp"

namespace kinesphere {

/// As place_spheres: starts with centres drawn at random and pushes overlapping spheres apart, pair by pair,
/// until no overlap is left; nothing when that makes no more progress. Reaches about 60 % of the box's
/// volume. Cost: some hundred sweeps, each about a microsecond per sphere. Exact to the bit on every machine.
std::optional<std::vector<Vec3>> relax_spheres(const std::vector<double>& radii, const Box& box,
                                               double clearance, std::uint64_t seed);

}  // namespace kinesphere
