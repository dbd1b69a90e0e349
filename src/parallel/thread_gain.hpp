// ThreadGain decides whether several threads work, or one alone, because the processors are busy with
// something else. The outcome of a run does not depend on the decision.
#pragma once

#include <algorithm>
#include <chrono>
#include <utility>

namespace kinesphere {

class ThreadGain {
 public:
  using Clock = std::chrono::steady_clock;

  /// Returns true if several threads should do the work that comes next. Calls now() only while the threads
  /// stand back.
  template <class Now>
  bool uses_threads(Now now) {
    if (stands_back_ && now() >= back_at_) stands_back_ = false;
    return !stands_back_;
  }
  /// Notes parallel sections that took `wall` seconds until `now`, in which all threads together had `cpu`
  /// seconds of processor time. The threads stand back if that is hardly more than one thread would have
  /// had: for longer, the more often that has been so.
  void note_sharing(double cpu, double wall, Clock::time_point now) {
    cpu_ += cpu;
    wall_ += wall;
    if (wall_ < least_wall) return;
    const double sharing = std::exchange(cpu_, 0.0) / std::exchange(wall_, 0.0);
    stands_back_ = sharing < least_sharing;
    pause_ = stands_back_ ? std::min(2 * pause_, longest_pause) : shortest_pause / 2;
    back_at_ = now + pause_;
  }

 private:
  /// Real time of the parallel sections of one look at processor times (seconds): some slices of a busy
  /// system.
  static constexpr double least_wall = 0.003;
  /// Processor time of all threads for each second. One free processor gives 1.
  static constexpr double least_sharing = 1.2;
  // In these times a look takes 3 percent and less.
  static constexpr auto shortest_pause = std::chrono::milliseconds(100);
  static constexpr auto longest_pause = std::chrono::milliseconds(1600);

  bool stands_back_ = false;
  std::chrono::milliseconds pause_ = shortest_pause / 2;  ///< in which the threads stand back
  Clock::time_point back_at_{};
  double cpu_ = 0.0;  ///< of the look in progress, as wall_
  double wall_ = 0.0;
};

}  // namespace kinesphere
