// The structure of a fluid or a packing: how many neighbours there are at each distance.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kinesphere/result.hpp"
#include "kinesphere/vec3.hpp"
#include "kinesphere/world_definition.hpp"

namespace kinesphere {

/// Returns the radial distribution function g of points in a box that repeats on all axes: the number of
/// pairs at a distance over that of as many points at random places (Allen and Tildesley, Computer Simulation
/// of Liquids, 2017, section 8.2). It is the mean over each of `bins` bins of equal width from 0 to `range`
/// (length). The points may lie in any image of the box.
///
/// `dimensions`: 3, or 2 for points in the plane z = 0, where the z range of the box is ignored.
///
/// Errors: not_finite or out_of_range for a point, the box or a number; out_of_range for `centres` if there
/// are fewer than two, and for `range` if it is more than half of a side of the box. Cost: O(n) times the
/// number of points within `range` of one.
[[nodiscard]] Result<std::vector<double>> radial_distribution(std::span<const Vec3> centres, const Box& box,
                                                              double range, std::size_t bins,
                                                              int dimensions = 3);

}  // namespace kinesphere
