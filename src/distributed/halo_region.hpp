// The space of which a rank knows all bodies: boxes. A body that may come into one of them, before its window
// ends, is known to the rank.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kinesphere/vec3.hpp"
#include "space/space.hpp"

namespace kinesphere {

class HaloRegion {
 public:
  /// These boxes and no others.
  void assign(std::span<const Box> boxes) { boxes_.assign(boxes.begin(), boxes.end()); }
  void add(const Box& box) { boxes_.push_back(box); }
  /// Whether the whole box, or where space repeats an image of it, lies within one of the boxes.
  bool covers(const Box& box, const Space& space) const;
  /// Whether a part of it lies in one of them.
  bool meets(const Box& box, const Space& space) const;
  const std::vector<Box>& boxes() const { return boxes_; }

 private:
  std::vector<Box> boxes_;
};

/// As HaloRegion::meets() has it.
bool meet(const Box& a, const Box& b, const Space& space);

/// The known space of all ranks: of this one, and of the others as far as they have told.
class HaloRegions {
 public:
  HaloRegions(int ranks, int here, const Space& space)
      : space_(space), here_(here), by_rank_(static_cast<std::size_t>(ranks)) {}

  HaloRegion& operator[](int rank) { return by_rank_[static_cast<std::size_t>(rank)]; }
  const HaloRegion& here() const { return by_rank_[static_cast<std::size_t>(here_)]; }
  bool covers(const Box& box) const { return here().covers(box, space_); }
  /// Makes the box known on this rank. False if it is already.
  bool cover(const Box& box);
  /// The other ranks whose known space a part of the box lies in, in ascending order.
  std::vector<int> ranks_that_meet(const Box& box) const;

 private:
  const Space& space_;
  int here_;
  std::vector<HaloRegion> by_rank_;
};

}  // namespace kinesphere
