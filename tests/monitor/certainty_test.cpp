// Certain verdicts are true: tolerances of stretched separations, reports from the future, and answers after
// reports that imply less than earlier certificates.
#include <gtest/gtest.h>

#include <cmath>

#include "kinesphere/monitor/monitor.hpp"
#include "kinesphere/random.hpp"

namespace kinesphere::certainty_test {
namespace {

Verdict verdict_at(const Separation& separation, double tolerance, const Vec3& way,
                   const ErrorBound& error = {}) {
  Monitor monitor = Monitor::create({.classes = {{.acceleration_limit = 0.0}},
                                     .separations = {{0, 0, {separation}}},
                                     .tolerance = tolerance})
                        .value();
  monitor.report(1, {}).value();
  monitor.report(2, {.state = {way, {}}, .position_error = error}).value();
  for (const MonitorEvent& event : monitor.events(1.0)) static_cast<void>(event);
  return monitor.answer(1, 2)->verdict;
}

TEST(MonitorCertainty, WithinATallEllipsoidIsNoFartherOutsideThanTheTolerance) {
  const Separation tall = Separation::ellipsoid(1.0, 1000.0);
  EXPECT_EQ(verdict_at(tall, 0.5, {0, 0, 999.9}), Verdict::within);
  EXPECT_EQ(verdict_at(tall, 0.5, {0, 0, 1249.0}, ErrorBound::cylinder(0, 250)), Verdict::undecided);
  EXPECT_NE(verdict_at(tall, 0.5, {0, 0, 999.0}, ErrorBound::cylinder(0, 2.0)), Verdict::within);
  EXPECT_EQ(verdict_at(tall, 0.5, {0, 0, 999.0}, ErrorBound::cylinder(0, 1.4)), Verdict::within);
  EXPECT_EQ(verdict_at(tall, 0.5, {0, 0, 1000.1}), Verdict::apart);
}

/// Returns a lower limit of the distance of a point from an ellipsoid around the origin: to the nearest of
/// many points of its surface.
double outside(double horizontal, double vertical, double flat, double upright) {
  double least = INFINITY;
  for (int k = 0; k <= 20'000; ++k) {
    const double angle = std::acos(-1.0) / 2.0 * k / 20'000;
    least = std::min(least,
                     std::hypot(flat - horizontal * std::cos(angle), upright - vertical * std::sin(angle)));
  }
  return least;
}

TEST(MonitorCertainty, WithinAnyEllipsoidIsNoFartherOutsideThanTheTolerance) {
  Random random(38);
  int within = 0;
  for (int k = 0; k < 300; ++k) {
    const double horizontal = std::exp(random.uniform(-2.0, 4.0)),
                 vertical = std::exp(random.uniform(-2.0, 4.0));
    const double tolerance = 0.1 * std::min(horizontal, vertical);
    const double angle = random.uniform(0.0, 1.5), far = random.uniform(0.9, 1.3);
    const double flat = far * horizontal * std::cos(angle), upright = far * vertical * std::sin(angle);
    const double error = random.uniform(0.0, 2.0) * tolerance;
    if (verdict_at(Separation::ellipsoid(horizontal, vertical), tolerance, {flat, 0, upright}, error) !=
        Verdict::within)
      continue;
    // The farthest possible place of the track.
    for (double turn = 0.0; turn < 6.3; turn += 0.05) {
      const double x = std::abs(flat + error * std::cos(turn)),
                   z = std::abs(upright + error * std::sin(turn));
      if (std::hypot(x / horizontal, z / vertical) <= 1.0) continue;
      EXPECT_LE(outside(horizontal, vertical, x, z), tolerance * 1.001) << horizontal << ' ' << vertical;
    }
    ++within;
  }
  EXPECT_GT(within, 30);
}

TEST(MonitorCertainty, ReportsFromAfterNowLeaveRoomForTheirRoundings) {
  Random random(39);
  for (int k = 0; k < 20'000; ++k) {
    const double position = 1e6 * random.uniform(1.0, 2.0), velocity = 1e6 * random.uniform(1.0, 2.0);
    const double ahead = random.uniform(0.2, 1.2);
    const long double truth = static_cast<long double>(position) - static_cast<long double>(velocity) * ahead;
    Monitor monitor = Monitor::create({.start_time = 0.0,
                                       .classes = {{.acceleration_limit = 0.0}},
                                       .separations = {{0, 0, {Separation::sphere(1.0)}}},
                                       .tolerance = 1e-6})
                          .value();
    monitor.report(1, {.timestamp = ahead, .state = {{position, 0, 0}, {velocity, 0, 0}}}).value();
    const auto other = static_cast<double>(truth + 1.0L);
    const long double distance = static_cast<long double>(other) - truth;
    monitor.report(2, {.timestamp = 0.0, .state = {{other, 0, 0}, {velocity, 0, 0}}}).value();
    const PairAnswer answer = monitor.answer(1, 2).value();
    EXPECT_LE(answer.lower, distance) << position << ' ' << velocity << ' ' << ahead;
    EXPECT_GE(answer.upper, distance) << position << ' ' << velocity << ' ' << ahead;
    if (distance <= 1.0L) {
      EXPECT_NE(answer.verdict, Verdict::apart);
    }
  }
}

TEST(MonitorCertainty, ReportsFromAfterNowCountInFullFromTheirStamp) {
  Monitor monitor = Monitor::create({.start_time = 0.0,
                                     .classes = {{.acceleration_limit = 2.0}},
                                     .separations = {{0, 0, {Separation::sphere(10.0)}}}})
                        .value();
  monitor.report(1, {.timestamp = 10.0}).value();
  monitor.report(2, {.timestamp = 10.0, .state = {{40, 0, 0}, {}}}).value();
  std::vector<MonitorEvent> events;
  for (const MonitorEvent& event : monitor.events(10.0)) events.push_back(event);
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].time, 0.0);
  EXPECT_EQ(events[0].verdict, Verdict::undecided);
  EXPECT_EQ(events[1].time, 10.0);
  EXPECT_EQ(events[1].verdict, Verdict::apart);
  EXPECT_NEAR(monitor.track(1)->places[0].radius.total(), 0.0, 1e-6);
}

