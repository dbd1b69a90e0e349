// Frames of unequal length, which the game pushes with their times: events of such games, the limits of their
// bodies, and times that cannot be.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kinesphere/body_map.hpp"
#include "kinesphere/certificates.hpp"
#include "kinesphere/motion/frame_motion.hpp"
#include "kinesphere/random.hpp"
#include "kinesphere/simulation.hpp"
#include "support/expect_error.hpp"
#include "support/straight_frames.hpp"

namespace kinesphere::frame_times_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

using Places = std::vector<Vec3>;

/// A game with frames of 10 and 30 ms. The ball at speed 3 comes to the other one when its clock says 1.
TEST(FrameTimes, AreThoseOfTheGame) {
  Places places{{0, 0, 0}, {4, 0, 0}};
  FrameMotion frames = FrameMotion::create({.start = places}).value();
  World world = World::create({}).value();
  BodyMap bodies;
  bodies.add_all(world, frames, {.radius = 0.5}).value();
  double time = 0.0;
  std::optional<Event> begin;
  for (int frame = 0; frame < 60; ++frame) {
    const double dt = frame % 2 == 0 ? 0.030 : 0.010;
    time += dt;
    places[0].x += 3.0 * dt;
    bodies.push(world, frames, places, time).value();
    EXPECT_EQ(frames.latest_time(), time);
    for (const Event& event : world.events(time, bodies.probe()))
      if (event.kind == EventKind::contact_begin) begin = event;
  }
  ASSERT_TRUE(begin);
  EXPECT_NEAR(begin->approach_speed, 3.0, 1e-9);
  EXPECT_NEAR(begin->time, 1.0, 1e-6);
}

TEST(FrameTimes, InterpolateWithinTheirFrame) {
  FrameMotion frames =
      FrameMotion::create({.start = {{}}, .acceleration_limits = {1e3}, .interval = 0.5, .start_time = 1.0})
          .value();
  frames.push(Places{{1, 0, 0}}, 1.25).value();
  EXPECT_FALSE(frames.has_equal_frames());
  EXPECT_EQ(frames.previous_time(), 1.0);
  EXPECT_EQ(frames.state(0, 1.125), (State{{0.5, 0, 0}, {4, 0, 0}}));
  frames.set_velocity(0, 1.125, {0, 8, 0}).value();
  EXPECT_EQ(frames.latest()[0], (Vec3{0.5, 1, 0}));
  frames.push(Places{{1.5, 1, 0}}, 2.25).value();
  EXPECT_EQ(frames.state(0, 1.75), (State{{1.0, 1, 0}, {1, 0, 0}}));
  // Without a time a frame comes one interval after the latest one.
  frames.push(Places{{2.5, 1, 0}}).value();
  EXPECT_EQ(frames.latest_time(), 2.75);
  EXPECT_EQ(frames.previous_time(), 2.25);
  EXPECT_EQ(frames.latest_frame(), 3u);
  EXPECT_EQ(frames.state(0, 2.5), (State{{2.0, 1, 0}, {2, 0, 0}}));
}

/// A frame that is pushed with the time that it would have without one changes nothing.
TEST(FrameTimes, OfEqualFramesAreThoseWithoutTimes) {
  Random random(1);
  Places places{{}, {5, 5, 5}};
  const FrameMotionDefinition definition{
      .start = places, .acceleration_limits = {1e9, 1e9}, .interval = 0.1, .position_error = 1e-3};
  FrameMotion given = FrameMotion::create(definition).value();
  FrameMotion counted = FrameMotion::create(definition).value();
  for (int frame = 1; frame <= 200; ++frame) {
    for (Vec3& place : places) place += random.point_in_ball();
    given.push(places, 0.1 * frame).value();
    counted.push(places).value();
    ASSERT_TRUE(given.has_equal_frames());
    ASSERT_EQ(given.latest_time(), counted.latest_time());
    const double time = given.previous_time() + 0.03;
    ASSERT_EQ(given.state(1, time), counted.state(1, time));
  }
}

