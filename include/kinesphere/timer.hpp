// Timers: events of the caller's own, in the order of all others.
#pragma once

#include <cstdint>

namespace kinesphere {

/// An event of the caller's own at a known time, such as a sample of a measurement, the next wave of a game,
/// or a thermostat (World::schedule).
struct Timer {
  /// When EventKind::timer comes: after all other events of this time. Not before the present.
  double time = 0.0;
  /// Event::first_user_data of the event. Several timers may have the same.
  std::uint64_t user_data = 0;
  /// The timer comes again after each period (time, >= 0), at `time` + k `period`; once if it is 0.
  double period = 0.0;

  friend constexpr bool operator==(const Timer&, const Timer&) = default;
};

}  // namespace kinesphere
