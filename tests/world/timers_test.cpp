// Timers: events of the caller's own, at exact times among all others.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "kinesphere/kinesphere.hpp"
#include "support/playground.hpp"

namespace kinesphere::timers_test {
namespace {

/// A ball that bounces between two walls, one unit apart for its surface, once in a unit of time.
struct Shuttle {
  World world = World::create({.box = Box{{0.0, 0.0, 0.0}, {2.0, 9.0, 9.0}}}).value();
  Ballistic motion = Ballistic::create({.start = {{{0.75, 5.0, 5.0}, {1.0, 0.0, 0.0}}}}).value();
  SingleMotionSource source{motion};
  Shuttle() {
    BodyDefinition ball = motion.definition(0, 0.0);
    ball.radius = 0.5;
    world.add(ball).value();
  }
  /// Runs to a time. Returns what came: the user data of timers, -1 for begins at walls.
  std::vector<std::pair<double, std::int64_t>> run(double until) {
    std::vector<std::pair<double, std::int64_t>> came;
    const auto respond = [](const Event& event) {
      return event.kind == EventKind::wall_begin ? response_of(event, bounce(event, 1.0)) : Response{};
    };
    const auto hear = [&](const Event& event) {
      if (event.kind == EventKind::timer) came.emplace_back(event.time, event.first_user_data);
      if (event.kind == EventKind::wall_begin) came.emplace_back(event.time, -1);
    };
    world.run(until, source, respond, hear).value();
    return came;
  }
};

TEST(Timers, ComeAtTheirTimesAmongOtherEvents) {
  Shuttle shuttle;
  shuttle.world.schedule({.time = 2.0, .user_data = 20}).value();
  shuttle.world.schedule({.time = 0.5, .user_data = 5}).value();
  shuttle.world.schedule({.time = 2.0, .user_data = 21}).value();
  shuttle.world.schedule({.time = 0.0, .user_data = 1}).value();
  const auto came = shuttle.run(2.0);
  ASSERT_EQ(came.size(), 6u);
  EXPECT_EQ(came[0], std::pair(0.0, std::int64_t{1}));
  EXPECT_EQ(came[1], std::pair(0.5, std::int64_t{5}));
  EXPECT_EQ(came[2].second, -1);
  EXPECT_NEAR(came[2].first, 0.75, 1e-5);
  EXPECT_EQ(came[4], std::pair(2.0, std::int64_t{20}));
  EXPECT_EQ(came[5], std::pair(2.0, std::int64_t{21}));
}

TEST(Timers, AreAfterAllElseOfTheirTime) {
  World world = World::create({}).value();
  const BodyId ball = world.add({.radius = 1.0}).value();
  world.add({.radius = 1.0, .position = {1.5, 0.0, 0.0}}).value();
  world.schedule({.time = 0.0, .user_data = 4}).value();
  const Probe still = [](std::span<const BodyId> ids, double, std::span<State> states) {
    for (std::size_t k = 0; k < ids.size(); ++k) states[k] = {{1.5 * ids[k].index, 0.0, 0.0}, {}};
  };
  EXPECT_EQ(world.advance(1.0, still).value()->kind, EventKind::contact_begin);
  const Event timer = world.advance(1.0, still).value().value();
  EXPECT_EQ(timer.kind, EventKind::timer);
  EXPECT_EQ(timer.first, no_body);
  EXPECT_EQ(timer.first_user_data, 4u);
  EXPECT_EQ(timer.time, 0.0);
  // What is changed there comes at that time, and a timer that is scheduled for it, too.
  world.schedule({.time = 0.0, .user_data = 5}).value();
  world.remove(ball).value();
  EXPECT_EQ(world.advance(1.0, still).value()->kind, EventKind::contact_end);
  EXPECT_EQ(world.advance(1.0, still).value()->first_user_data, 5u);
  EXPECT_FALSE(world.advance(1.0, still).value());
}

TEST(Timers, ComeAgainWithoutDrift) {
  Shuttle shuttle;
  shuttle.world.schedule({.time = 0.1, .user_data = 3, .period = 0.1}).value();
  std::size_t count = 0;
  for (const auto& [time, data] : shuttle.run(100.0)) {
    if (data != 3) continue;
    EXPECT_EQ(time, 0.1 + static_cast<double>(count++) * 0.1);
  }
  EXPECT_EQ(count, 1000u);
  EXPECT_EQ(shuttle.world.unschedule(3).value(), 1u);
  EXPECT_EQ(shuttle.world.unschedule(3).value(), 0u);
  for (const auto& [time, data] : shuttle.run(110.0)) EXPECT_EQ(data, -1);
  EXPECT_EQ(shuttle.world.counters().count(EventKind::timer), 1000u);
}

/// A period far below what time can tell apart: time goes on.
TEST(Timers, DoNotStopTime) {
  Shuttle shuttle;
  shuttle.run(1e6);
  shuttle.world.schedule({.time = 1e6, .user_data = 3, .period = 1e-300}).value();
  double last = 0.0;
  for (int k = 0; k < 100; ++k) {
    const auto event = shuttle.world.advance(2e6, [](std::span<const BodyId>, double, std::span<State>) {});
    ASSERT_TRUE(event.value());
    EXPECT_GT(event.value()->time, last);
    last = event.value()->time;
  }
}

TEST(Timers, AreInSnapshotsClonesAndRecordings) {
  Shuttle shuttle;
  shuttle.world.start_recording().value();
  shuttle.world.schedule({.time = 0.3, .user_data = 3, .period = 0.7}).value();
  shuttle.world.schedule({.time = 1.3, .user_data = 8}).value();
  shuttle.world.schedule({.time = 1.4, .user_data = 9}).value();
  shuttle.run(1.2);
  World saved = World::restore(shuttle.world.save().value()).value();
  World copy = shuttle.world.clone().value();
  shuttle.world.unschedule(9).value();
  copy.unschedule(9).value();
  saved.unschedule(9).value();
  const auto rest = shuttle.run(5.0);
  auto replay = Replay::open(shuttle.world.stop_recording().value()).value();
  while (!replay.finished()) ASSERT_TRUE(replay.advance());
  for (World* const other : {&saved, &copy}) {
    Shuttle again;
    again.run(1.2);
    again.world = std::move(*other);
    EXPECT_EQ(again.run(5.0), rest);
  }
}

/// A thermostat in run(): the response stops at the timer, and the sink gives velocities.
TEST(Timers, LetASinkChangeTheWorld) {
  Shuttle shuttle;
  shuttle.world.schedule({.time = 0.5, .period = 0.5}).value();
  const auto respond = [](const Event& event) -> Response {
    if (event.kind == EventKind::timer) return {.stop = true};
    return event.kind == EventKind::wall_begin ? response_of(event, bounce(event, 1.0)) : Response{};
  };
  int walls = 0;
  const auto hear = [&](const Event& event) {
    if (event.kind == EventKind::wall_begin) ++walls;
    if (event.kind != EventKind::timer) return;
    const State now = shuttle.motion.state(0, event.time);
    shuttle.motion.set_velocity(0, event.time, now.velocity * -1.0).value();
    shuttle.world.set_velocity(shuttle.world.bodies()[0], now.velocity * -1.0).value();
  };
  shuttle.world.run(100.0, shuttle.source, respond, hear).value();
  EXPECT_EQ(walls, 0) << "it turns before it reaches one";
  const Response moves_nobody{.first_velocity = Vec3{}};
  const auto refused = shuttle.world.run(
      101.0, shuttle.source, [&](const Event&) { return moves_nobody; }, [](const Event&) {});
  EXPECT_EQ(refused.error().code, ErrorCode::unknown_body);
}

TEST(Timers, AreRefusedByName) {
  Shuttle shuttle;
  shuttle.run(1.0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [&](const Timer& timer) { return shuttle.world.schedule(timer).error().message; };
  EXPECT_EQ(refused({.time = 0.5}), "schedule: time must not lie before the current time 1, but is 0.5");
  EXPECT_EQ(refused({.time = nan}), "schedule: time must be finite, but is nan");
  EXPECT_EQ(refused({.time = 2.0, .period = -1.0}), "schedule: period must be >= 0, but is -1");
  EXPECT_EQ(refused({.time = 2.0, .period = nan}), "schedule: period must be finite, but is nan");
  EXPECT_EQ(shuttle.world.unschedule(0).value(), 0u) << "nothing was kept";
}

}  // namespace
}  // namespace kinesphere::timers_test
