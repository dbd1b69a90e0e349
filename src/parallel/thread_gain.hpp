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
  /// had: twice as long each time in a row.
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
  /// Minimum real time of a measurement (seconds): several time slices of a busy system.
  static constexpr double least_wall = 0.003;
  /// Least CPU time of all threads per second for which several threads pay. One free processor gives 1.
  static constexpr double least_sharing = 1.2;
  // Pauses without threads. A measurement of `least_wall` takes at most 3 percent of them.
  static constexpr auto shortest_pause = std::chrono::milliseconds(100);
  static constexpr auto longest_pause = std::chrono::milliseconds(1600);

  bool stands_back_ = false;
  std::chrono::milliseconds pause_ = shortest_pause / 2;  ///< without threads
  Clock::time_point back_at_{};
  double cpu_ = 0.0;   ///< CPU seconds of the measurement in progress
  double wall_ = 0.0;  ///< its real seconds
};

}  // namespace kinesphere
