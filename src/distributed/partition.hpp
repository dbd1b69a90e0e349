// Which part of space is whose: boxes that together are all of space, one for each rank.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "distributed/communicator.hpp"
#include "kinesphere/vec3.hpp"

namespace kinesphere {

class Partition {
 public:
  /// All of space belongs to rank 0.
  explicit Partition(int ranks);
  /// So that bodies at these positions cost each rank about the same, by Zoltan's recursive coordinate
  /// bisection. Collective: each rank has some of the positions, or none. `costs`: one each, > 0.
  static Partition choose(Communicator& communicator, std::span<const Vec3> positions,
                          std::span<const double> costs);

  int ranks() const { return static_cast<int>(regions_.size()); }
  /// Each position is one rank's: cost O(log ranks) where cuts balance.
  int owner_of(const Vec3& position) const;
  /// lower <= position < upper, infinite on the outside. That of a rank with no space is empty: upper <
  /// lower.
  const Box& region_of(int rank) const { return regions_[static_cast<std::size_t>(rank)]; }

 private:
  /// Space cut in two, and again.
  struct Cut {
    int axis = -1;  ///< -1 where it is not cut
    double at = 0.0;
    int below = 0;  ///< the place of a cut or, where it is not cut, a rank
    int above = 0;
  };

  int cut(std::span<const int> ranks, const Box& space, std::span<const Box> boxes);

  std::vector<Cut> cuts_;  ///< the first one is of all of space
  std::vector<Box> regions_;
};

}  // namespace kinesphere
