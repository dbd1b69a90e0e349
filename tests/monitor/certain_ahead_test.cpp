// What is certain of a pair ahead of time: by when it is inevitable that the two come within a separation,
// and until when they can avoid it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "kinesphere/monitor/monitor.hpp"
#include "kinesphere/random.hpp"

namespace kinesphere::certain_ahead_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Monitor monitor_of(const Separation& separation, const TrackClass& track_class) {
  return Monitor::create({.classes = {track_class}, .separations = {{0, 0, {separation}}}}).value();
}

TrackReport at(double time, const State& state) { return {.timestamp = time, .state = state}; }

/// A motion with random accelerations within a limit, that change now and then.
State moved(Random& random, State state, double duration, double limit) {
  constexpr int segments = 4;
  const bool is_steady = random.bits() % 2 == 0;
  Vec3 acceleration = limit * random.unit_vector();
  for (int k = 0; k < segments; ++k) {
    const double s = duration / segments;
    if (!is_steady) acceleration = limit * random.unit_vector();
    state.position += (state.velocity + acceleration * (0.5 * s)) * s;
    state.velocity += acceleration * s;
  }
  return state;
}

bool is_within(const Separation& separation, const Vec3& offset, double tolerance) {
  const double flat = std::hypot(offset.x, offset.y);
  if (separation.shape == Separation::Shape::ellipsoid)
    return std::hypot(flat, offset.z * separation.horizontal / separation.vertical) <=
           separation.horizontal + tolerance;
  return flat <= separation.horizontal + tolerance && std::abs(offset.z) <= separation.vertical + tolerance;
}

TEST(CertainAhead, NoMotionAvoidsWhatIsInevitable) {
  std::size_t inevitable = 0, ahead = 0;
  for (std::uint64_t run = 0; run < 600; ++run) {
    SCOPED_TRACE(run);
    Random random = Random::at(43, 0, run);
    const Separation separation = run % 3 == 0   ? Separation::sphere(10.0)
                                  : run % 3 == 1 ? Separation::cylinder(10.0, 4.0)
                                                 : Separation::well_clear(10.0, 4.0, 2.0);
    const double limit = random.uniform(0.0, 0.6), error = 0.3, velocity_error = 0.2;
    Monitor monitor = monitor_of(separation, {.acceleration_limit = limit});
    State one{5.0 * random.point_in_ball(), 2.0 * random.point_in_ball()};
    State other{40.0 * random.unit_vector(), {}};
    other.position.z *= 0.1;
    other.velocity = (one.position - other.position) / random.uniform(2.0, 8.0) + one.velocity;
    other.velocity += random.point_in_ball();
    for (const auto& [id, state] : {std::pair(TrackId{1}, one), {2, other}}) {
      TrackReport report = at(0.0, state);
      report.position_error = error;
      report.velocity_error = velocity_error;
      monitor.report(id, report).value();
    }
    for (const MonitorEvent& event : monitor.events(0.2 * random.uniform())) static_cast<void>(event);
    const PairAnswer answer = monitor.answer(1, 2).value();
    if (answer.verdict == Verdict::within) {
      EXPECT_EQ(answer.inevitable_by, monitor.time());
    }
    if (answer.inevitable_by == infinity) continue;
    ++inevitable;
    ahead += answer.verdict == Verdict::apart ? 1u : 0u;
    if (answer.verdict == Verdict::within) continue;
    for (int sample = 0; sample < 100; ++sample) {
      const auto after = [&](State state) {
        state.position += error * random.unit_vector();
        state.velocity += velocity_error * random.unit_vector();
        return moved(random, state, answer.inevitable_by, limit).position;
      };
      ASSERT_TRUE(is_within(separation, after(one) - after(other), 1.01e-3)) << answer.inevitable_by;
    }
  }
  EXPECT_GT(inevitable, 80u);
  EXPECT_GT(ahead, 60u);
}

