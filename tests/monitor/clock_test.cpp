// The clock of a monitor: its start, and progress in few steps for any unit of time.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "kinesphere/limits.hpp"
#include "kinesphere/monitor/monitor.hpp"

namespace kinesphere::clock_test {
namespace {

MonitorDefinition definition() {
  return {.classes = {{.acceleration_limit = 1.0}}, .separations = {{0, 0, {Separation::sphere(5.0)}}}};
}

TrackReport at(double stamp, const Vec3& position, const Vec3& velocity = {}) {
  return {.timestamp = stamp, .state = {position, velocity}};
}

std::size_t events_until(Monitor& monitor, double time) {
  std::size_t events = 0;
  for (const MonitorEvent& event : monitor.events(time)) {
    static_cast<void>(event);
    ++events;
  }
  return events;
}

TEST(MonitorClock, StartsAtTheFirstReport) {
  Monitor monitor = Monitor::create(definition()).value();
  EXPECT_EQ(monitor.time(), 0.0);
  // Polling without events does not start the clock.
  EXPECT_EQ(events_until(monitor, monitor.time()), 0u);
  EXPECT_EQ(Monitor::restore(monitor.save())->time(), 0.0);
  monitor.report(7, at(1.7e9, {0, 0, 100}, {20, 0, 0})).value();
  EXPECT_EQ(monitor.time(), 1.7e9);
  monitor.report(8, at(1.7e9, {0, 0, 200}, {20, 0, 0})).value();
  EXPECT_EQ(events_until(monitor, 1.7e9 + 0.5), 0u);
  EXPECT_EQ(monitor.answer(7, 8)->verdict, Verdict::apart);
  EXPECT_LE(monitor.counters().searches, 4u);
  EXPECT_EQ(monitor.advance(1.7e9).error().code, ErrorCode::time_backwards);
}

TEST(MonitorClock, StartsAtTheFirstTimeThatItIsAdvancedTo) {
  Monitor monitor = Monitor::create(definition()).value();
  EXPECT_EQ(events_until(monitor, -50.0), 0u);
  EXPECT_EQ(monitor.time(), -50.0);
  monitor.report(1, at(-49.0, {})).value();
  EXPECT_EQ(monitor.time(), -50.0);
  EXPECT_EQ(monitor.advance(-51.0).error().code, ErrorCode::time_backwards);
}

TEST(MonitorClock, IsNotSetByAReportThatIsRefused) {
  Monitor monitor = Monitor::create(definition()).value();
  EXPECT_FALSE(monitor.report(1, {.timestamp = 5.0, .track_class = 3}));
  EXPECT_EQ(monitor.time(), 0.0);
  monitor.report(1, at(4.0, {})).value();
  EXPECT_EQ(monitor.time(), 4.0);
}

/// From `start` on two passing tracks are reported three times, `step` apart.
void expect_few_steps(MonitorDefinition definition, double start, double first, double step) {
  definition.start_time = start;
  Monitor monitor = Monitor::create(definition).value();
  for (int k = 0; k < 3; ++k) {
    const double time = first + k * step;
    monitor.report(1, at(time, {0, 0, 0}, {1, 0, 0})).value();
    monitor.report(2, at(time, {0, 100, 0}, {1, 0, 0})).value();
    EXPECT_LT(events_until(monitor, time), 20u);
    EXPECT_EQ(monitor.time(), std::max(start, time));
  }
  EXPECT_LT(monitor.counters().searches, 10'000u) << start << ' ' << first << ' ' << step;
  EXPECT_LT(monitor.counters().rechecks, 100'000u) << start << ' ' << first << ' ' << step;
}

TEST(MonitorClock, GetsAnywhereInFewSteps) {
  // Unix seconds, milliseconds, microseconds and nanoseconds; from zero and from the present.
  for (const double now : {1.7e9, 1.7e12, 1.7e15, 1.7e18})
    for (const double start : {0.0, now})
      for (const double step : {1.0, 1000.0, 1e6}) expect_few_steps(definition(), start, now, step);
}

TEST(MonitorClock, GetsAnywhereInFewStepsWithWindowsAndResolutionsOfAllSizes) {
  for (const double window : {limits::least_time, 1e-12, 1e-3, 1e3, 1e12, limits::largest_time})
    for (const double resolution : {limits::least_time, 1e-12, 1.0, limits::largest_time})
      for (const double now : {0.0, -3.0, 1.7e9, -1.7e15, 1e30}) {
        MonitorDefinition extreme = definition();
        extreme.window = window;
        extreme.time_resolution = resolution;
        expect_few_steps(extreme, now, now, 0.0);
        expect_few_steps(extreme, -1e30, now, 0.0);
        if (now < 1e30) expect_few_steps(extreme, now, now, 100.0);
      }
}

/// One track reports each second for 1000 seconds and passes one of 200 others; returns the number of
/// searches.
std::uint64_t searches_among(bool others_report) {
  Monitor monitor =
      Monitor::create({.classes = {{.acceleration_limit = 1.0}, {.largest_speed = ErrorBound(0.001)}},
                       .separations = {{0, 1, {Separation::sphere(5.0)}}}})
          .value();
  std::size_t within = 0;
  for (int second = 0; second < 1000; ++second) {
    for (TrackId other = 1; other <= 200; ++other) {
      TrackReport report = at(second, {1000.0 * static_cast<double>(other - 1), 3, 0});
      report.track_class = 1;
      if (second == 0 || others_report) monitor.report(other, report).value();
    }
    monitor.report(1000, at(second, {second - 500.0, 0, 0}, {1, 0, 0})).value();
    for (const MonitorEvent& event : monitor.events(second))
      if (event.kind == MonitorEventKind::verdict && event.verdict == Verdict::within) ++within;
  }
  EXPECT_GE(within, 1u) << "the two pass each other at 3 m";
  return monitor.counters().searches;
}

TEST(MonitorClock, TracksWithNothingAroundAreSeldomSearchedFor) {
  EXPECT_LT(searches_among(false), 201u * 20u);
  EXPECT_LT(searches_among(true), 201u * 20u);
}

TEST(MonitorClock, MissesNothingInAGap) {
  // Two tracks approach at speed 1 each from 20,000 apart, without accelerations and further reports.
  MonitorDefinition exact = definition();
  exact.classes[0].acceleration_limit = 0.0;
  Monitor monitor = Monitor::create(exact).value();
  monitor.report(1, at(1e6, {0, 0, 0}, {1, 0, 0})).value();
  monitor.report(2, at(1e6, {20'000, 0, 0}, {-1, 0, 0})).value();
  std::vector<MonitorEvent> events;
  for (const MonitorEvent& event : monitor.events(2e6)) events.push_back(event);
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].verdict, Verdict::within);
  EXPECT_NEAR(events[0].time, 1e6 + 10'000 - 2.5, 2e-3);
  EXPECT_EQ(events[1].verdict, Verdict::apart);
  EXPECT_LT(monitor.counters().searches, 200u);
}

TEST(MonitorClock, RefusesWhatCannotWork) {
  for (const double value : {0.0, -1.0, 1e-300, 1e300, std::nan("")}) {
    MonitorDefinition wrong = definition();
    wrong.window = value;
    EXPECT_NE(Monitor::create(wrong).error().message.find("window"), std::string::npos);
    wrong = definition();
    wrong.time_resolution = value;
    EXPECT_NE(Monitor::create(wrong).error().message.find("time_resolution"), std::string::npos);
  }
  Monitor monitor = Monitor::create(definition()).value();
  EXPECT_EQ(monitor.advance(1e31).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(monitor.report(1, {.timestamp_error = 1e31}).error().code, ErrorCode::out_of_range);
}

}  // namespace
}  // namespace kinesphere::clock_test
