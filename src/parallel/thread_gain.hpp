// ThreadGain decides from measured times whether several threads save time, or one thread should work alone:
// the processors may be busy with something else, and optimistic execution has a price of its own. The
// outcome of a run does not depend on the decision.
//
// Two signs are looked at. Where the threads get hardly more processor time than one thread would, they stand
// back within milliseconds. Otherwise the costs of both ways are compared, which takes a trial of the other
// way; where they get much more, a short run has none.
#pragma once

#include <algorithm>
#include <array>
#include <utility>

namespace kinesphere {

class ThreadGain {
 public:
  /// Returns true if several threads should do the work that comes next.
  bool uses_threads() const { return uses_threads_; }

  /// Notes parallel sections that took `wall` seconds, in which all threads together had `cpu` seconds of
  /// processor time. Returns true if the threads stand back from now on: the caller then begins a new
  /// measurement for note().
  bool note_sharing(double cpu, double wall) {
    shared_cpu_ += cpu;
    shared_wall_ += wall;
    if (!uses_threads_ || shared_wall_ < least_shared) return false;
    const double sharing = std::exchange(shared_cpu_, 0.0) / std::exchange(shared_wall_, 0.0);
    shares_well_ = sharing > good_sharing;
    if (sharing > least_sharing) return false;
    seconds_ = work_ = 0.0;
    settle(false);
    return true;
  }
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
    if (is_trial_) return settle(cost_[1] < largest_cost * cost_[0]);
    if (--until_trial_ > 0) return;
    if (shares_well_ && first_measurements_ < most_first_measurements) {
      ++first_measurements_;
      until_trial_ = 1;
      return;
    }
    first_measurements_ = most_first_measurements;
    is_trial_ = true;
    uses_threads_ = !uses_threads_;
  }

 private:
  /// Ends a trial, or the use of threads.
  void settle(bool uses_threads) {
    const bool changes = is_trial_ ? uses_threads == uses_threads_ : uses_threads != uses_threads_;
    pause_ = changes ? shortest_pause : std::min(2 * pause_, longest_pause);
    is_trial_ = false;
    uses_threads_ = uses_threads;
    until_trial_ = pause_;
  }

  /// Wall time of one measurement. In a shorter one the switches of threads count too much; a longer one
  /// costs more where the other way is slow.
  static constexpr double least_seconds = 0.005;
  /// Wall time of the parallel sections of one look at processor times: some slices of a busy system.
  static constexpr double least_shared = 0.003;
  // Processor time of all threads for each second. One free processor gives 1.
  static constexpr double least_sharing = 1.2;
  static constexpr double good_sharing = 1.6;
  /// Measurements before the first trial where threads share well: where they lose nevertheless, these are
  /// lost; a run that is not longer has no trial.
  static constexpr int most_first_measurements = 4;
  /// Share of the costs of one thread that several may have at most.
  static constexpr double largest_cost = 0.97;
  // Measurements between two trials of the other way: more, the longer the decision holds.
  static constexpr int shortest_pause = 16;
  static constexpr int longest_pause = 256;

  bool uses_threads_ = true;
  bool is_trial_ = false;  ///< of the way that is used now
  int until_trial_ = 1;    ///< measurements until the other way is tried
  int first_measurements_ = 1;
  bool shares_well_ = false;  ///< at the last look
  int pause_ = shortest_pause / 2;
  std::array<double, 2> cost_{};  ///< seconds for a unit of work: alone, with threads
  double seconds_ = 0.0;          ///< of the measurement in progress, as work_
  double work_ = 0.0;
  double shared_cpu_ = 0.0;  ///< of the look in progress, as shared_wall_
  double shared_wall_ = 0.0;
};

}  // namespace kinesphere
