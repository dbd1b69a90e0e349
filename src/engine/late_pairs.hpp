// Pairs of which two islands have one body each, and which are due when the part is over.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/groups.hpp"
#include "window/agenda.hpp"

namespace kinesphere {

class LatePairs {
 public:
  void clear() { late_.clear(); }
  /// Two kicked bodies that have to be looked at then, if neither is kicked again in the part: as these
  /// attempts of the two groups have it.
  void note(const Group& one, const Group& other, const HotPair& pair) {
    late_.push_back({one.own, one.attempts, other.own, other.attempts, pair});
  }
  /// Calls visit(pair) for each of which none of the two groups has been taken back since.
  template <class Visit>
  void for_each_left(const Groups& groups, Visit visit) const {
    const auto stands = [&](std::uint32_t own, std::uint32_t attempt) {
      const Group& group = groups[own];
      return !group.joined() && group.attempted && group.attempts == attempt;
    };
    for (const Late& late : late_)
      if (stands(late.one, late.attempt_of_one) && stands(late.other, late.attempt_of_other))
        visit(late.pair);
  }

 private:
  struct Late {
    std::uint32_t one;
    std::uint32_t attempt_of_one;
    std::uint32_t other;
    std::uint32_t attempt_of_other;
    HotPair pair;
  };
  std::vector<Late> late_;
};

}  // namespace kinesphere
