// A plan replaces the acceleration limit of its class, whatever was certain before it came.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "kinesphere/monitor/monitor.hpp"

namespace kinesphere::plan_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Two tracks of a class with an acceleration limit of 1, and a separation of 5.
Monitor made() {
  return Monitor::create(
             {.classes = {{.acceleration_limit = 1.0}}, .separations = {{0, 0, {Separation::sphere(5.0)}}}})
      .value();
}

TrackReport at(double stamp, double height, double speed = 0.0) {
  return {.timestamp = stamp, .state = {{0, 0, height}, {0, 0, speed}}};
}

TrackReport falls(double stamp, double height, double speed = 0.0, double until = infinity) {
  TrackReport report = at(stamp, height, speed);
  report.plan = TrackReport::Plan{{0, 0, -10.0}, 0.1, until};
  return report;
}

/// Goes on in small steps to the time; at each the monitor's limits must contain the height above track 2.
template <class Height>
void go_to(Monitor& monitor, double until, Height height) {
  for (double time = monitor.time(); time <= until; time += 0.01) {
    for (const MonitorEvent& event : monitor.events(time)) static_cast<void>(event);
    const PairAnswer answer = monitor.answer(1, 2).value();
    const double distance = std::abs(height(time));
    EXPECT_LE(answer.lower, distance + 1e-9) << time;
    EXPECT_GE(answer.upper, distance - 1e-9) << time;
    if (distance <= 5.0) {
      EXPECT_NE(answer.verdict, Verdict::apart) << time;
    }
    if (distance > 5.1) {
      EXPECT_NE(answer.verdict, Verdict::within) << time;
    }
  }
}

TEST(MonitorPlan, GoesBeyondItsClass) {
  Monitor monitor = made();
  monitor.report(1, falls(0.0, 100.0)).value();
  monitor.report(2, at(0.0, 0.0)).value();
  go_to(monitor, 4.4, [](double t) { return 100.0 - 5.0 * t * t; });
  EXPECT_NE(monitor.answer(1, 2)->verdict, Verdict::apart);
}

TEST(MonitorPlan, EndsWhatWasCertainBeforeItCameIn) {
  Monitor monitor = made();
  monitor.report(1, at(0.0, 100.0)).value();
  monitor.report(2, at(0.0, 0.0)).value();
  EXPECT_TRUE(monitor.advance(0.5).value() == std::nullopt);
  EXPECT_GT(monitor.answer(1, 2)->until, 9.0);
  monitor.report(1, falls(0.5, 100.0)).value();
  go_to(monitor, 4.95, [](double t) { return 100.0 - 5.0 * (t - 0.5) * (t - 0.5); });
}

TEST(MonitorPlan, StaysInForceWhenAReportWithoutOneComes) {
  Monitor monitor = made();
  monitor.report(1, falls(0.0, 100.0)).value();
  monitor.report(2, at(0.0, 0.0)).value();
  EXPECT_TRUE(monitor.advance(1.0).value() == std::nullopt);
  monitor.report(1, at(1.0, 95.0, -10.0)).value();
  EXPECT_EQ(monitor.counters().contradictions, 0u);
  go_to(monitor, 4.4, [](double t) { return 100.0 - 5.0 * t * t; });
  // A late report, from before the plan ended and after.
  monitor.report(1, at(0.7, 100.0 - 5.0 * 0.49, -7.0)).value();
  EXPECT_EQ(monitor.counters().contradictions, 0u);
  go_to(monitor, 4.6, [](double t) { return 100.0 - 5.0 * t * t; });
}

