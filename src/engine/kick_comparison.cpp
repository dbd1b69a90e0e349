#include "engine/kick_comparison.hpp"

#include <algorithm>

namespace kinesphere {

void KickComparison::clear() {
  compared_.clear();
  uncompared_.clear();
  foreign_.clear();
  compared_foreign_ = 0;
  meetings_.clear();
}

std::size_t KickComparison::take(Groups& groups, const Attempts& attempts, std::vector<GroupKick>& kicks) {
  const auto add = [&](const Group& group) {
    for (const BodyKick& kick : attempts.kicks_of(group)) kicks.push_back({group.own, &kick});
  };
  const auto add_foreign = [&](std::size_t from, std::size_t to) {
    for (std::size_t k = from; k < to; ++k) kicks.push_back({Sea::nobody, &foreign_[k]});
  };
  std::erase_if(compared_, [&](std::uint32_t own) {
    return groups[own].joined() || !groups[own].attempted || !groups[own].kicks_are_compared;
  });
  const std::size_t before = compared_.size();
  for (const std::uint32_t own : std::exchange(uncompared_, {})) {
    Group& group = groups[own];
    if (group.joined() || !group.attempted || group.kicks_are_compared) continue;
    group.kicks_are_compared = true;
    compared_.push_back(own);
    add(group);
  }
  const std::size_t foreign_before = std::exchange(compared_foreign_, foreign_.size());
  add_foreign(foreign_before, foreign_.size());
  const std::size_t fresh = kicks.size();
  if (fresh == 0) return 0;
  for (std::size_t k = 0; k < before; ++k) add(groups[compared_[k]]);
  add_foreign(0, foreign_before);
  return fresh;
}

}  // namespace kinesphere
