// Pace notices that time will practically never reach the end of a call.
#pragma once

#include <cstdint>

#include "bodies/bodies.hpp"
#include "kinesphere/result.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

/// Measures how far time goes in each block of instants without an event. Bodies stay in their safe regions
/// for the shorter the larger their limits are: a limit of 1e30 in place of "any" makes times of 1e-12 to
/// 1e-17.
class Pace {
 public:
  /// Begins a call that advances from `time` to `until`.
  void begin_call(double time, double until) {
    until_ = until;
    restart(time);
  }
  /// Counts anew, from an event on.
  void restart(double time) {
    begin_ = time;
    instants_ = 0;
  }
  /// Counts an instant. Returns an error that names the body with the loosest promise if, at the pace of the
  /// last block, the end of the call is more instants away than a processor can work off in a day.
  Result<void> note_instant(const Bodies& bodies, double time) {
    return ++instants_ < block ? Result<void>() : check(bodies, time);
  }

 private:
  /// Instants between two checks: more than a crowded moment has. They take a second, or several where each
  /// calls a slow probe.
  static constexpr std::uint32_t block = 1u << 20;
  /// Instants for each 1024 bodies that a call may have left: at half a microsecond each they take 38 hours.
  static constexpr double most_instants = 0x1p38;
  /// A call that advances farther (time) goes on until an event, and gets no error.
  static constexpr double longest_call = 1e6;

  [[gnu::cold]] Result<void> check(const Bodies& bodies, double time);

  double until_ = -infinity;  ///< end of the call
  double begin_ = 0.0;        ///< of the block
  std::uint32_t instants_ = 0;
};

}  // namespace kinesphere
