// Reports with errors, and violated limits.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "support/playground.hpp"

namespace kinesphere::promise_test {
namespace {

/// Deterministic noise within the errors, different for each report.
void add_noise(Playground& p) {
  p.distort = [&p](BodyId id, double time, State& state) {
    const BodyDefinition promise = p.world.body(id).value().definition;
    Random random = Random::at(17, id.index, static_cast<std::uint64_t>((time + 1000.0) * 1e9));
    state.position += 0.999999 * promise.position_error * random.unit_vector();
    state.velocity += 0.999999 * promise.velocity_error * random.unit_vector();
  };
}

class Noise : public testing::TestWithParam<std::tuple<double, double, ContactEvents>> {};

TEST_P(Noise, HidesNoTrueContactAndIsNoViolation) {
  const auto [e0, e1, mode] = GetParam();
  const double eps = 1e-3;
  Playground p({.box = Box{{0, 0, 0}, {12, 12, 12}},
                .contact_tolerance = eps,
                .separation_distance = 4 * eps + 4 * e0,
                .contacts = mode});
  add_noise(p);
  Random random(5);
  std::vector<BodyId> ids;
  for (int k = 0; k < 40; ++k) {
    const BodyDefinition body{
        .radius = random.uniform(0.2, 0.6),
        .acceleration_limit = 3,
        .position_error = e0,
        .velocity_error = e1,
        .position = {random.uniform(1, 11), random.uniform(1, 11), random.uniform(1, 11)},
        .velocity = 3.0 * random.point_in_ball()};
    ids.push_back(p.add(body, 2.9 * random.point_in_ball()));
  }
  std::set<std::pair<BodyId, BodyId>> touching;
  std::size_t begins = 0;
  for (int tick = 1; tick <= 60 && !HasFailure(); ++tick) {
    p.run(0.05 * tick, [&](const Event& event) {
      if (event.kind == EventKind::contact_begin) touching.insert({event.first, event.second}), ++begins;
      if (event.kind == EventKind::contact_end) touching.erase({event.first, event.second});
    });
    if (mode == ContactEvents::impacts) touching.clear();
    for (std::size_t a = 0; a < ids.size(); ++a)
      for (std::size_t b = a + 1; b < ids.size(); ++b)
        if (mode == ContactEvents::begin_and_end && !touching.contains({ids[a], ids[b]})) {
          ASSERT_GE(p.gap(ids[a], ids[b]), -eps) << ids[a] << " " << ids[b];
        }
    for (const BodyId id : ids) {
      // The bodies turn back by themselves before they leave the box.
      const State state = p.state(id);
      Vec3 towards = Vec3{6, 6, 6} - state.position - state.velocity;
      const double length = norm(towards);
      if (length > 2.9) towards *= 2.9 / length;
      p.steer(id, towards);
    }
  }
  EXPECT_GT(begins, 20u);
  EXPECT_EQ(p.world.counters().count(EventKind::bound_violation), 0u);
  EXPECT_TRUE(is_clean(p.world));
}

INSTANTIATE_TEST_SUITE_P(Errors, Noise,
                         testing::Values(std::tuple(0.01, 0.0, ContactEvents::begin_and_end),
                                         std::tuple(0.0, 0.1, ContactEvents::begin_and_end),
                                         std::tuple(0.02, 0.2, ContactEvents::begin_and_end),
                                         std::tuple(0.1, 0.5, ContactEvents::begin_and_end),
                                         std::tuple(0.002, 0.01, ContactEvents::impacts)));

/// A body violates its limits while another waits for it.
struct Breach {
  Playground p;
  BodyId culprit, witness;

  explicit Breach(double limit = 1.0) {
    culprit = p.add({.radius = 1, .acceleration_limit = limit, .velocity = {1, 0, 0}}, Vec3{});
    witness = p.add({.radius = 1, .position = {0, 150, 0}});
    p.run(5.0);
  }

