// Paths of satellites and their bounds, on which a monitor relies.
#include "research/satellites/arc.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "kinesphere/monitor/monitor.hpp"
#include "kinesphere/random.hpp"
#include "research/satellites/monitor_satellites.hpp"
#include "research/satellites/satellite_motion.hpp"

namespace kinesphere::arc_test {
namespace {

/// Returns states on ellipses with perigees from 200 km up and eccentricities up to 0.8.
std::vector<State> random_satellites(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<State> states;
  while (states.size() < count) {
    const double perigee = earth::radius + random.uniform(200.0, 2000.0);
    const double eccentricity = random.uniform() < 0.5 ? random.uniform(0.0, 0.01) : random.uniform(0.0, 0.8);
    const Vec3 up = random.unit_vector();
    const Vec3 side = cross(up, random.unit_vector());
    const double length = norm(side);
    if (length < 0.1) continue;
    const double speed = std::sqrt(earth::gravity * (1.0 + eccentricity) / perigee);
    states.push_back({up * perigee, side * (speed / length)});
  }
  return states;
}

/// Integrates by the classical Runge-Kutta method, in steps of a second.
State integrated(State state, double seconds) {
  const auto change = [](const State& at) { return State{at.velocity, gravity_at(at.position)}; };
  const auto moved = [](const State& from, const State& rate, double time) {
    return State{from.position + rate.position * time, from.velocity + rate.velocity * time};
  };
  for (int k = 0; k < static_cast<int>(seconds); ++k) {
    const State a = change(state), b = change(moved(state, a, 0.5)), c = change(moved(state, b, 0.5)),
                d = change(moved(state, c, 1.0));
    state.position += (a.position + b.position * 2.0 + c.position * 2.0 + d.position) * (1.0 / 6.0);
    state.velocity += (a.velocity + b.velocity * 2.0 + c.velocity * 2.0 + d.velocity) * (1.0 / 6.0);
  }
  return state;
}

TEST(SatelliteMotion, SolvesNewtonsEquation) {
  for (const State& start : random_satellites(20, 1)) {
    SatelliteMotion motion = SatelliteMotion::create({start}).value();
    const State expected = integrated(start, 6000.0);
    const State state = motion.arc(0, 6000.0).state_at(6000.0);
    // The tolerance covers the seams of 47 arcs, each of less than 1e-6 km, and the error of Runge-Kutta.
    EXPECT_LT(norm(state.position - expected.position), 1e-3);
    EXPECT_LT(norm(state.velocity - expected.velocity), 1e-6);
  }
}

TEST(SatelliteMotion, AccelerationIsThatOfGravity) {
  Random random(2);
  for (const State& start : random_satellites(200, 3)) {
    SatelliteMotion motion = SatelliteMotion::create({start}).value();
    const Arc& arc = motion.arc(0, 0.0);
    for (int k = 0; k < 10; ++k) {
      const double time = random.uniform(arc.begin(), arc.end());
      const Vec3 position = arc.position_at(time);
      EXPECT_LT(norm(arc.acceleration_at(time) - gravity_at(position)), 1e-9);
      EXPECT_LE(norm(gravity_at(position)), arc.largest_acceleration());
      EXPECT_LE(norm(position), arc.farthest());
      EXPECT_GE(norm(position), arc.nearest());
    }
  }
}

TEST(SatelliteMotion, SeamsAreWithinTheErrorsThatReportsDeclare) {
  for (const State& start : random_satellites(300, 4)) {
    SatelliteMotion motion = SatelliteMotion::create({start}).value();
    for (double seam = SatelliteMotion::arc_length; seam < 20000.0; seam += SatelliteMotion::arc_length) {
      const State before = motion.arc(0, seam - 1.0).state_at(seam);
      const State after = motion.arc(0, seam).state_at(seam);
      ASSERT_LT(norm(before.position - after.position), SatelliteMotion::position_error);
      ASSERT_LT(norm(before.velocity - after.velocity), SatelliteMotion::velocity_error);
    }
  }
}

TEST(SatelliteMotion, NeverLeavesThePlanOfAReport) {
  Random random(5);
  for (const State& start : random_satellites(300, 6)) {
    SatelliteMotion motion = SatelliteMotion::create({start}).value();
    const Arc arc = motion.arc(0, 0.0);
    const double time = random.uniform(0.0, 120.0);
    const double end = random.uniform(time + 1.0, arc.end());
    const TrackReport report = report_of(arc, time, end);
    for (int k = 0; k < 20; ++k) {
      const double at = random.uniform(time, end);
      const double s = at - time;
      EXPECT_LE(norm(arc.acceleration_at(at) - report.plan->acceleration),
                report.plan->acceleration_limit.total());
      const Vec3 centre =
          report.state.position + (report.state.velocity + report.plan->acceleration * (0.5 * s)) * s;
      const double radius = report.position_error.total() + report.velocity_error.total() * s +
                            0.5 * report.plan->acceleration_limit.total() * s * s;
      EXPECT_LE(norm(arc.position_at(at) - centre), radius);
    }
  }
}

TEST(SatelliteMotion, RefusesWhatIsNoOrbit) {
  EXPECT_FALSE(SatelliteMotion::create({{{7000, 0, 0}, {0, 12, 0}}}));
  EXPECT_FALSE(SatelliteMotion::create({{{7000, 0, 0}, {0, 5, 0}}}));
  EXPECT_FALSE(SatelliteMotion::create({{{7000, 0, 0}, {0, std::nan(""), 0}}}));
  const auto refused = SatelliteMotion::create({{{7000, 0, 0}, {0, 7.5, 0}}, {{0, 0, 0}, {0, 7, 0}}});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("state 1"), std::string::npos) << refused.error().message;
}

}  // namespace
}  // namespace kinesphere::arc_test
