// ThreadGain decides from measured times whether several threads save time, or one thread should work alone:
// the processors may be busy with something else, and optimistic execution has a price of its own. The
// outcome of a run does not depend on the decision.
#pragma once

#include <algorithm>
#include <array>

namespace kinesphere {

class ThreadGain {
 public:
  /// Returns true if several threads should do the work that comes next.
  bool uses_threads() const { return uses_threads_; }

  /// Notes that some work took `seconds` of wall time. `work` is its size, in a unit that does not depend on
  /// the number of threads.
  void note(double seconds, double work) {
    seconds_ += seconds;
    work_ += work;
  }
  /// Decides anew if enough has been noted. Call it where work of all kinds has been done, in proportion.
  void decide() {
    if (seconds_ < least_seconds || work_ <= 0.0) return;
    cost_[uses_threads_ ? 1 : 0] = seconds_ / work_;
    seconds_ = work_ = 0.0;
    if (--until_trial_ > 0) return;
    if (until_trial_ == 0) {
      uses_threads_ = !uses_threads_;
      return;
    }
    const bool gains = cost_[1] < largest_cost * cost_[0];
    pause_ = gains == uses_threads_ ? shortest_pause : std::min(2 * pause_, longest_pause);
    uses_threads_ = gains;
    until_trial_ = pause_;
  }

 private:
  /// Wall time of one measurement. In a shorter one the switches of threads count too much; a longer one
  /// costs more where the other way is slow.
  static constexpr double least_seconds = 0.005;
  /// Share of the costs of one thread that several may have at most.
  static constexpr double largest_cost = 0.97;
  // Measurements between two trials of the other way: more, the longer the decision holds.
  static constexpr int shortest_pause = 16;
  static constexpr int longest_pause = 256;

  bool uses_threads_ = true;
  int until_trial_ = 1;  ///< measurements until the other way is tried; 0 during its trial
  int pause_ = shortest_pause / 2;
  std::array<double, 2> cost_{};  ///< seconds for a unit of work: alone, with threads
  double seconds_ = 0.0;          ///< of the measurement in progress, as work_
  double work_ = 0.0;
};

}  // namespace kinesphere
