// Contacts of bodies with several points: how deep they get, how many checks they take, and what is certain
// of them beside balls that grow or shrink.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "kinesphere/certificates.hpp"
#include "kinesphere/random.hpp"
#include "kinesphere/response.hpp"
#include "kinesphere/world.hpp"
#include "support/placed_parts.hpp"

namespace kinesphere {
namespace {

constexpr std::uint64_t seed = 66;

/// A course at constant velocity.
auto straight(BodyId id, const State& start) {
  return [=](std::span<const BodyId> ids, double time, std::span<State> states) {
    for (std::size_t k = 0; k < ids.size(); ++k)
      states[k] = ids[k] == id ? State{start.position + start.velocity * time, start.velocity} : State{};
  };
}

std::vector<std::vector<RigidPart>> long_bodies(double radius) {
  return {{{{-1, 0, 0}, {-1, 0, 0}, radius}, {{1, 0, 0}, {1, 0, 0}, radius}},
          {{{-1, 0, 0}, {1, 0, 0}, radius}},
          {box_part(Box{{-1, -0.1, 0}, {1, 0.1, 0}}, radius)}};
}

/// The end at -x recedes from within the tolerance, while the end at +x comes down.
TEST(RigidContact, OfAnEndThatComesDownIsToldBeforeItIsDeep) {
  constexpr double radius = 0.05;
  for (const auto& parts : long_bodies(radius))
    for (const double eps : {1e-2, 1e-3, 1e-4, 1e-6})
      for (const double height : {-0.2, 0.5, 2.0})
        for (const double depth : {0.3, 0.6, 0.9}) {
          SCOPED_TRACE(testing::Message()
                       << "tolerance " << eps << ", height " << height << ", depth " << depth);
          World world = World::create({.contact_tolerance = eps}).value();
          const double angle = std::asin((height + depth) * eps / 2.0);
          RigidBody body{.parts = parts, .rotation = {rotation_by({0, -angle, 0}), {0, 1, 0}}};
          body.body.position.z = radius - depth * eps + std::sin(angle);
          const BodyId id = world.add_rigid_body(body).value();
          world.add_static({.shape = HalfSpace{{0, 0, 1}, 0}}).value();
          const auto probe = straight(id, {body.body.position, {}});
          bool comes_down = false;
          while (const auto event = world.advance(0.5, probe).value()) {
            if (event->kind != EventKind::contact_begin || !(event->approach_speed > 0.0)) continue;
            EXPECT_GE(event->gap, -eps * (1.0 + 1e-6));
            comes_down = true;
            break;
          }
          EXPECT_TRUE(comes_down);
        }
}

/// A capsule or a crate falls on the ground and bounces until it rocks in hops too small to see. Each end
/// that is answered pushes the other one down.
TEST(RigidContact, OfABodyThatRocksToRestDoesNotSink) {
  constexpr double g = 10.0;
  const std::vector<RigidBody> bodies{
      {.parts = {{{-0.5, 0, 0}, {0.5, 0, 0}, 0.05}}, .inertia = {0, 0.09, 0.09}},
      {.parts = {box_part(Box{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}}, 0.05)}, .inertia = {0.18, 0.18, 0.18}}};
  for (const double eps : {1e-4, 1e-6})
    for (const int k : {0, 1, 8, 13, 37, 39}) {
      SCOPED_TRACE(testing::Message() << "tolerance " << eps << ", fall " << k);
      Random random = Random::at(seed, 0, static_cast<std::uint64_t>(k));
      World world = World::create({.contact_tolerance = eps}).value();
      world.add_static({.shape = HalfSpace{{0, 0, 1}, 0}}).value();
      RigidBody body = bodies[static_cast<std::size_t>(k) % 2];
      const Vec3 turned{random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3)};
      const Vec3 spin = rotated(rotation_by(turned), Vec3{0, random.uniform(-1, 1), random.uniform(-1, 1)});
      body.rotation = {rotation_by(turned), spin};
      body.body.position = {0, 0, 1.5};
      body.body.planned_acceleration = {0, 0, -g};
      const BodyId id = world.add_rigid_body(body).value();
      double since = 0.0;
      State state{body.body.position, {}};
      const auto at = [&](double time) {
        const double s = time - since;
        return State{state.position + (state.velocity + Vec3{0, 0, -g} * (0.5 * s)) * s,
                     state.velocity + Vec3{0, 0, -g} * s};
      };
      const auto probe = [&](std::span<const BodyId> ids, double time, std::span<State> states) {
        for (std::size_t j = 0; j < ids.size(); ++j) states[j] = at(time);
      };
      int begins = 0;
      while (const auto event = world.advance(3.0, probe).value()) {
        ASSERT_NE(event->kind, EventKind::zeno_guard);
        if (event->kind != EventKind::contact_begin) continue;
        ++begins;
        ASSERT_GE(event->gap, -0.95 * eps);
        const Bounce after = bounce(*event, 0.5);
        const bool is_first = event->first == id;
        state = {at(event->time).position, is_first ? after.first_velocity : after.second_velocity};
        since = event->time;
        world.set_velocity(id, state.velocity).value();
        world
            .change(id, {.angular_velocity =
                             is_first ? after.first_angular_velocity : after.second_angular_velocity})
            .value();
      }
      EXPECT_GT(begins, 100);
    }
}

