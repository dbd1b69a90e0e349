// A poll that fails at a window start leaves the monitor as if it had not been called.
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <vector>

#include "kinesphere/monitor/monitor.hpp"

namespace kinesphere::failed_poll_test {
namespace {

/// At time 1 windows end. Track 1 is requested, since its plan ends in the next window.
Monitor watching() {
  Monitor monitor = Monitor::create({.start_time = 0.0,
                                     .classes = {{.acceleration_limit = 1.0, .largest_speed = 100.0}},
                                     .separations = {{0, 0, {Separation::sphere(5.0)}}}})
                        .value();
  TrackReport planned{.timestamp = 0.0, .state = {{0, 900, 0}, {}}};
  planned.plan = TrackReport::Plan{{0, 0, 0.5}, 0.5, 1.5};
  monitor.report(1, planned).value();
  monitor.report(2, {.timestamp = 0.0, .state = {{0, 0, 0}, {20, 0, 0}}}).value();
  return monitor;
}

/// A track that is added then is registered in the window that begins, while all others wait for it.
/// Regression: their start took its grid level away, and it was never found again.
void expect_to_see_who_comes_then(Monitor monitor) {
  ASSERT_EQ(monitor.time(), 1.0);
  monitor.report(3, {.timestamp = 1.0, .state = {{50, 0, 0}, {-20, 0, 0}}}).value();
  const auto restored = Monitor::restore(monitor.save());
  EXPECT_TRUE(restored) << restored.error().message;
  std::vector<MonitorEvent> events;
  for (const MonitorEvent& event : monitor.events(1.9)) events.push_back(event);
  const auto again = Monitor::restore(monitor.save());
  EXPECT_TRUE(again) << again.error().message;
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events.front().first, 2u);
  EXPECT_EQ(events.front().second, 3u);
  EXPECT_NE(monitor.answer(2, 3)->verdict, Verdict::apart);
}

TEST(FailedPoll, LosesNobodyAfterABadAnswer) {
  Monitor monitor = watching();
  const auto failed = monitor.advance(1.5, [](auto, double time, auto reports) {
    for (auto& report : reports)
      report =
          TrackReport{.timestamp = time, .state = {{std::numeric_limits<double>::quiet_NaN(), 0, 0}, {}}};
  });
  ASSERT_FALSE(failed);
  expect_to_see_who_comes_then(std::move(monitor));
}

TEST(FailedPoll, LosesNobodyAfterAnException) {
  Monitor monitor = watching();
  EXPECT_THROW(static_cast<void>(
                   monitor.advance(1.5, [](auto, double, auto) { throw std::runtime_error("no answer"); })),
               std::runtime_error);
  expect_to_see_who_comes_then(std::move(monitor));
}

}  // namespace
}  // namespace kinesphere::failed_poll_test