TEST(FrameTimes, ThatDoNotRiseAreRefused) {
  Places places{{}, {10, 0, 0}};
  FrameMotion frames = FrameMotion::create({.start = places, .start_time = 2.0}).value();
  World world = World::create({.start_time = 2.0}).value();
  BodyMap bodies;
  bodies.add_all(world, frames).value();
  places[0].x = 1.0;
  const std::string call = "BodyMap::push: time must ";
  expect_error(bodies.push(world, frames, places, 2.0), ErrorCode::time_backwards, "time", call);
  expect_error(bodies.push(world, frames, places, 1.0), ErrorCode::time_backwards, "time", call);
  expect_error(bodies.push(world, frames, places, nan), ErrorCode::not_finite, "time", call);
  expect_error(bodies.push(world, frames, places, infinity), ErrorCode::not_finite, "time", call);
  EXPECT_EQ(bodies.push(world, frames, places, 1.0).error().message,
            "BodyMap::push: time must bring the next frame after the latest one, at 2, but is 1");
  EXPECT_EQ(frames.latest_time(), 2.0);
  EXPECT_TRUE(frames.has_equal_frames());
  EXPECT_EQ(world.body({0, 0})->bound.velocity, Vec3{});
  bodies.push(world, frames, places, 2.5).value();
  EXPECT_EQ(world.body({0, 0})->bound.velocity, (Vec3{2, 0, 0}));
  // An interval that is lost in the digits of the time.
  FrameMotion late = FrameMotion::create({.start = places, .interval = 1e-9, .start_time = 1e9}).value();
  expect_error(late.push(places), ErrorCode::time_backwards, "interval", "push: interval must ");
}

/// A game that steps velocities by at most A dt, before or after it moves its bodies, or that moves them on
/// parabolas. No frame is longer than the interval, so the world need not be informed.
TEST(FrameTimes, UpToTheIntervalKeepLimits) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    constexpr double limit = 9.81, longest = 0.05;
    Vec3 position = 10.0 * random.point_in_ball(), velocity = 10.0 * random.point_in_ball();
    FrameMotion frames = FrameMotion::create({.start = {position},
                                              .velocities = {velocity},
                                              .acceleration_limits = {limit},
                                              .interval = longest})
                             .value();
    double time = 0.0;
    for (int frame = 0; frame < 300; ++frame) {
      const double dt = random.bits() % 4 == 0 ? longest : random.uniform(0.001, longest);
      const Vec3 acceleration = random.bits() % 2 == 0 ? Vec3{0, 0, -limit} : limit * random.unit_vector();
      if (seed % 3 == 0) velocity += acceleration * dt;
      position += velocity * dt;
      if (seed % 3 == 1) velocity += acceleration * dt;
      if (seed % 3 == 2) {
        position += acceleration * (0.5 * dt * dt);
        velocity += acceleration * dt;
      }
      time += dt;
      frames.push({&position, 1}, time).value();
      ASSERT_TRUE(frames.violations().empty());
    }
  }
}

/// A jump that the limit permits in a long frame, and the velocity error of the interval does not cover.
TEST(FrameTimes, LongerThanTheIntervalInformTheWorld) {
  Places places{{}, {100, 0, 0}};
  FrameMotion frames =
      FrameMotion::create({.start = places, .acceleration_limits = {1.0, 1.0}, .interval = 0.25}).value();
  World world = World::create({}).value();
  BodyMap bodies;
  bodies.add_all(world, frames).value();
  const auto push = [&](double x, double time) {
    places[0].x = x;
    bodies.push(world, frames, places, time).value();
    while (world.advance(time, bodies.probe()).value()) {
    }
    EXPECT_TRUE(frames.violations().empty());
    return world.body({0, 0})->bound.velocity.x;
  };
  EXPECT_EQ(push(0.25, 1.0), 0.0) << "velocity 1/4 is covered";
  EXPECT_EQ(push(1.0, 2.0), 0.75) << "a jump of 1/2 is not";
  EXPECT_EQ(push(1.5, 2.5), 0.75) << "a jump of 1/4 is";
  EXPECT_EQ(push(2.0 - 0.125, 3.0 - 0.125), 0.75) << "half a unit of time has covered the last one";
  EXPECT_EQ(push(1.875 + 0.1640625, 3.0), 1.3125) << "a jump of 5/16 is not";
  // Jumps of 1/8 that the longer frame of the two permits, and whose sum does not stay covered.
  double x = places[0].x, time = 3.0, velocity = 1.3125;
  for (int frame = 0; frame < 6; ++frame) {
    const double dt = frame % 2 == 0 ? 0.0625 : 0.125;
    velocity += 0.125;
    time += dt;
    x += velocity * dt;
    EXPECT_EQ(push(x, time), frame < 5 ? 1.3125 : velocity) << frame;
  }
}

