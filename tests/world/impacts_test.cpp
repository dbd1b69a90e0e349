// Bouncing bodies: impacts, chains of them at one instant, and contacts that could stop time.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <tuple>

#include "kinesphere/response.hpp"
#include "support/playground.hpp"

namespace kinesphere::impacts_test {
namespace {

constexpr WorldDefinition impacts{.contacts = ContactEvents::impacts};

void bounce_off(Playground& p, const Event& event, double restitution = 1.0, double first_mass = 1.0,
                double second_mass = 1.0) {
  if (event.kind != EventKind::contact_begin && event.kind != EventKind::wall_begin) return;
  const Bounce after = bounce(event, first_mass, second_mass, restitution);
  p.set_velocity(event.first, after.first_velocity);
  if (event.second != no_body) p.set_velocity(event.second, after.second_velocity);
}

TEST(Impacts, HeadOnBouncesOnce) {
  Playground p(impacts);
  const BodyId a = p.add({.radius = 1, .position = {-5, 0, 0}, .velocity = {1, 0, 0}});
  const BodyId b = p.add({.radius = 1, .position = {5, 0, 0}, .velocity = {-3, 0, 0}});
  const auto events = p.run(100.0, [&](const Event& event) { bounce_off(p, event); });
  ASSERT_EQ(events.size(), 1u) << events;
  EXPECT_NEAR(events[0].time, 2.0, 1e-6);
  EXPECT_NEAR(events[0].approach_speed, 4.0, 1e-12);
  EXPECT_NEAR(p.state(a).velocity.x, -3.0, 1e-12);
  EXPECT_NEAR(p.state(b).velocity.x, 1.0, 1e-12);
  EXPECT_EQ(p.world.counters().repeated_contacts, 0u);
}

TEST(Impacts, PassingThroughIsOneBeginPerApproach) {
  Playground p(impacts);
  // The bodies oscillate through each other by a constant acceleration back.
  const BodyId a = p.add({.radius = 1});
  const BodyId b = p.add({.radius = 1, .acceleration_limit = 4, .position = {5, 0, 0}}, Vec3{-4, 0, 0});
  std::size_t begins = 0;
  for (int k = 1; k <= 4000; ++k) {
    begins += p.run(0.01 * k).size();
    p.steer(b, {p.state(b).position.x > 0 ? -4.0 : 4.0, 0, 0});
  }
  // From 5 to 0 takes sqrt(2.5) s: a quarter of a period. Each period has two approaches.
  EXPECT_NEAR(static_cast<double>(begins), 40.0 / (2.0 * std::sqrt(2.5)), 2.0);
  EXPECT_EQ(p.world.counters().count(EventKind::contact_end), 0u);
  EXPECT_EQ(p.world.counters().count(EventKind::zeno_guard), 0u);
  EXPECT_TRUE(is_clean(p.world));
  (void)a;
}

TEST(Impacts, BodyThatCameOutOfAnOverlapIsSeenWhenItComesBack) {
  // The body starts deep inside, leaves, and is pulled back: an approach like any other.
  for (const bool wall : {false, true}) {
    WorldDefinition definition = impacts;
    if (wall) definition.box = Box{{0, -50, -50}, {100, 50, 50}};
    Playground p(definition);
    if (!wall) p.add({.radius = 0, .position = {0, 0, 0}});
    const BodyId ball = p.add({.radius = 1, .acceleration_limit = 2, .position = {0.5, 0, 0}}, Vec3{});
    // Many changes in an empty neighbourhood make its safe region wide, so that no new one begins in between.
    for (int k = 0; k < 20; ++k) {
      p.set_velocity(ball, {});
      const auto events = p.run(0.0);
      EXPECT_EQ(events.size(), k == 0 ? 1u : 0u) << "told of the overlap";
    }
    p.set_velocity(ball, {2, 0, 0});
    p.steer(ball, {-2, 0, 0});
    const auto events = p.run(1.9);
    ASSERT_EQ(events.size(), 1u) << events;
    EXPECT_LE(events[0].gap, 1e-6);
    EXPECT_GE(events[0].gap, -1e-6);
    EXPECT_NEAR(events[0].time, 1.0 + std::sqrt(0.5), 1e-5);  // x = 0.5 + 2 t - t^2 is 1 again
  }
}

/// Hulls without a radius do not know how deep they overlap, so nothing tells how far this one is from
/// leaving.
TEST(Impacts, EachDipOfABarThatTurnsIsSeen) {
  for (const bool moves : {false, true}) {
    Playground p(impacts);
    const Box other{{-10, -1e5, -10}, {0, 1e5, 10}};
    if (moves)
      p.add_rigid_body({.parts = {box_part(other, 0.0)}});
    else
      p.world.add_static({.shape = other}).value();
    // On its long way with no others, its safe region becomes wide.
    const BodyId bar = p.add_rigid_body({.body = {.position = {0.5, 0, 0}, .velocity = {0, 1, 0}},
                                         .parts = {box_part(Box{{-1, -0.1, -0.1}, {1, 0.1, 0.1}}, 0.0)},
                                         .rotation = {.angular_velocity = {0, 0, std::numbers::pi}}});
    // A corner is in the plane x = 0 when cos(a) - 0.1 sin(a) = -0.5.
    const double dip = (std::acos(-0.5 / std::hypot(1.0, 0.1)) - std::atan(0.1)) / std::numbers::pi;
    EXPECT_EQ(p.run(0.5).size(), moves ? 1u : 0u) << "it may approach at the start";
    for (int turn = 0; turn < 40; ++turn) {
      // A change while it leaves.
      if (turn % 2 == 1) p.set_velocity(bar, {0, 1, 0});
      const auto events = p.run(turn + 1.25);
      ASSERT_EQ(events.size(), 1u) << events;
      EXPECT_NEAR(events[0].time, turn + dip, 1e-5);
    }
  }
}

TEST(Impacts, ParallelAndReceedingBodiesDoNotTouch) {
  Playground p(impacts);
  p.add({.radius = 1, .velocity = {1, 0, 0}});
  p.add({.radius = 1, .position = {0, 2, 0}, .velocity = {1, 0, 0}});      // side by side, gap 0
  p.add({.radius = 1, .position = {-1.9, 0, 0}, .velocity = {-1, 0, 0}});  // overlaps and leaves
  const auto events = p.run(50.0);
  ASSERT_EQ(events.size(), 1u) << events;
  EXPECT_EQ(events[0].time, 0.0) << "the overlap";
  EXPECT_LT(p.world.counters().probes, 200u);
}

TEST(Impacts, NewtonsCradlePassesTheBlowOnInOneInstant) {
  for (const double limit : {0.0, 1.0}) {
    Playground p(impacts);
    std::vector<BodyId> balls;
    for (int k = 0; k < 5; ++k)
      balls.push_back(p.add({.radius = 1, .acceleration_limit = limit, .position = {2.0 * k, 0, 0}}, Vec3{}));
    const BodyId striker = p.add(
        {.radius = 1, .acceleration_limit = limit, .position = {-7, 0, 0}, .velocity = {2, 0, 0}}, Vec3{});
    const auto events = p.run(3.0, [&](const Event& event) { bounce_off(p, event); });
    ASSERT_EQ(events.size(), 5u) << events;
    for (const Event& event : events) {
      EXPECT_NEAR(event.time, 2.5, 1e-5);
      EXPECT_NEAR(event.approach_speed, 2.0, 1e-12);
    }
    EXPECT_NEAR(p.state(balls.back()).velocity.x, 2.0, 1e-12);
    EXPECT_NEAR(norm(p.state(striker).velocity), 0.0, 1e-12);
    EXPECT_LT(p.world.counters().pair_checks, 100000u) << "time nearly stood still";
    for (std::size_t k = 0; k + 1 < balls.size(); ++k)
      EXPECT_NEAR(norm(p.state(balls[k]).velocity), 0, 1e-12);
  }
}

TEST(Impacts, ThreeAtOnceConserveMomentumAndEnergy) {
  // Two bodies arrive from both sides at one in the middle at one instant.
  Playground p(impacts);
  const std::vector<BodyId> balls{p.add({.radius = 1}),
                                  p.add({.radius = 1, .position = {-6, 0, 0}, .velocity = {1, 0, 0}}),
                                  p.add({.radius = 1, .position = {6, 0, 0}, .velocity = {-1, 0, 0}})};
  const auto events = p.run(10.0, [&](const Event& event) { bounce_off(p, event); });
  EXPECT_LE(events.size(), 4u) << events;
  Vec3 momentum;
  double energy = 0.0;
  for (const BodyId id : balls) {
    momentum += p.state(id).velocity;
    energy += norm_squared(p.state(id).velocity);
  }
  EXPECT_NEAR(norm(momentum), 0.0, 1e-12);
  EXPECT_NEAR(energy, 2.0, 1e-12);
}

TEST(Impacts, SecondEventOfAnInstantKnowsOfTheKickAtTheFirst) {
  // One body hits two others at once; the response to the first turns it away from the second.
  Playground p(impacts);
  const BodyId a = p.add({.radius = 1, .velocity = {4, 0, 0}});
  p.add({.radius = 1, .position = {10, 1, 0}});
  p.add({.radius = 1, .position = {10, -1, 0}});
  std::size_t reported = 0;
  p.run(20.0, [&](const Event& event) {
    ++reported;
    p.set_velocity(a, {-4, 0, 0});
    EXPECT_GT(event.approach_speed, 0.0);
  });
  EXPECT_EQ(reported, 1u);
}

struct RestCase {
  double restitution;
  bool wall;
  double limit;
};

class Resting : public testing::TestWithParam<RestCase> {};

TEST_P(Resting, BallDoesNotStopTime) {
  const double restitution = GetParam().restitution;
  const bool wall = GetParam().wall;
  const double limit = GetParam().limit;
  const double eps = 1e-6;
  const Vec3 gravity{0, 0, -10};
  WorldDefinition definition = impacts;
  if (wall) definition.box = Box{{-10, -10, 0}, {10, 10, 10}};
  Playground p(definition);
  const BodyId ball = p.add(
      {.radius = 1, .acceleration_limit = limit, .planned_acceleration = gravity, .position = {0, 0, 1.2}},
      gravity + Vec3{0, 0, -0.9 * limit});
  std::optional<BodyId> floor;
  if (!wall) floor = p.add({.radius = 8, .position = {0, 0, -8}});
  const auto height = [&] {
    const Vec3 at = p.state(ball).position;
    return wall ? at.z - 1.0 : norm(at - Vec3{0, 0, -8}) - 9.0;
  };
  std::size_t events = 0, late_events = 0, repeated = 0;
  double highest_late = 0.0;
  for (int tick = 1; tick <= 500; ++tick) {
    p.run(
        0.01 * tick,
        [&](const Event& event) {
          EXPECT_NE(event.kind, EventKind::zeno_guard) << event;
          ++events;
          if (p.world.time() > 4.0) ++late_events;
          if (event.repeated) ++repeated;
          EXPECT_GE(height(), -eps) << event;
          const Bounce after = bounce(event, 1.0, 1e9, restitution);
          p.set_velocity(ball, event.first == ball ? after.first_velocity : after.second_velocity);
        },
        20000);
    ASSERT_GE(height(), -eps) << p.world.time();
    if (HasFailure()) return;
    if (tick > 400) highest_late = std::max(highest_late, height());
  }
  // A hop within the tolerance takes about sqrt(eps / g) = 0.3 ms.
  EXPECT_LT(late_events, 20000u);
  EXPECT_LT(p.world.counters().probes, 200000u);
  if (restitution == 1.0) {
    EXPECT_EQ(repeated, 0u);
    EXPECT_NEAR(highest_late, 0.2, 0.01);
    EXPECT_LT(events, 20u);
  }
  if (restitution <= 0.5) {
    EXPECT_LT(highest_late, 10 * eps);
    EXPECT_GT(repeated, 0u);
    EXPECT_EQ(p.world.counters().repeated_contacts >= repeated, true);
  }
}

INSTANTIATE_TEST_SUITE_P(Restitutions, Resting,
                         testing::Values(RestCase{0.0, true, 0}, RestCase{0.5, true, 0},
                                         RestCase{0.9, true, 0}, RestCase{1.0, true, 0},
                                         RestCase{0.0, false, 0}, RestCase{0.5, false, 0},
                                         RestCase{0.9, false, 0}, RestCase{1.0, false, 0},
                                         RestCase{0.0, true, 3}, RestCase{0.5, false, 3}));

TEST(Zeno, CallerWhoIgnoresRepeatedIsToldByTheGuard) {
  const Vec3 gravity{0, 0, -10};
  for (const bool wall : {true, false}) {
    WorldDefinition definition = impacts;
    if (wall) definition.box = Box{{-10, -10, 0}, {10, 10, 10}};
    Playground p(definition);
    const BodyId ball = p.add({.radius = 1, .planned_acceleration = gravity, .position = {0, 0, 1.1}});
    if (!wall) p.add({.radius = 8, .position = {0, 0, -8}});
    std::size_t guards = 0;
    std::size_t events = 0;
    double at_guard = 0.0;
    for (int tick = 1; tick <= 100 && !HasFailure(); ++tick)
      p.run(
          0.01 * tick,
          [&](const Event& event) {
            ++events;
            if (event.kind == EventKind::zeno_guard && guards++ == 0) at_guard = event.gap;
            p.set_velocity(ball, {});  // stops it, whatever it is
          },
          50000);
    EXPECT_GT(guards, 0u);
    EXPECT_LT(at_guard, -0.875e-6);
    EXPECT_LT(events, 50000u);
    EXPECT_EQ(p.world.time(), 1.0) << "time went on";
    EXPECT_GT(p.world.counters().zeno_steps, 0u);
    EXPECT_EQ(p.world.counters().count(EventKind::zeno_guard), guards);
  }
}

TEST(Zeno, PileOfRestingBallsGoesOn) {
  WorldDefinition definition = impacts;
  definition.box = Box{{-2, -2, 0}, {2, 2, 20}};
  const Vec3 gravity{0, 0, -10};
  Playground p(definition);
  std::vector<BodyId> balls;
  for (int k = 0; k < 6; ++k)
    balls.push_back(p.add({.radius = 0.5,
                           .planned_acceleration = gravity,
                           .position = {0.2 * (k % 2), 0.1 * (k % 3), 1.0 + 1.3 * k}}));
  double deepest = 0.0;
  for (int tick = 1; tick <= 60 && !HasFailure(); ++tick) {
    p.run(
        0.05 * tick, [&](const Event& event) { bounce_off(p, event, 0.3); }, 50000);
    for (std::size_t a = 0; a < balls.size(); ++a)
      for (std::size_t b = 0; b < a; ++b) deepest = std::min(deepest, p.gap(balls[a], balls[b]));
  }
  EXPECT_EQ(p.world.time(), 3.0);
  if (p.world.counters().count(EventKind::zeno_guard) == 0) {
    EXPECT_GE(deepest, -1.0e-6 - 1e-12);
  }
  EXPECT_TRUE(is_clean(p.world));
}

TEST(Zeno, RepeatedFollowsTheIntervalOfTheCaller) {
  WorldDefinition definition = impacts;
  definition.zeno_interval = 1.5;
  definition.box = Box{{0, 0, 0}, {10, 10, 10}};
  Playground p(definition);
  p.add({.radius = 1, .position = {5, 5, 5}, .velocity = {8, 0, 0}});      // a wall every second
  p.add({.radius = 1, .position = {5, 1.5, 1.5}, .velocity = {0, 0, 2}});  // every four seconds
  const auto events = p.run(20.0, [&](const Event& event) { bounce_off(p, event); });
  bool first_of_fast = true;
  for (const Event& event : events) {
    EXPECT_EQ(event.repeated, event.first.index == 0 && !first_of_fast) << event;
    if (event.first.index == 0) first_of_fast = false;
  }
  EXPECT_EQ(p.world.counters().repeated_contacts, of_kind(events, EventKind::wall_begin).size() - 1 - 5);
}

/// What puts a ball into another one at the origin, or into what is beside it.
enum class Put { added, teleported, enabled, grown, made_solid, admitted };

class PutInside : public testing::TestWithParam<std::tuple<Put, double, double>> {};

INSTANTIATE_TEST_SUITE_P(Impacts, PutInside,
                         testing::Combine(testing::Values(Put::added, Put::teleported, Put::enabled,
                                                          Put::grown, Put::made_solid, Put::admitted),
                                          testing::Values(0.0, 3.0), testing::Values(0.0, 2.0)));

TEST_P(PutInside, IsTold) {
  const auto [put, speed, limit] = GetParam();
  for (const bool by_static : {false, true}) {
    Playground p(impacts);
    if (by_static)
      p.world.add_static({.shape = Box{{-1, -1, -1}, {1, 1, 1}}}).value();
    else
      p.add({.radius = 1});
    EXPECT_TRUE(p.run(1.0).empty());
    const State inside{{0.5, 0, 0}, {speed, 0, 0}}, outside{{5, 0, 0}, {}};
    BodyDefinition body{.radius = 1, .acceleration_limit = limit};
    body.position = put == Put::teleported || put == Put::enabled ? outside.position : inside.position;
    if (put == Put::added) body.velocity = inside.velocity;
    if (put == Put::grown) body.position = {3, 0, 0};
    body.solid = put != Put::made_solid;
    if (put == Put::admitted) body.filter.group = -1;
    const BodyId ball = p.add(body, Vec3{});
    if (put == Put::admitted) p.world.change(ball, {.filter = Filter{.mask = 0}}).value();
    if (put == Put::enabled) p.world.disable(ball).value();
    if (put != Put::added) {
      EXPECT_TRUE(p.run(2.0).empty());
    }
    if (put == Put::teleported) p.teleport(ball, inside);
    if (put == Put::enabled) {
      p.set_state(ball, inside);
      p.world.enable(ball, inside).value();
    }
    if (put == Put::grown) p.world.change(ball, {.radius = 2.9}).value();
    if (put == Put::made_solid) p.world.change(ball, {.solid = true}).value();
    if (put == Put::admitted) p.world.change(ball, {.filter = Filter{}}).value();
    const double now = p.world.time();
    const auto events = p.run(5.0);
    ASSERT_EQ(events.size(), 1u) << events;
    EXPECT_EQ(events[0].kind, EventKind::contact_begin);
    EXPECT_EQ(events[0].time, now);
    EXPECT_LT(events[0].gap, -0.1);
    EXPECT_TRUE(is_clean(p.world));
  }
}

TEST(Impacts, BodiesThatRestInContactWithoutForceCostNothing) {
  Playground p(impacts);
  for (int k = 0; k < 10; ++k) p.add({.radius = 0.5, .position = {1.0 * k, 0, 0}});
  EXPECT_TRUE(p.run(1000.0).empty());
  EXPECT_LT(p.world.counters().probes, 1000u);
}

}  // namespace
}  // namespace kinesphere::impacts_test
