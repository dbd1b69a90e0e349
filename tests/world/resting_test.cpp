// Bodies that come to rest on each other, are jammed, or grind: bouncing must fade out and time must go on.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "kinesphere/kinesphere.hpp"
#include "number/infinity.hpp"
#include "support/playground.hpp"
#include "support/test_size.hpp"

namespace kinesphere::resting_test {
namespace {

constexpr double g = 10.0;
constexpr Vec3 gravity{0, 0, -g};

/// A playground with responses by settle(); masses by index, equal unless given.
struct Heap : Playground {
  Heap(const Box& box, double tolerance, double restitution_, double hop_speed = 0.0)
      : Playground({.box = box,
                    .contact_tolerance = tolerance,
                    .contacts = ContactEvents::impacts,
                    .zeno_interval = 2.0 * hop_speed / g}),
        restitution(restitution_),
        resting_speed(std::max(hop_speed, least_resting_speed(tolerance, g))) {}

  double mass(BodyId id) const { return id.index < masses.size() ? masses[id.index] : 1.0; }

  void answer(const Event& event) {
    if (event.kind == EventKind::zeno_guard) return;
    ++contacts;
    const bool pair = event.second != no_body;
    const Bounce after =
        settle(event, mass(event.first), pair ? mass(event.second) : 1.0, restitution, resting_speed);
    set_velocity(event.first, after.first_velocity);
    if (pair) set_velocity(event.second, after.second_velocity);
  }

  void settle_until(double time, std::size_t at_most) {
    run(
        time, [this](const Event& event) { answer(event); }, at_most);
  }

