// SIGINT and SIGTERM as something to look at and wait for.
#pragma once

namespace kinesphere::program {

/// While there is one, the first of each of these signals does not stop the program, but asks it to end. One
/// at a time.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  bool asked() const;
  /// Can be read from as soon as the program is asked to stop: for poll().
  int descriptor() const;
};

}  // namespace kinesphere::program