TEST(MonitorCertainty, AnswersKeepWhatWasCertifiedBefore) {
  // Apart until 2 1/2 2 t^2 = 10.
  Monitor monitor = Monitor::create({.classes = {{.acceleration_limit = 2.0}},
                                     .separations = {{0, 0, {Separation::sphere(20.0)}}},
                                     .window = 4.0})
                        .value();
  monitor.report(1, {.timestamp = 0.5}).value();
  monitor.report(2, {.timestamp = 0.5, .state = {{30, 0, 0}, {}}}).value();
  EXPECT_TRUE(monitor.advance(1.0).value() == std::nullopt);
  // By itself this report, which soon implies more than the first one, leaves a pair open that was certified
  // apart.
  TrackReport rough{.timestamp = 1.0, .position_error = 15.0};
  rough.plan = TrackReport::Plan{.acceleration = {}, .acceleration_limit = 0.0};
  monitor.report(1, rough).value();
  EXPECT_TRUE(monitor.advance(1.0).value() == std::nullopt);
  const PairAnswer answer = monitor.answer(1, 2).value();
  EXPECT_LT(answer.lower, 20.0);
  EXPECT_EQ(answer.verdict, Verdict::apart);
  EXPECT_NEAR(answer.until, 0.5 + std::sqrt(5.0), 1e-6);
  const auto event = monitor.advance(10.0).value();
  ASSERT_TRUE(event.has_value());
  EXPECT_GE(event->time, answer.until);
}

}  // namespace
}  // namespace kinesphere::certainty_test
