// Timers holds the timers of a world that are still to come.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>

#include "contact/contact_predictor.hpp"
#include "kinesphere/timer.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

class Timers {
 public:
  /// Returns when the next timer comes; infinity if there is none.
  double next() const { return waiting_.empty() ? infinity : waiting_.begin()->time; }
  /// Cost: O(log n) for n timers.
  void add(const Timer& timer) { waiting_.insert({timer.time, ++added_, timer}); }
  /// Removes all timers with these data. Returns how many there were. Cost: O(n).
  std::size_t remove(std::uint64_t user_data) {
    return std::erase_if(waiting_,
                         [=](const Waiting& waiting) { return waiting.timer.user_data == user_data; });
  }
  /// Takes the next timer out, and enters it again if it has a period. Returns its data. Precondition: there
  /// is one.
  std::uint64_t take() {
    Waiting first = waiting_.extract(waiting_.begin()).value();
    const Timer& timer = first.timer;
    if (timer.period > 0.0) {
      // The sum of many periods would drift. Where a period is too short to tell times apart, time goes on by
      // the least step.
      const double next = timer.time + static_cast<double>(++first.rounds) * timer.period;
      first.time = std::max(next, just_after(first.time));
      first.order = ++added_;
      waiting_.insert(first);
    }
    return timer.user_data;
  }

  static void serialize(auto& self, auto& archive) { archive(self.waiting_, self.added_); }
  /// Validates timers that were read from bytes, at the present time.
  bool is_valid(double now) const {
    return std::is_sorted(waiting_.begin(), waiting_.end()) &&
           std::all_of(waiting_.begin(), waiting_.end(), [&](const Waiting& waiting) {
             const auto& [time, order, timer, rounds] = waiting;
             return time >= now && time < infinity && order <= added_ && std::isfinite(timer.time) &&
                    timer.period >= 0.0 && timer.period < infinity;
           });
  }
  std::size_t bytes() const { return waiting_.size() * (sizeof(Waiting) + 4 * sizeof(void*)); }

 private:
  struct Waiting {
    double time = 0.0;         ///< when it comes next
    std::uint64_t order = 0;   ///< of those of one time, the one that was entered first comes first
    Timer timer{};             ///< as it was scheduled
    std::uint64_t rounds = 0;  ///< how often it has come

    friend bool operator<(const Waiting& a, const Waiting& b) {
      return a.time != b.time ? a.time < b.time : a.order < b.order;
    }
    static void serialize(auto& self, auto& archive) {
      auto& [time, order, timer, rounds] = self;
      archive(time, order, timer.time, timer.user_data, timer.period, rounds);
    }
  };

  std::set<Waiting> waiting_;
  std::uint64_t added_ = 0;
};

}  // namespace kinesphere
