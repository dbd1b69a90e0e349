// Partition divides space into one box per rank; together the boxes cover all of space.
#pragma once

#include <span>
#include <vector>

#include "distributed/communicator.hpp"
#include "kinesphere/vec3.hpp"

namespace kinesphere {

class Partition {
 public:
  /// Assigns all of space to rank 0.
  explicit Partition(int ranks);
  /// Collective; each rank passes some of the positions or none. Balances the cost of the bodies at these
  /// positions over the ranks by recursive coordinate bisection. `costs`: one per position, > 0.
  static Partition choose(Communicator& communicator, std::span<const Vec3> positions,
                          std::span<const double> costs);
  /// Makes the partition of the boxes of all ranks, which bisect() has found.
  static Partition along(std::span<const Box> boxes);

  int ranks() const { return static_cast<int>(regions_.size()); }
  /// Returns the rank that owns the position; every position has exactly one owner. Cost: O(log ranks) if the
  /// cuts are balanced.
  int owner_of(const Vec3& position) const;
  /// Region of the rank: lower <= position < upper, infinite at the outside. The region of a rank without
  /// space is empty: upper < lower.
  const Box& region_of(int rank) const { return regions_[static_cast<std::size_t>(rank)]; }

 private:
  /// Node of the binary tree of cuts.
  struct Cut {
    int axis = -1;  ///< -1 for a leaf
    double at = 0.0;
    int below = 0;  ///< index of a cut; the rank, for a leaf
    int above = 0;
  };

  int cut(std::span<const int> ranks, const Box& space, std::span<const Box> boxes);

  std::vector<Cut> cuts_;  ///< the first one is the root
  std::vector<Box> regions_;
};

}  // namespace kinesphere
