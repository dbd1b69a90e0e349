// Which kicks of islands have been held against all others.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/attempts.hpp"
#include "engine/meetings.hpp"

namespace kinesphere {

class KickComparison {
 public:
  /// A part begins.
  void clear();
  /// These groups have run.
  void note_runs(std::span<const std::uint32_t> groups) {
    uncompared_.insert(uncompared_.end(), groups.begin(), groups.end());
  }
  /// A body that another process kicks.
  void add_foreign(const BodyKick& kick) { foreign_.push_back(kick); }
  bool has_new_foreign() const { return compared_foreign_ < foreign_.size(); }
  /// All kicks of groups that stand, and of other processes: first those that have not been held against
  /// others, as is to be done now. Returns how many these are; if there are none, there are no others.
  std::size_t take(Groups& groups, const Attempts& attempts, std::vector<GroupKick>& kicks);

  /// A group may meet a body that another process kicks.
  void note_meeting(std::uint32_t group, std::uint32_t number) { meetings_.emplace_back(group, number); }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> take_meetings() {
    return std::exchange(meetings_, {});
  }

 private:
  std::vector<std::uint32_t> compared_;  ///< groups, and those that have run since
  std::vector<std::uint32_t> uncompared_;
  std::vector<BodyKick> foreign_;
  std::size_t compared_foreign_ = 0;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> meetings_;
};

}  // namespace kinesphere