/// A seesaw: its ends go up and down while its lower face stays at an edge.
TEST(RigidContact, OfASeesawTakesFewChecks) {
  const Vec3 edge{0.1, 0, -0.03};
  const auto rotation_at = [](double time) {
    return Rotation{rotation_by({0, 0.3 * std::sin(time + 0.2), 0}), {0, 0.3 * std::cos(time + 0.2), 0}};
  };
  const auto state_at = [&](double time) {
    const Vec3 arm = rotated(rotation_at(time).orientation, edge);
    return State{edge - arm, -cross(rotation_at(time).angular_velocity, arm)};
  };
  const Box post{{-0.1, -0.1, -0.5}, {0.1, 0.1, -0.03}};
  for (const bool is_moving : {false, true}) {
    World world = World::create({.contact_tolerance = 1e-6, .contacts = ContactEvents::impacts}).value();
    RigidBody plank{.parts = {box_part(Box{{-1, -0.2, -0.02}, {1, 0.2, 0.02}}, 0.01)},
                    .rotation = rotation_at(0.0),
                    .angular_acceleration_limit = 1.0,
                    .largest_angular_speed = 1.0};
    plank.body.acceleration_limit = 0.1;
    plank.body.position = state_at(0.0).position;
    plank.body.velocity = state_at(0.0).velocity;
    const BodyId id = world.add_rigid_body(plank).value();
    if (is_moving)
      world.add_moving_shape({{}, post}).value();
    else
      world.add_static({.shape = post}).value();
    world
        .set_rotation_probe([&](std::span<const BodyId> ids, double time, std::span<Rotation> rotations) {
          std::fill_n(rotations.begin(), ids.size(), rotation_at(time));
        })
        .value();
    const auto probe = [&](std::span<const BodyId> ids, double time, std::span<State> states) {
      for (std::size_t k = 0; k < ids.size(); ++k) states[k] = ids[k] == id ? state_at(time) : State{};
    };
    while (const auto event = world.advance(1.0, probe).value()) {
      ASSERT_NE(event->kind, EventKind::bound_violation);
      ASSERT_NE(event->kind, EventKind::zeno_guard);
    }
    EXPECT_LT(world.counters().pair_checks, 2000u);
  }
}

/// Needles and other sharp bodies that start across an obstacle and leave it without a response.
TEST(SharpBodies, PassThroughSolidsInFewChecks) {
  constexpr std::uint64_t trials = 300;
  std::uint64_t checks = 0;
  for (std::uint64_t trial = 0; trial < trials; ++trial) {
    const std::uint64_t part = trial;
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", part " << part);
    Random random = Random::at(seed, part, 0);
    const auto some = [&](double lower, double upper) { return lower + (upper - lower) * random.uniform(); };
    const auto point = [&] { return Vec3{some(-0.6, 0.6), some(-0.6, 0.6), some(-0.6, 0.6)}; };
    const double eps = part % 2 == 0 ? 1e-3 : 1e-6;
    World world = World::create({.contact_tolerance = eps}).value();
    const Vec3 half{some(0.1, 0.5), some(0.1, 0.5), some(0.1, 0.5)};
    RigidBody body{.rotation = {.angular_velocity = 3.0 * random.point_in_ball()}};
    const double radius = part % 3 == 0 ? eps : 0.0;
    if (part % 5 < 3)
      body.parts = {{point(), point(), radius}};
    else if (part % 5 == 3)
      body.parts = {box_part({-half, half}, radius)};
    else
      body.parts = {hull_part(std::vector{point(), point(), point()}, radius)};
    body.body.acceleration_limit = part % 4 < 2 ? 0.0 : 0.5;
    body.body.velocity = random.point_in_ball();
    const BodyId id = world.add_rigid_body(body).value();
    switch (random.bits() % 6) {
      case 0:
        world.add_static({.shape = Box{-half, half}}).value();
        break;
      case 1:
        world.add_moving_shape({{}, Box{-half, half}}).value();
        break;
      case 2:
        world.add_static({.shape = Triangle{point(), point(), point()}}).value();
        break;
      case 3:
        world.add_rigid_body({.parts = {box_part({-half, half}, 0.0)}}).value();
        break;
      case 4:
        world.add_static({.shape = Ball{{}, 0.3}}).value();
        break;
      default:
        world.add_rigid_body({.parts = {{point(), point(), 0.0}}}).value();
    }
    const auto probe = straight(id, {{}, body.body.velocity});
    for (double stop = 0.1; stop < 2.05; stop += 0.1) {
      while (world.advance(stop, probe).value()) continue;
      ASSERT_LT(world.counters().pair_checks + world.counters().probes, 20000u) << "at " << stop;
    }
    checks += world.counters().pair_checks + world.counters().probes;
  }
  // They take 336.
  EXPECT_LT(checks, 420 * trials);
}

