// The space of which a rank knows all bodies: boxes. A body that may come into one of them, before its window
// ends, is known to the rank.
#pragma once

#include <vector>

#include "kinesphere/vec3.hpp"
#include "space/space.hpp"

namespace kinesphere {

class KnownSpace {
 public:
  /// No more than this.
  void begin(const Box& core) { boxes_.assign(1, core); }
  void add(const Box& box) { boxes_.push_back(box); }
  /// Whether the whole box, or where space repeats an image of it, lies within one of the boxes.
  bool covers(const Box& box, const Space& space) const;
  /// Whether a part of it lies in one of them.
  bool meets(const Box& box, const Space& space) const;
  const std::vector<Box>& boxes() const { return boxes_; }

 private:
  std::vector<Box> boxes_;
};

/// As KnownSpace::meets() has it.
bool meet(const Box& a, const Box& b, const Space& space);

}  // namespace kinesphere
