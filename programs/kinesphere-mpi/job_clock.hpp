// JobClock: what a batch system lets a run do, by the clock on the wall and by signals.
#pragma once

#include <chrono>
#include <csignal>
#include <optional>

#include "ranks.hpp"

namespace kinesphere::program {

/// Real times (seconds).
struct JobLimits {
  std::optional<double> time_limit{};  ///< when the run is to stop, and to go on later
  std::optional<double> checkpoint_every{};
  std::optional<double> progress_every{};
  bool heeds_signals = false;  ///< SIGTERM and SIGUSR1 stop the run, as the time limit does

  bool any() const { return time_limit || checkpoint_every || progress_every || heeds_signals; }
};

class JobClock {
 public:
  /// What a run is to do now, the same on all ranks.
  struct Wishes {
    bool stop = false;
    bool checkpoint = false;
    bool progress = false;
  };

  /// The time of the limits begins now. While the clock lives, the process does not end by the signals that
  /// it heeds. There may be one at a time that heeds any.
  JobClock(const Ranks& ranks, const JobLimits& limits);
  JobClock(const JobClock&) = delete;
  JobClock& operator=(const JobClock&) = delete;
  ~JobClock();

  /// True if look() may ever wish anything.
  bool is_watched() const { return limits_.any(); }
  /// Collective. A wish is told once, but for the one to stop.
  Wishes look();
  /// Returns the real time since the clock began (seconds).
  double elapsed() const;

 private:
  const Ranks& ranks_;
  JobLimits limits_;
  std::chrono::steady_clock::time_point began_;
  double next_checkpoint_, next_progress_;
  void (*before_terminate_)(int) = SIG_DFL;
  void (*before_user_)(int) = SIG_DFL;
};

}  // namespace kinesphere::program