  double restitution;
  double resting_speed;
  std::vector<double> masses;
  std::size_t contacts = 0;
};

constexpr Box room{{-10, -10, 0}, {10, 10, 100}};

/// Dropped from height h it falls for t0 = sqrt(2 h / g), then flies for 2 v / g with v = e v0, e^2 v0, ... :
/// it comes to rest at t0 (1 + e) / (1 - e).
TEST(Sleeping, DroppedBallBouncesAsTheSeriesSays) {
  for (const double e : {0.3, 0.5, 0.8}) {
    const double h = 1.25, tolerance = 1e-6;
    Heap p(room, tolerance, e);
    const BodyId ball = p.add({.radius = 1, .planned_acceleration = gravity, .position = {0, 0, 1.0 + h}});
    double due = std::sqrt(2 * h / g);
    double speed = g * due;
    double at_rest = due * (1 + e) / (1 - e);
    std::size_t k = 0;
    const auto answer = [&](const Event& event) {
      if (speed > 2.0 * p.resting_speed / e) {
        ++k;
        EXPECT_NEAR(event.time, due, 1e-3 * static_cast<double>(k) * 0.1) << "bounce " << k;
        EXPECT_NEAR(event.approach_speed, speed, 1e-3 * speed) << "bounce " << k;
        EXPECT_FALSE(event.repeated) << "bounce " << k;
        speed *= e;
        due += 2 * speed / g;
      }
      p.answer(event);
    };
    p.run(at_rest + 0.01, answer, 1000);
    EXPECT_GT(k, 4u);
    double highest = 0.0;
    for (int tick = 1; tick <= 100; ++tick) {
      p.run(at_rest + 0.01 + 0.01 * tick, answer, 1000);
      const double height = p.state(ball).position.z - 1.0;
      EXPECT_GE(height, -tolerance);
      highest = std::max(highest, height);
    }
    EXPECT_LE(highest, 4.0 * tolerance) << "hops of the least resting speed are 1.5 tolerances high";
    EXPECT_EQ(p.world.counters().count(EventKind::zeno_guard), 0u);
    EXPECT_LT(static_cast<double>(p.contacts), 10.0 + 4.0 * g / p.resting_speed);
  }
}

TEST(Sleeping, StackOfTenInATube) {
  for (const double e : {0.0, 0.5, 0.9}) {
    const double tolerance = 1e-4;
    Heap p({{-0.501, -0.501, 0}, {0.501, 0.501, 20}}, tolerance, e, 0.1);
    std::vector<BodyId> stack;
    for (int k = 0; k < 10; ++k)
      stack.push_back(p.add({.radius = 0.5,
                             .planned_acceleration = gravity,
                             .position = {0.0005 * (k % 3 - 1), 0.0005 * (k % 2), 0.6 + 1.1 * k}}));
    for (int tick = 1; tick <= 100 && !HasFailure(); ++tick) {
      p.settle_until(0.05 * tick, 20000);
      EXPECT_GE(p.state(stack.front()).position.z, 0.5 - tolerance);
      for (std::size_t k = 1; k < stack.size(); ++k) EXPECT_GE(p.gap(stack[k - 1], stack[k]), -tolerance);
    }
    EXPECT_EQ(p.world.counters().count(EventKind::zeno_guard), 0u) << "restitution " << e;
    EXPECT_LT(p.state(stack.back()).position.z, 9.5 + 0.05) << "it stands, " << p.contacts << " contacts";
    EXPECT_TRUE(is_clean(p.world));
  }
}

/// Two heavy bodies are driven onto a light one between them, without end.
TEST(Sleeping, JammedBallDoesNotStopTime) {
  for (const double e : {0.0, 0.5, 1.0}) {
    const double tolerance = 1e-4;
    Heap p(room, tolerance, e, 0.05);
    p.masses = {100.0, 1.0, 100.0};
    const BodyId left =
        p.add({.radius = 2, .acceleration_limit = 1, .position = {-3.5, 0, 50}}, Vec3{1, 0, 0});
    const BodyId ball = p.add({.radius = 1, .acceleration_limit = 1, .position = {0, 0, 50}}, Vec3{});
    const BodyId right =
        p.add({.radius = 2, .acceleration_limit = 1, .position = {3.5, 0, 50}}, Vec3{-1, 0, 0});
    for (int tick = 1; tick <= 100 && !HasFailure(); ++tick) {
      p.settle_until(0.1 * tick, 50000);
      EXPECT_GE(p.gap(left, ball), -tolerance);
      EXPECT_GE(p.gap(ball, right), -tolerance);
    }
    EXPECT_EQ(p.world.time(), 10.0);
    EXPECT_EQ(p.world.counters().count(EventKind::zeno_guard), 0u) << "restitution " << e;
    if (e < 1.0) {
      EXPECT_LT(p.gap(left, ball) + p.gap(ball, right), 0.02) << "restitution " << e;
    }
    EXPECT_TRUE(is_clean(p.world));
  }
}

/// A ball slides down a smooth dome from an unstable position: it leaves where cos = 2/3 + v^2 / (3 g R).
TEST(Sleeping, BallGrindsOverADomeAndLeavesWhereItMust) {
  const double tolerance = 1e-7;  // near the end hops take ever longer, the shorter the finer they are
  Heap p({{-100, -100, -100}, {100, 100, 100}}, tolerance, 0.0);
  p.masses = {1e12, 1.0};
  const BodyId dome = p.add({.radius = 9});
  const BodyId ball = p.add(
      {.radius = 1, .planned_acceleration = gravity, .position = {0, 0, 10.0 + 1e-9}, .velocity = {1, 0, 0}});
  double last = 1.0;
  p.run(
      4.0,
      [&](const Event& event) {
        last = p.state(ball).position.z / 10.0;
        p.answer(event);
        EXPECT_GE(p.gap(dome, ball), -tolerance);
      },
      100000);
  EXPECT_NEAR(last, 2.0 / 3.0 + 1.0 / (3.0 * g * 10.0), 0.01);
  EXPECT_GT(p.gap(dome, ball), 1.0) << "it is gone";
  EXPECT_GT(p.contacts, 100u);
  EXPECT_EQ(p.world.counters().count(EventKind::zeno_guard), 0u);
}

/// With begin and end, a lasting contact is one contact: a caller that stops its body at the begin gets no
/// further events.
TEST(Sleeping, HeldByTheCallerIsOneLastingContact) {
  for (const bool wall : {true, false}) {
    Playground p({.box = room, .contacts = ContactEvents::begin_and_end});
    const BodyId ball =
        p.add({.radius = 1, .acceleration_limit = g, .position = {0, 0, wall ? 1.5 : 5.5}}, gravity);
    if (!wall) p.add({.radius = 1.5, .position = {0, 0, 2}});
    const auto events = p.run(20.0, [&](const Event&) {
      p.steer(ball, {});
      p.set_velocity(ball, {});
    });
    ASSERT_EQ(events.size(), 1u) << events;
    EXPECT_NEAR(events[0].time, std::sqrt(0.1 * (wall ? 1.0 : 2.0)), 1e-5);
    // A contact that was responded to is watched for another approach, by least steps of the Zeno guard: in
    // each the ball could fall by an eighth of the tolerance.
    EXPECT_LT(p.world.counters().probes, 20.0 / std::sqrt(2.0 * 0.125e-6 / (g + g)));
    EXPECT_TRUE(is_clean(p.world));
  }
}

/// A ball in a corridor that it fills touches both walls at once: thrown from one to the other, it gets
/// nowhere.
struct Jam : Playground {
  explicit Jam(double width)
      : Playground({.box = Box{{-10, -10, 0}, {10, 10, width}}, .contacts = ContactEvents::impacts}),
        ball(add({.radius = 1, .position = {0, 0, 0.5 * width}, .velocity = {1, 0, 1}})) {}
  BodyId ball;
};

TEST(Jammed, BallInACorridorComesThrough) {
  for (const double width : {1.9999995, 2.0, 2.0 + 1e-12, 2.0000005, 2.000001}) {
    for (const double restitution : {0.0, 0.5, 1.0}) {
      Jam p(width);
      const auto events = p.run(
          5.0,
          [&](const Event& event) {
            if (event.kind == EventKind::wall_begin)
              p.set_velocity(p.ball, bounce(event, 1, 1, restitution).first_velocity);
          },
          1000);
      ASSERT_EQ(p.world.time(), 5.0) << width << " restitution " << restitution;
      EXPECT_NEAR(p.state(p.ball).position.x, 5.0, 1e-9);
      EXPECT_TRUE(of_kind(events, EventKind::zeno_guard).empty());
      EXPECT_TRUE(is_clean(p.world));
      if (restitution == 1.0) {
        EXPECT_TRUE(std::any_of(events.begin(), events.end(), [](const Event& e) { return e.jammed; }));
      }
    }
  }
}

/// No velocity parts the ball from both walls.
TEST(Jammed, BallIsLetThroughIfAnswersGoOn) {
  Jam p(2.0);
  const auto events = p.run(
      1.0,
      [&](const Event& event) {
        if (event.kind != EventKind::wall_begin) return;
        const Vec3 velocity = p.state(p.ball).velocity;
        p.set_velocity(p.ball, velocity - event.normal * (2.0 * dot(velocity, event.normal)));
      },
      3000);
  EXPECT_EQ(p.world.time(), 1.0);
  EXPECT_GE(p.world.counters().zeno_steps, 8u);
  EXPECT_EQ(of_kind(events, EventKind::zeno_guard).size(), 1u) << "said once, of the wall that it passes";
  EXPECT_TRUE(is_clean(p.world));
}

/// A piston, or a ball of infinite mass, drives a ball onto the floor. No velocities part the three.
TEST(Jammed, BallThatIsCrushedDoesNotStopTime) {
  for (const bool is_piston : {true, false})
    for (const double restitution : {0.0, 0.5, 1.0}) {
      SCOPED_TRACE(testing::Message() << is_piston << ", restitution " << restitution);
      Playground p({.box = Box{{-5, -5, 0}, {5, 5, 10}}});
      p.add({.radius = 1, .position = {0, 0, 1}});
      const BodyDefinition press{
          .radius = 1, .position = {0, 0, 3.5}, .velocity = {0, 0, -1}, .mass = infinity};
      if (is_piston)
        p.start_course(p.world.add_moving_shape({press, Box{{-1, -1, 0}, {1, 1, 0.2}}}).value(), press);
      else
        p.add(press);
      const auto events = p.run(
          3.0,
          [&](const Event& event) {
            const Response after = response_of(event, bounce(event, restitution));
            if (after.first_velocity) p.set_velocity(event.first, *after.first_velocity);
            if (after.second_velocity) p.set_velocity(event.second, *after.second_velocity);
          },
          60000);
      EXPECT_EQ(p.world.time(), 3.0);
      EXPECT_LE(of_kind(events, EventKind::zeno_guard).size(), 4u);
      EXPECT_TRUE(is_clean(p.world));
    }
}

/// Many bodies that arrive at one instant are not a jam.
TEST(Jammed, IsNotWhatManyHitAtOnce) {
  Playground p({.contacts = ContactEvents::impacts});
  const BodyId target = p.add({.radius = 10});
  Random random(1);
  for (int k = 0; k < 100; ++k) {
    const Vec3 out = random.unit_vector();
    p.add({.radius = 0.0,
           .position = 20.0 * out,
           .velocity = -1.0 * out,
           .filter = {.category = 2, .mask = 1}});
  }
  std::size_t begins = 0;
  for (const Event& event : p.run(12.0)) {
    EXPECT_EQ(event.first, target);
    EXPECT_FALSE(event.jammed);
    ++begins;
  }
  EXPECT_GE(begins, 100u);
}

/// With bounce() the bodies of a heap hop within the tolerance: as often as falls through it follow each
/// other.
TEST(Bouncing, InAHeapCostsWhatTheToleranceSays) {
  constexpr std::uint32_t side = 4;
  constexpr std::array tolerances{1e-3, 1e-4};
  for (const double tolerance : std::span(tolerances).first(rounds_of(tolerances.size()))) {
    SCOPED_TRACE(tolerance);
    BallisticDefinition flight{.gravity = gravity};
    Random random(1);
    for (std::uint32_t k = 0; k < side * side * side; ++k)
      flight.start.push_back(
          {{k % side + 0.5, k / side % side + 0.5, k / (side * side) + 0.5}, random.point_in_ball() * 0.5});
    Ballistic motion = Ballistic::create(flight).value();
    const Box box{{}, {side, side, side}};
    World world = World::create({.box = box, .contact_tolerance = tolerance}).value();
    for (std::uint32_t body = 0; body < flight.start.size(); ++body) {
      BodyDefinition ball = motion.definition(body, 0.0);
      ball.radius = 0.4;
      world.add(ball).value();
    }
    SingleMotionSource source(motion);
    std::uint64_t contacts = 0;
    const auto respond = [](const Event& event) { return response_of(event, bounce(event, 0.5)); };
    const auto count = [&](const Event& event) {
      contacts += event.kind == EventKind::contact_begin || event.kind == EventKind::wall_begin;
    };
    world.run(6.0, source, respond, [](const Event&) {}).value();
    world.run(7.0, source, respond, count).value();
    const double each = static_cast<double>(contacts) / static_cast<double>(flight.start.size());
    EXPECT_GT(each / std::sqrt(g / tolerance), 1.0);
    EXPECT_LT(each / std::sqrt(g / tolerance), 12.0);
  }
}

}  // namespace
}  // namespace kinesphere::resting_test
