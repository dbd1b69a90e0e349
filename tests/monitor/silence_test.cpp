// Tracks that become stale and resume, repeatedly.
#include <gtest/gtest.h>

#include "kinesphere/monitor/monitor.hpp"

namespace kinesphere::silence_test {
namespace {

TEST(Silence, LeavesNothingBehindWhenItIsOver) {
  Monitor monitor = Monitor::create({.classes = {{.largest_speed = 1.0}},
                                     .separations = {{0, 0, {Separation::sphere(1.0)}}},
                                     .stale_after = 10.0,
                                     .drop_after = 1000.0})
                        .value();
  const auto size_after = [&](int cycles) {
    for (int k = 0; k < cycles; ++k) {
      const double stamp = monitor.time() + 20.0;
      for (const MonitorEvent& event : monitor.events(stamp)) EXPECT_EQ(event.kind, MonitorEventKind::stale);
      monitor.report(1, {.timestamp = stamp, .position_error = 0.1, .velocity_error = 1.0}).value();
      for (const MonitorEvent& event : monitor.events(stamp))
        EXPECT_EQ(event.kind, MonitorEventKind::resumed);
    }
    return monitor.save().size();
  };
  const std::size_t few = size_after(10);
  EXPECT_EQ(size_after(1000), few);
}

}  // namespace
}  // namespace kinesphere::silence_test
