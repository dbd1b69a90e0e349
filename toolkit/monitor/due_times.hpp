// DueTimes is a queue of the times at which something is due.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <queue>
#include <tuple>
#include <vector>

#include "number/infinity.hpp"

namespace kinesphere {

/// A due time. It counts as long as what it is about is still due at this time; otherwise it is stale, and
/// whoever takes it ignores it.
struct DueTime {
  /// What is due: a track may leave its region, a pair has to be decided again, or a track is silent for
  /// long.
  enum class About : std::uint8_t { region, pair, silence };
  double time = 0.0;
  About about = About::region;
  std::uint32_t first = 0;   ///< number of the track, or of the first one of the pair
  std::uint32_t second = 0;  ///< of a pair: number of the second track, greater than the first

  friend bool operator>(const DueTime& a, const DueTime& b) {
    return a.time != b.time ? a.time > b.time
                            : std::tie(a.about, a.first, a.second) > std::tie(b.about, b.first, b.second);
  }
};

/// Due times in ascending order, stale ones included.
class DueTimes {
 public:
  std::size_t size() const { return queue_.size(); }
  /// Returns the first time, or +infinity if there is none.
  double next_time() const { return queue_.empty() ? infinity : queue_.top().time; }
  /// Removes the first one. Precondition: there is one.
  DueTime take_first() {
    const DueTime first = queue_.top();
    queue_.pop();
    return first;
  }
  void add(const DueTime& due) { queue_.push(due); }
  void clear() { queue_ = {}; }
  /// True if a third of the due times are stale when `live` ones count: then they are to be added anew. Times
  /// that are changed again and again before they come would fill the queue.
  bool are_stale(std::size_t live) const { return size() > 64 + live + live / 2; }

 private:
  std::priority_queue<DueTime, std::vector<DueTime>, std::greater<>> queue_;
};

}  // namespace kinesphere
