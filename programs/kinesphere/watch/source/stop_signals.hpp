// Turns SIGINT, SIGTERM and SIGHUP into a flag and a descriptor to wait for.
#pragma once

namespace kinesphere::program {

/// While an object lives, the first of each of these signals requests the program to end and does not stop
/// it. SIGHUP is left alone where it is ignored, as under nohup. At most one object may exist.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  bool asked() const;
  /// Readable as soon as the program is asked to stop; for poll().
  int descriptor() const;
};

}  // namespace kinesphere::program