/// What a body of the random games does.
struct Walker {
  Vec3 position, velocity;
};

/// Random games whose bodies keep their limits in frames of random lengths, some longer than the interval: no
/// report contradicts an earlier one, and contacts are those of the straight lines.
TEST(FrameTimes, LoseAndInventNoContact) {
  constexpr double touch = 1.0, tolerance = 1e-4;
  StraightFrames truth(touch, 2e-4);
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const bool has_limits = seed % 3 != 0;
    const double limit = 8.0, interval = 0.05, error = seed % 2 == 0 ? 1e-7 : 0.0;
    constexpr std::uint32_t count = 16;
    std::vector<Walker> walkers;
    Places places;
    for (std::uint32_t k = 0; k < count; ++k) {
      walkers.push_back({5.0 * random.point_in_ball(), 3.0 * random.point_in_ball()});
      places.push_back(walkers[k].position);
    }
    std::vector<Vec3> velocities;
    for (const Walker& walker : walkers) velocities.push_back(walker.velocity);
    FrameMotionDefinition definition{
        .start = places, .velocities = velocities, .interval = interval, .position_error = error};
    if (has_limits) definition.acceleration_limits.assign(count, limit);
    FrameMotion frames = FrameMotion::create(std::move(definition)).value();
    World world = World::create({.contact_tolerance = tolerance}).value();
    BodyMap bodies;
    const std::vector<BodyId> ids = bodies.add_all(world, frames, {.radius = touch / 2}).value();
    double time = 0.0;
    for (int frame = 0; frame < 100; ++frame) {
      const double dt = random.bits() % 3 == 0 ? random.uniform(0.05, 0.2) : random.uniform(0.002, 0.05);
      const Places before = places;
      for (std::uint32_t k = 0; k < count; ++k) {
        auto& [position, velocity] = walkers[k];
        // Back to the middle, with nearly all that the limit permits.
        const Vec3 pull = position * (-limit / std::max(5.0, norm(position)));
        const Vec3 acceleration = 0.5 * pull + 0.49 * limit * random.unit_vector();
        position += velocity * dt + acceleration * (0.5 * dt * dt);
        velocity += acceleration * dt;
        places[k] = position + error * random.point_in_ball();
      }
      time = random.bits() % 8 == 0 ? time + interval : time + dt;
      if (time != frames.latest_time() + dt) {
        // A frame of one interval, without a time.
        for (std::uint32_t k = 0; k < count; ++k)
          places[k] = before[k] + (places[k] - before[k]) * (interval / dt);
        for (std::uint32_t k = 0; k < count; ++k) walkers[k].position = places[k];
        bodies.push(world, frames, places).value();
        time = frames.latest_time();
      } else {
        bodies.push(world, frames, places, time).value();
      }
      const double from_time = frames.previous_time(), length = time - from_time;
      BegunPairs begun(count, std::vector<bool>(count));
      for (int part = 1; part <= 4; ++part) {
        const double stop = part == 4 ? time : from_time + 0.25 * part * length;
        while (const auto event = world.advance(stop, bodies.probe()).value()) {
          ASSERT_NE(event->kind, EventKind::bound_violation) << "frame " << frame;
          if (event->kind == EventKind::contact_begin)
            begun[event->first.index][event->second.index] = begun[event->second.index][event->first.index] =
                true;
        }
        // Reports that the world would not have asked for.
        const std::uint32_t a = random.bits() % count, b = random.bits() % count;
        if (a != b) world.certificates(bodies.probe()).distance_limits(ids[a], ids[b], stop).value();
      }
      SCOPED_TRACE("frame " + std::to_string(frame));
      truth.expect(before, places, begun, [](std::uint32_t) { return true; });
      if (HasFailure()) return;
    }
  }
  EXPECT_GT(truth.met, 500u);
  EXPECT_GT(truth.apart, 50000u);
}

