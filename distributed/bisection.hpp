// Recursive coordinate bisection (Berger and Bokhari, IEEE Trans. Computers 36, 1987): divides space into one
// box per rank, so that points of about equal cost are in each.
#pragma once

#include <span>
#include <vector>

#include "distributed/communicator.hpp"
#include "kinesphere/vec3.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

inline constexpr Box everywhere{{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}};
/// The box of a rank without space.
inline constexpr Box nowhere{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};

/// Collective; each rank passes some of the points or none. Returns the boxes by rank, equal on all ranks.
/// They are the leaves of a tree of cuts, each of which divides the ranks and the space of its branch where
/// these points reach farthest. Points that are all at one place are not divided: the first rank of the
/// branch gets its space. `costs`: one for each position, > 0. Cost: O(n log ranks) and some 10 log ranks
/// collective calls.
std::vector<Box> bisect(Communicator& communicator, std::span<const Vec3> positions,
                        std::span<const double> costs);
/// The same by Zoltan (Devine et al., Computing in Science and Engineering 4, 2002). Its boxes are
/// approximate: points on a cut may be on either side. Only in builds with KINESPHERE_ZOLTAN.
std::vector<Box> bisect_by_zoltan(Communicator& communicator, std::span<const Vec3> positions,
                                  std::span<const double> costs);

}  // namespace kinesphere