TEST(CertainAhead, HeadOnTheLastMomentIsThatOfTheRoomLeft) {
  // 40 apart for each second, within 50 at 23.75, and 50 of room at 25.
  const auto at_time = [](double time) {
    Monitor monitor = monitor_of(Separation::sphere(50.0), {.acceleration_limit = 1.0});
    monitor.report(1, at(time, {{20.0 * time, 0, 30}, {20, 0, 0}})).value();
    monitor.report(2, at(time, {{1000.0 - 20.0 * time, 0, 30}, {-20, 0, 0}})).value();
    return monitor.answer(1, 2).value();
  };
  const double last = 25.0 - std::sqrt(50.0);
  const PairAnswer early = at_time(10.0);
  EXPECT_NEAR(early.avoidable_until, last, 1e-6);
  EXPECT_EQ(early.inevitable_by, infinity);
  EXPECT_EQ(early.relative_speed, 40.0);
  EXPECT_EQ(at_time(last - 0.01).inevitable_by, infinity);
  const PairAnswer late = at_time(last + 0.01);
  EXPECT_NEAR(late.inevitable_by, 25.0, 0.1);
  EXPECT_EQ(late.avoidable_until, last + 0.01);
  EXPECT_EQ(late.verdict, Verdict::apart);
}

TEST(CertainAhead, AnEvasionInTimeAvoidsIt) {
  std::size_t avoided = 0;
  for (std::uint64_t run = 0; run < 200; ++run) {
    SCOPED_TRACE(run);
    Random random = Random::at(44, 0, run);
    const double distance = random.uniform(5.0, 50.0), limit = random.uniform(0.2, 4.0);
    const double closing = 6.0 * std::sqrt(limit * distance) * random.uniform(1.0, 3.0);
    // Head-on, with a part of the distance between the courses.
    const State one{{0, 0, 0}, {closing / 2, 0, 0}};
    const State other{{random.uniform(40.0, 90.0) * distance, 0.9 * distance * random.uniform(), 0},
                      {-closing / 2, 0, 0}};
    Monitor monitor = monitor_of(Separation::sphere(distance), {.acceleration_limit = limit});
    monitor.report(1, at(0.0, one)).value();
    monitor.report(2, at(0.0, other)).value();
    const PairAnswer answer = monitor.answer(1, 2).value();
    ASSERT_GT(answer.avoidable_until, 0.0);
    ASSERT_LT(answer.avoidable_until, answer.likely_time);
    // A tenth of the time that is left is the slack. Each goes aside as fast as it can.
    const double start = answer.avoidable_until - 0.1 * (answer.closest_time - answer.avoidable_until);
    double least = infinity;
    for (double time = start; time < answer.closest_time + 2.0; time += 1e-3 * answer.closest_time) {
      const double s = time - start;
      const Vec3 aside{0, limit * s * s, 0};
      least = std::min(least,
                       norm(other.position - one.position + (other.velocity - one.velocity) * time + aside));
    }
    EXPECT_GT(least, distance);
    ++avoided;
  }
  EXPECT_EQ(avoided, 200u);
}

TEST(CertainAhead, TellsThePartsOfTheClosestApproach) {
  Monitor monitor = monitor_of(Separation::cylinder(10.0, 5.0), {.acceleration_limit = 1.0});
  monitor.report(1, at(0.0, {{0, 0, 100}, {3, 0, 0}})).value();
  monitor.report(2, at(0.0, {{60, 4, 120}, {-3, 0, -1}})).value();
  const PairAnswer answer = monitor.answer(1, 2).value();
  EXPECT_NEAR(answer.closest_time, 10.0, 1e-9);
  EXPECT_NEAR(answer.closest_horizontal, 4.0, 1e-9);
  EXPECT_NEAR(answer.closest_vertical, 10.0, 1e-9);
  EXPECT_DOUBLE_EQ(answer.relative_speed, std::sqrt(37.0));
  // At 10 they are 10 apart in height; they never are within both limits.
  EXPECT_EQ(answer.likely_time, infinity);
  EXPECT_EQ(answer.avoidable_until, infinity);
}

}  // namespace
}  // namespace kinesphere::certain_ahead_test