/// A copy, and a motion that has read the bodies of another one, inform the world when the original does.
TEST(FrameTimes, GoAlongWithClonesAndBytes) {
  Random random(7);
  constexpr std::uint32_t count = 20;
  const FrameMotionDefinition definition{.start = Places(count),
                                         .acceleration_limits = std::vector(count, 1.0),
                                         .interval = 0.1,
                                         .position_error = 1e-4};
  FrameMotion first = FrameMotion::create(definition).value();
  FrameMotion empty = FrameMotion::create({.start = {}, .interval = 0.1, .position_error = 1e-4}).value();
  Places places(count), none;
  const auto move = [&](double most) {
    for (Vec3& place : places) place += most * random.point_in_ball();
  };
  double time = 0.0;
  std::uint64_t informed = 0;
  for (int frame = 0; frame < 30; ++frame) {
    const double dt = random.uniform(0.05, 0.3);
    move(0.03 * dt);
    time += dt;
    first.push(places, time).value();
    empty.push(none, time).value();
    FrameMotion second = *dynamic_cast<FrameMotion*>(first.clone().get());
    FrameMotion third = empty;
    for (std::uint32_t body = 0; body < count; ++body) {
      std::vector<std::byte> bytes;
      first.write_body(body, bytes).value();
      std::span<const std::byte> rest = bytes;
      ASSERT_EQ(third.read_body(rest).value(), body);
      ASSERT_TRUE(rest.empty());
    }
    const Places kept = places;
    move(0.09);
    for (const bool has_time : {true, false}) {
      const std::optional<double> next = has_time ? std::optional<double>(time + 0.2) : std::nullopt;
      FrameMotion original = first;
      const auto pushed = original.push(places, next);
      informed += pushed ? 0 : 1;
      for (FrameMotion* other : {&second, &third}) {
        FrameMotion copy = *other;
        const auto again = copy.push(places, next);
        ASSERT_EQ(static_cast<bool>(again), static_cast<bool>(pushed));
        if (!pushed) {
          ASSERT_EQ(again.error().message, pushed.error().message);
        }
        ASSERT_EQ(copy.latest_time(), original.latest_time());
        ASSERT_EQ(copy.latest(), original.latest());
      }
    }
    places = kept;
  }
  EXPECT_GT(informed, 10u);
  std::vector<std::byte> bytes;
  first.write_body(0, bytes).value();
  std::span<const std::byte> rest = bytes;
  FrameMotion other = FrameMotion::create({.start = {}, .interval = 0.1, .position_error = 1e-4}).value();
  for (int frame = 0; frame < 30; ++frame) other.push(none).value();
  const std::string refused = other.read_body(rest).error().message;
  EXPECT_NE(refused.find("FrameMotion: previous_time must be that of the frame here"), std::string::npos)
      << refused;
}

TEST(FrameTimes, OfASimulation) {
  Simulation game(World::create({}).value());
  const auto frames = game.add_motion(FrameMotion::create({.start = {{}, {3, 0, 0}}}).value());
  game.add_all(frames, {.radius = 0.5}).value();
  game.push(frames, Places{{4, 0, 0}, {3, 0, 0}}, 4.0).value();
  const auto begin = game.advance(4.0).value();
  ASSERT_TRUE(begin);
  EXPECT_NEAR(begin->time, 2.0, 1e-5);
  EXPECT_NEAR(begin->approach_speed, 1.0, 1e-12);
}

}  // namespace
}  // namespace kinesphere::frame_times_test