TEST(MonitorPlan, GivesWayToItsClassWhenItEnds) {
  // Falls for two seconds, then goes straight on.
  const auto height = [](double t) { return t < 2.0 ? 100.0 - 5.0 * t * t : 80.0 - 20.0 * (t - 2.0); };
  Monitor monitor = made();
  monitor.report(1, falls(0.0, 100.0, 0.0, 2.0)).value();
  monitor.report(2, at(0.0, 0.0)).value();
  go_to(monitor, 3.0, height);
  // The errors are those of the plan in 2 s, and of the two classes since and from the start.
  const PairAnswer answer = monitor.answer(1, 2).value();
  EXPECT_NEAR(answer.lower, 60.0 - (0.2 + 0.2 + 0.5) - 4.5, 1e-6);
  go_to(monitor, 6.0, height);
}

TEST(MonitorPlan, BeginsInTheFuture) {
  // The report is ahead of the clock: the class's limit counts until its timestamp.
  const auto height = [](double t) { return t < 1.0 ? 100.0 : 100.0 - 5.0 * (t - 1.0) * (t - 1.0); };
  Monitor monitor = made();
  monitor.report(2, at(0.0, 0.0)).value();
  monitor.report(1, falls(1.0, 100.0)).value();
  go_to(monitor, 5.4, height);
}

TEST(MonitorPlan, CountsFromAStampThatMayBeWrong) {
  // The track falls from 0.3 on, as its report says of a time with an error of up to 0.3.
  for (const double off : {-0.3, 0.0, 0.3}) {
    const auto height = [off](double t) { return t < off ? 100.0 : 100.0 - 5.0 * (t - off) * (t - off); };
    Monitor monitor = made();
    monitor.report(2, at(0.0, 0.0)).value();
    TrackReport report = falls(0.0, 100.0);
    report.timestamp_error = 0.3;
    monitor.report(1, report).value();
    go_to(monitor, 4.6, height);
  }
}

TEST(MonitorPlan, ThatIsLateKeepsTheLatestState) {
  Monitor monitor = made();
  monitor.report(2, at(0.0, 0.0)).value();
  EXPECT_TRUE(monitor.advance(1.0).value() == std::nullopt);
  monitor.report(1, at(1.0, 95.0, -10.0)).value();
  monitor.report(1, falls(0.0, 100.0)).value();
  EXPECT_EQ(monitor.counters().contradictions, 0u);
  EXPECT_EQ(monitor.track(1)->timestamp, 1.0);
  EXPECT_NEAR(monitor.track(1)->places[0].radius.total(), 0.0, 1e-9);
  go_to(monitor, 4.4, [](double t) { return 100.0 - 5.0 * t * t; });
}

TEST(MonitorPlan, WithinItsClassEndsNothing) {
  Monitor monitor = Monitor::create({.classes = {{.acceleration_limit = 11.0}},
                                     .separations = {{0, 0, {Separation::sphere(5.0)}}}})
                        .value();
  monitor.report(1, at(0.0, 100.0)).value();
  monitor.report(2, at(0.0, 0.0)).value();
  EXPECT_TRUE(monitor.advance(0.25).value() == std::nullopt);
  const double until = monitor.answer(1, 2)->until;
  TrackReport report = falls(0.25, 100.0);
  report.position_error = 50.0;
  monitor.report(1, report).value();
  EXPECT_TRUE(monitor.advance(0.25).value() == std::nullopt);
  EXPECT_EQ(monitor.answer(1, 2)->verdict, Verdict::apart);
  EXPECT_EQ(monitor.counters().searches, 2u);
  EXPECT_GT(until, 2.0);
}

TEST(MonitorPlan, IsKeptInSnapshots) {
  Monitor monitor = made();
  monitor.report(1, falls(0.0, 100.0, 0.0, 3.0)).value();
  monitor.report(2, at(0.0, 0.0)).value();
  EXPECT_TRUE(monitor.advance(1.0).value() == std::nullopt);
  monitor = Monitor::restore(monitor.save()).value();
  monitor.report(1, at(1.0, 95.0, -10.0)).value();
  go_to(monitor, 4.4, [](double t) { return t < 3.0 ? 100.0 - 5.0 * t * t : 55.0 - 30.0 * (t - 3.0); });
}

}  // namespace
}  // namespace kinesphere::plan_test
