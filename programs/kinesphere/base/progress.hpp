// A bar that shows how far a run has come, on terminals only.
#pragma once

#include <chrono>
#include <string>

namespace kinesphere::program {

/// Rewrites one line of stderr at most ten times a second and wipes it at destruction; does nothing if stderr
/// is no terminal.
class Progress {
 public:
  Progress(double begin, double end);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  bool visible() const { return visible_; }
  void show(double time);

 private:
  using Clock = std::chrono::steady_clock;

  double begin_;
  double end_;
  bool visible_;
  Clock::time_point started_;
  Clock::time_point next_;
};

/// Returns the text of the bar. `elapsed` and `total` are seconds of simulated time, `spent` is seconds of
/// real time.
std::string progress_line(double elapsed, double total, double spent);

}  // namespace kinesphere::program