TEST(ShrinkingBall, OverACapsuleTakesAsFewChecksAsOverABall) {
  for (const double limit : {0.0, 0.1}) {
    World world = World::create({.contact_tolerance = 1e-6}).value();
    const BodyId id = world
                          .add({.radius = 0.5,
                                .acceleration_limit = limit,
                                .velocity = {0.01, 0.02, 0.03},
                                .radius_rate = -0.1})
                          .value();
    world.add_rigid_body({.parts = {{{-0.2, 0, 0}, {0.2, 0, 0}, 0.1}}}).value();
    while (world.advance(1.0, straight(id, {{}, {0.01, 0.02, 0.03}})).value()) continue;
    EXPECT_LT(world.counters().pair_checks, 100u);
  }
}

/// Limits of the distance that need no probe, of a rigid body and a ball that grows or shrinks.
TEST(ChangingBall, BesideARigidBodyHasTheDistanceThatIsTold) {
  for (std::uint64_t part = 0; part < 3000; ++part) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", part " << part);
    Random random = Random::at(seed, part, 1);
    const auto some = [&](double lower, double upper) { return lower + (upper - lower) * random.uniform(); };
    World world = World::create({.contact_tolerance = std::pow(10.0, some(-6, -2))}).value();
    RigidBody rigid{.rotation = {rotation_by(3.0 * random.point_in_ball()), 3.0 * random.point_in_ball()}};
    for (std::size_t k = 1 + random.bits() % 3; k > 0; --k) {
      const double radius = random.bits() % 3 == 0 ? 0.0 : some(0, 0.5);
      const Vec3 at = random.point_in_ball();
      const Vec3 half{some(0.1, 1), some(0.1, 1), some(0.1, 1)};
      if (part % 3 == 0)
        rigid.parts.push_back({at, part % 2 == 0 ? at : random.point_in_ball(), radius});
      else if (part % 3 == 1)
        rigid.parts.push_back(box_part({-half, half}, radius));
      else
        rigid.parts.push_back(hull_part(std::vector{at, half, random.point_in_ball(), -half}, radius));
    }
    rigid.body.position = 3.0 * random.point_in_ball();
    rigid.body.velocity = 2.0 * random.point_in_ball();
    const BodyId first = world.add_rigid_body(rigid).value();
    BodyDefinition ball{.radius = random.uniform()};
    ball.radius_rate = some(-1, 1);
    ball.acceleration_limit = part % 2 == 0 ? 0.0 : random.uniform();
    ball.position = 3.0 * random.point_in_ball();
    ball.velocity = 2.0 * random.point_in_ball();
    const BodyId second = world.add(ball).value();
    const Vec3 acceleration = 0.99 * ball.acceleration_limit * random.point_in_ball();
    const auto position_of = [&](const BodyDefinition& body, double time, const Vec3& steered) {
      return body.position + (body.velocity + steered * (0.5 * time)) * time;
    };
    const auto probe = [&](std::span<const BodyId> ids, double time, std::span<State> states) {
      for (std::size_t k = 0; k < ids.size(); ++k)
        states[k] = ids[k] == first
                        ? State{position_of(rigid.body, time, {}), rigid.body.velocity}
                        : State{position_of(ball, time, acceleration), ball.velocity + acceleration * time};
    };
    double time = 0.0;
    for (int step = 0; step < 6; ++step) {
      time += 0.6 * random.uniform();
      while (world.advance(time, probe).value()) continue;
      const DistanceLimits limits = world.certificates().distance_limits(first, second, time).value();
      const true_hulls::Hull point(std::vector<Vec3>(1));
      const RigidPart grown{.radius = std::max(0.0, ball.radius + ball.radius_rate * time)};
      const placed_parts::PlacedPart there(grown, point, position_of(ball, time, acceleration), {});
      const Quaternion turn =
          after(rotation_by(rigid.rotation.angular_velocity * time), rigid.rotation.orientation);
      double gap = infinity;
      for (const RigidPart& one : rigid.parts) {
        const true_hulls::Hull hull(placed_parts::points_of(one));
        const placed_parts::PlacedPart here(one, hull, position_of(rigid.body, time, {}), turn);
        gap = std::min(gap, placed_parts::gap_of(here, there, false, infinity));
      }
      ASSERT_LE(limits.lower, gap + 1e-14);
      ASSERT_GE(limits.upper, gap - 1e-14);
    }
  }
}

}  // namespace
}  // namespace kinesphere