  /// Returns events until 50 time units later.
  std::vector<Event> run_on() { return p.run(p.world.time() + 50.0); }
};

TEST(BoundViolation, TeleportIsReportedWithItsLength) {
  Breach breach;
  Playground& p = breach.p;
  const BodyView before = p.world.body(breach.culprit).value();
  const Vec3 target = p.state(breach.culprit).position + Vec3{0, 300, 0};
  p.set_position(breach.culprit, target);
  double reported_at = -1.0;
  p.distort = [&](BodyId id, double time, State&) {
    if (id == breach.culprit && reported_at < 0) reported_at = time;
  };
  const auto events = breach.run_on();
  ASSERT_EQ(events.size(), 1u) << events;
  EXPECT_EQ(events[0].kind, EventKind::bound_violation);
  EXPECT_EQ(events[0].first, breach.culprit);
  EXPECT_EQ(events[0].second, no_body);
  EXPECT_EQ(events[0].time, reported_at) << "at the first report after it";
  const double s = events[0].time - before.bound.time;
  EXPECT_NEAR(events[0].position_excess, 300.0 - 0.5 * s * s, 1e-6);
  EXPECT_EQ(events[0].velocity_excess, 0.0);
  EXPECT_EQ(events[0].first_state, p.state(breach.culprit, events[0].time));
  EXPECT_TRUE(is_clean(p.world));
}

TEST(BoundViolation, JumpOfVelocityIsReportedWithItsSize) {
  Breach breach;
  Playground& p = breach.p;
  const BodyView before = p.world.body(breach.culprit).value();
  p.set_velocity_unseen(breach.culprit, {1, 20, 0});
  const auto event = p.advance(50.0);
  ASSERT_TRUE(event);
  EXPECT_EQ(event->kind, EventKind::bound_violation);
  const double s = event->time - before.bound.time;
  EXPECT_NEAR(event->velocity_excess, 20.0 - s, 1e-6);
  EXPECT_GE(event->position_excess, 0.0);
  // The world goes on from the new report, in which the two have passed each other.
  p.set_velocity(breach.culprit, {0, 0, 0});
  EXPECT_TRUE(p.run(100.0).empty());
}

TEST(BoundViolation, AccelerationBeyondTheLimitIsReportedAndTheContactFound) {
  Playground p;
  p.add({.radius = 1, .acceleration_limit = 0.1, .velocity = {1, 0, 0}}, Vec3{0, 0.4, 0});
  const BodyId target = p.add({.radius = 1, .position = {20, 80, 0}});
  // With neighbours the body is probed often enough to be caught early.
  for (int k = 0; k < 20; ++k) p.add({.radius = 1, .position = {1.0 * k + 3.0, 0.2 * k * k, 0}});
  const auto events = p.run(30.0);
  const auto violations = of_kind(events, EventKind::bound_violation);
  ASSERT_GE(violations.size(), 1u) << events;
  EXPECT_GT(violations[0].velocity_excess, 0.0);
  std::size_t begins = 0;
  for (const Event& event : of_kind(events, EventKind::contact_begin))
    if (event.second == target) {
      ++begins;
      EXPECT_NEAR(event.time, 19.8, 0.5);
    }
  EXPECT_EQ(begins, 1u) << events;
  EXPECT_TRUE(is_clean(p.world));
}

TEST(BoundViolation, TeleportIntoAndOutOfContactBeginsAndEndsIt) {
  Breach breach;
  Playground& p = breach.p;
  p.set_velocity_unseen(breach.culprit, {1, 0, 0});
  p.set_position(breach.culprit, {0, 149, 0});
  auto events = p.run(p.world.time() + 0.0);
  p.set_velocity(breach.culprit, {0, 0, 0});  // makes the world probe at once
  events = p.run(p.world.time() + 1.0);
  ASSERT_EQ(events.size(), 2u) << events;
  EXPECT_EQ(events[0].kind, EventKind::bound_violation);
  EXPECT_EQ(events[1].kind, EventKind::contact_begin);
  p.set_position(breach.culprit, {0, -100, 0});
  p.set_velocity(breach.culprit, {0, 0, 0});
  events = p.run(p.world.time() + 1.0);
  ASSERT_EQ(events.size(), 2u) << events;
  EXPECT_EQ(events[0].kind, EventKind::bound_violation);
  EXPECT_EQ(events[1].kind, EventKind::contact_end);
  EXPECT_GT(events[1].gap, 200.0);
  EXPECT_TRUE(is_clean(p.world));
}

/// Enough bodies are added that all others get new windows with them, for which some are probed.
TEST(BoundViolation, FoundOutWhileManyAreAddedLosesNobody) {
  for (int steps = 1; steps <= 40; ++steps) {
    Playground p;
    std::vector<BodyId> ids;
    for (int k = 0; k < 20; ++k)
      ids.push_back(p.add(
          {.radius = 0.1, .acceleration_limit = 1, .position = {3.0 * k, 0, 0}, .velocity = {0, 0.5, 0}}));
    const double time = 0.0371 * steps;
    p.run(time);
    p.set_position(ids[7], {21, -40, 0});
    for (int k = 0; k < 20; ++k)
      p.add({.radius = 0.1, .acceleration_limit = 1, .position = {3.0 * k, 30, 0}, .velocity = {0, 0.5, 0}});
    p.run(time);
    ASSERT_TRUE(is_clean(p.world)) << "after " << steps << " steps";
    p.run(time + 20.0);
    ASSERT_TRUE(is_clean(p.world)) << "after " << steps << " steps";
  }
}

TEST(BoundViolation, SeveralAtOneInstantAreAllTold) {
  Playground p;
  std::vector<BodyId> ids;
  for (int k = 0; k < 6; ++k) ids.push_back(p.add({.radius = 1, .position = {10.0 * k, 0, 0}}));
  p.run(1.0);
  for (const BodyId id : ids) {
    p.set_position(id, p.state(id).position + Vec3{0, 0, 1000});
    p.set_velocity(id, {});
  }
  const auto events = p.run(2.0);
  ASSERT_EQ(events.size(), 6u) << events;
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_EQ(events[k].kind, EventKind::bound_violation);
    EXPECT_EQ(events[k].first, ids[k]);
    EXPECT_NEAR(events[k].position_excess, 1000.0, 1e-9);
    EXPECT_EQ(events[k].velocity_excess, 0.0);
  }
}

/// A body is to meet one that has a recheck at the floor soon. A probe then finds it on the other side,
/// returning fast through another image than the one in which the pair was certified.
TEST(BoundViolation, FoundOutAtAMeetingSettlesThePairInItsNewImage) {
  const double speed = 100.0;
  for (const double gap : {0.05, 0.2, 1.0}) {
    for (const bool culprit_first : {false, true}) {
      Playground p({.box = Box{{0, 0, 0}, {10, 10, 10}}, .periodic = {true, true, false}});
      BodyId culprit{}, other{};
      const auto add_culprit = [&] {
        culprit = p.add({.radius = 0.5, .position = {3.0 + gap, 5, 0.51}, .velocity = {-1, 0, 0}});
      };
      if (culprit_first) add_culprit();
      other = p.add({.radius = 0.5, .acceleration_limit = 1, .position = {2, 5, 0.51}}, Vec3{});
      if (!culprit_first) add_culprit();
      // Far from the pair: swept spheres are as large as bodies are sparse, and last beyond the next recheck
      // at the floor.
      p.add({.radius = 0.1, .position = {7, 0, 9}});
      bool broken = false;
      p.distort = [&](BodyId id, double time, State& state) {
        if (id != culprit || time == 0.0 || broken) return;
        broken = true;
        p.set_position(culprit, state.position + Vec3{4.9, 0, 0});
        p.set_velocity_unseen(culprit, {speed, 0, 0});
        state = p.state(culprit);
      };
      const auto violation = p.advance(10.0);
      ASSERT_TRUE(violation);
      ASSERT_EQ(violation->kind, EventKind::bound_violation);
      EXPECT_TRUE(is_clean(p.world));
      const double way = p.state(other).position.x + 10.0 - p.state(culprit).position.x - 1.0;
      const auto begin = p.advance(10.0);
      ASSERT_TRUE(begin);
      EXPECT_EQ(begin->kind, EventKind::contact_begin);
      EXPECT_NEAR(begin->time, violation->time + way / speed, 1e-7) << "gap " << gap;
    }
  }
}

TEST(BoundViolation, FaithfulReportsWithRoundingAreNone) {
  for (const double place : {0.0, 1e3, 1e6, 2.19e6}) {
    Playground p;
    for (int k = 0; k < 10; ++k)
      p.add({.radius = 0.5,
             .planned_acceleration = {0, 0, -9.81},
             .position = {place + 3.0 * k, -place, place},
             .velocity = {0.1 * k, 12.3, 45.6}});
    EXPECT_TRUE(p.run(20.0).empty()) << place;
  }
}

}  // namespace
}  // namespace kinesphere::promise_test
