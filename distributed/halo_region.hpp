// HaloRegion is a set of boxes in which a rank knows all bodies: those whose safe regions meet one of the
// boxes at any time in a slab.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kinesphere/vec3.hpp"
#include "space/space.hpp"

namespace kinesphere {

class HaloRegion {
 public:
  /// Replaces all boxes.
  void assign(std::span<const Box> boxes) { boxes_.assign(boxes.begin(), boxes.end()); }
  void add(const Box& box) { boxes_.push_back(box); }
  /// Returns whether one of the boxes contains the whole box or, in periodic space, a periodic image of it.
  /// Cost: O(boxes).
  bool covers(const Box& box, const Space& space) const;
  /// Returns whether one of the boxes intersects the box or a periodic image of it. Cost: O(boxes).
  bool meets(const Box& box, const Space& space) const;
  const std::vector<Box>& boxes() const { return boxes_; }

 private:
  std::vector<Box> boxes_;
};

/// Returns whether `a` intersects `b` or a periodic image of it.
bool meet(const Box& a, const Box& b, const Space& space);

/// Halo regions of all ranks: this rank's own, and those of other ranks as far as they have sent them.
class HaloRegions {
 public:
  HaloRegions(int ranks, int here, const Space& space)
      : space_(space), here_(here), by_rank_(static_cast<std::size_t>(ranks)) {}

  HaloRegion& operator[](int rank) { return by_rank_[static_cast<std::size_t>(rank)]; }
  const HaloRegion& here() const { return by_rank_[static_cast<std::size_t>(here_)]; }
  bool covers(const Box& box) const { return here().covers(box, space_); }
  /// Adds the box to this rank's halo region unless it is covered. Returns false if it was covered.
  bool cover(const Box& box);
  /// Returns, in ascending order, the other ranks whose halo region intersects the box.
  std::vector<int> ranks_that_meet(const Box& box) const;

 private:
  const Space& space_;
  int here_;
  std::vector<HaloRegion> by_rank_;
};

}  // namespace kinesphere
