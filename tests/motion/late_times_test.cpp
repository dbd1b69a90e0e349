// Worlds at late times, such as Unix seconds, where one unit in the last place of the time moves a body by
// more than a report may be off: no report of a true motion is a violation, and every false one is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "kinesphere/body_map.hpp"
#include "kinesphere/certificates.hpp"
#include "kinesphere/motion/frame_motion.hpp"
#include "kinesphere/random.hpp"
#include "support/test_size.hpp"

namespace kinesphere::late_times_test {
namespace {

/// Returns a number between two others, uniform in its logarithm.
double magnitude(Random& random, double least, double largest) {
  return least * std::pow(largest / least, random.uniform());
}

std::uint64_t violations(const World& world) { return world.counters().count(EventKind::bound_violation); }

struct Case {
  explicit Case(Random& random)
      : start(magnitude(random, 1e3, 1e10)),
        speed(magnitude(random, 1.0, 1e3)),
        tolerance(magnitude(random, 1e-6, 1e-2)) {}

  World world() const { return World::create({.contact_tolerance = tolerance, .start_time = start}).value(); }
  std::string text() const {
    return "start " + std::to_string(start) + ", speed " + std::to_string(speed) + ", tolerance " +
           std::to_string(tolerance);
  }

  double start, speed, tolerance;
};

/// Bodies in random positions, frame after frame, with and without limits and times of their own.
TEST(LateTimes, HaveNoFalseViolationsInFrames) {
  const unsigned rounds = rounds_of(150u);
  std::uint64_t contacts = 0, probes = 0;
  for (std::uint64_t seed = 1; seed <= rounds; ++seed) {
    Random random(seed);
    const Case late(random);
    SCOPED_TRACE("seed " + std::to_string(seed) + ", " + late.text());
    const double interval = magnitude(random, 1e-2, 0.5);
    const double limit = seed % 2 == 0 ? std::numeric_limits<double>::infinity() : late.speed / interval;
    constexpr std::uint32_t count = 12;
    std::vector<Vec3> positions, velocities;
    for (std::uint32_t k = 0; k < count; ++k) {
      positions.push_back(6.0 * random.point_in_ball());
      velocities.push_back(late.speed * random.point_in_ball());
    }
    FrameMotion frames = FrameMotion::create({.start = positions,
                                              .velocities = velocities,
                                              .acceleration_limits = std::vector(count, limit),
                                              .interval = interval,
                                              .start_time = late.start})
                             .value();
    World world = late.world();
    BodyMap bodies;
    bodies.add_all(world, frames, {.radius = 0.5}).value();
    for (int frame = 0; frame < 30; ++frame) {
      for (std::uint32_t k = 0; k < count; ++k) {
        if (random.bits() % 4 == 0)
          velocities[k] += 0.9 * std::min(limit * interval, late.speed) * random.point_in_ball();
        positions[k] += velocities[k] * interval;
      }
      bodies.push(world, frames, positions).value();
      while (world.advance(frames.latest_time(), bodies.probe()).value()) {
      }
      ASSERT_EQ(violations(world), 0u) << "frame " << frame;
    }
    contacts += world.counters().count(EventKind::contact_begin);
    probes += world.counters().probes;
  }
  EXPECT_GT(contacts, 2 * rounds / 3);
  EXPECT_GT(probes, 60 * rounds);
}

/// A probe of a caller whose bodies fall and turn, by formulas that begin at the rounded times of their
/// steps.
TEST(LateTimes, HaveNoFalseViolationsOfOwnProbes) {
  std::uint64_t probes = 0;
  for (std::uint64_t seed = 1; seed <= rounds_of(200u); ++seed) {
    Random random(seed);
    const Case late(random);
    SCOPED_TRACE("seed " + std::to_string(seed) + ", " + late.text());
    const Vec3 gravity = late.speed * random.point_in_ball();
    const Vec3 velocity = late.speed * random.point_in_ball();
    const Vec3 spin = std::min(late.speed, 50.0) * random.point_in_ball();
    const double step = magnitude(random, 1e-2, 0.5);
    // The exact motion since the start, and so what is `late` after the rounded begin of the step.
    const auto since_start = [&](double time) {
      const double steps = std::floor((time - late.start) / step);
      return steps * step + (time - (late.start + steps * step));
    };
    const auto probe = [&](std::span<const BodyId> ids, double time, std::span<State> states) {
      const double s = since_start(time);
      for (std::size_t k = 0; k < ids.size(); ++k)
        states[k] = {Vec3{2.5 * ids[k].index, 0, 0} + velocity * s + gravity * (0.5 * s * s),
                     velocity + gravity * s};
    };
    World world = late.world();
    world
        .set_rotation_probe([&](std::span<const BodyId> ids, double time, std::span<Rotation> rotations) {
          for (std::size_t k = 0; k < ids.size(); ++k)
            rotations[k] = {rotation_by(spin * since_start(time)), spin};
        })
        .value();
    // Side by side, so that they are probed again and again.
    for (int k = 0; k < 2; ++k) {
      const BodyDefinition body{.acceleration_limit = 1e-3,
                                .planned_acceleration = gravity,
                                .position = {2.5 * k, 0, 0},
                                .velocity = velocity};
      world.add_rigid_body({.body = body, .parts = {{}}, .rotation = {.angular_velocity = spin}}).value();
    }
    for (int k = 1; k <= 100; ++k) {
      const double time = late.start + 0.37 * step * k;
      ASSERT_FALSE(world.advance(time, probe).value());
      world.certificates(probe).distance_limits({0, 0}, {1, 0}, time).value();
    }
    ASSERT_FALSE(world.advance(late.start + 38.0 * step, probe).value());
    probes += world.counters().probes;
  }
  EXPECT_GT(probes, 1000u);
}

/// A body that jumps by more than the time may be off is found out, however late it is.
TEST(LateTimes, HideNoTrueViolation) {
  for (std::uint64_t seed = 1; seed <= rounds_of(200u); ++seed) {
    Random random(seed);
    const Case late(random);
    SCOPED_TRACE("seed " + std::to_string(seed) + ", " + late.text());
    const Vec3 velocity = late.speed * random.unit_vector();
    const double allowed = late.tolerance / 16.0 + 0x1p-50 * late.start * late.speed;
    const Vec3 jump = 1.1 * allowed * random.unit_vector();
    const auto probe = [&](std::span<const BodyId> ids, double time, std::span<State> states) {
      const double s = time - late.start;
      for (std::size_t k = 0; k < ids.size(); ++k)
        states[k] = {velocity * s + (s > 0.0 ? jump : Vec3{}), velocity};
    };
    World world = late.world();
    const BodyId body = world.add({.velocity = velocity}).value();
    ASSERT_FALSE(world.advance(late.start, probe).value());
    const auto found = world.advance(late.start + 1.0, probe).value();
    ASSERT_TRUE(found);
    EXPECT_EQ(found->kind, EventKind::bound_violation);
    EXPECT_EQ(found->first, body);
  }
}

}  // namespace
}  // namespace kinesphere::late_times_test
