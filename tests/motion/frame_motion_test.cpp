// The frames of a game loop: interpolation, and the limits across many frames.
#include "kinesphere/motion/frame_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "kinesphere/motion/random_forces.hpp"
#include "kinesphere/world.hpp"
#include "motion/motion_properties.hpp"
#include "support/expect_error.hpp"

namespace kinesphere::frame_motion_test {
namespace {

TEST(Frames, InterpolateBetweenTheLastTwo) {
  FrameMotion frames =
      FrameMotion::create(
          {.start = {{0, 0, 0}}, .acceleration_limits = {8.0}, .interval = 0.5, .start_time = 1.0})
          .value();
  EXPECT_EQ(frames.latest_time(), 1.0);
  EXPECT_EQ(frames.state(0, 1.0), State{});
  frames.push(std::vector<Vec3>{{1, 0, 0}}).value();
  frames.push(std::vector<Vec3>{{2, 1, 0}}).value();
  EXPECT_EQ(frames.previous_time(), 1.5);
  EXPECT_EQ(frames.latest_time(), 2.0);
  EXPECT_EQ(frames.state(0, 1.5), (State{{1, 0, 0}, {2, 2, 0}}));
  EXPECT_EQ(frames.state(0, 1.75), (State{{1.5, 0.5, 0}, {2, 2, 0}}));
  EXPECT_EQ(frames.state(0, 2.0), (State{{2, 1, 0}, {2, 2, 0}}));
}

TEST(Frames, BeginWithTheVelocitiesOfTheGame) {
  FrameMotionDefinition definition{
      .start = {{1, 2, 3}}, .velocities = {{4, 5, 6}}, .acceleration_limits = {1.0}};
  const FrameMotion frames = FrameMotion::create(definition).value();
  EXPECT_EQ(frames.definition(0, 0.0).velocity, (Vec3{4, 5, 6}));
  definition.velocities.push_back({});
  EXPECT_EQ(FrameMotion::create(definition).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(FrameMotion::create(definition).error().argument, "velocities");
  definition.velocities = {{0, std::numeric_limits<double>::infinity(), 0}};
  EXPECT_EQ(FrameMotion::create(definition).error().code, ErrorCode::not_finite);
}

TEST(Frames, KickTurnsTheRestOfTheFrame) {
  FrameMotion frames =
      FrameMotion::create(
          {.start = {{0, 0, 0}, {5, 5, 5}}, .acceleration_limits = {8.0, 8.0}, .interval = 1.0})
          .value();
  frames.push(std::vector<Vec3>{{4, 0, 0}, {5, 5, 5}}).value();
  EXPECT_TRUE(frames.set_velocity(0, 0.5, {-2, 0, 6}));
  EXPECT_EQ(frames.state(0, 0.5), (State{{2, 0, 0}, {-2, 0, 6}}));
  EXPECT_EQ(frames.state(0, 0.75), (State{{1.5, 0, 1.5}, {-2, 0, 6}}));
  EXPECT_EQ(frames.latest()[0], (Vec3{1, 0, 3}));
  EXPECT_EQ(frames.latest()[1], (Vec3{5, 5, 5}));
  EXPECT_EQ(frames.set_velocity(0, 0.25, {}).error().code, ErrorCode::time_backwards) << "before the last";
  EXPECT_EQ(frames.set_velocity(0, 1.25, {}).error().code, ErrorCode::out_of_range) << "after the last frame";
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(frames.set_velocity(0, 0.75, {nan, 0, 0}).error().code, ErrorCode::not_finite);
  EXPECT_TRUE(frames.set_velocity(0, 1.0, {0, 7, 0}));
  EXPECT_EQ(frames.state(0, 1.0), (State{{1, 0, 3}, {0, 7, 0}}));
  frames.push(std::vector<Vec3>{{1, 7, 3}, {5, 5, 5}}).value();
  EXPECT_EQ(frames.state(0, 1.5), (State{{1, 3.5, 3}, {0, 7, 0}}));
}

TEST(Frames, PromiseTheJumpsOfTheChord) {
  const FrameMotion frames =
      FrameMotion::create(
          {.start = {{}, {}}, .acceleration_limits = {8.0, 2.0}, .interval = 0.5, .position_error = 0.125})
          .value();
  const BodyDefinition promise = frames.definition(1, 0.0);
  EXPECT_EQ(promise.acceleration_limit, 2.0);
  EXPECT_EQ(promise.velocity_error, 1.0 + 0.5);
  EXPECT_EQ(promise.position_error, 0.125);
}

TEST(Frames, PromiseStraightMotionWithoutALimit) {
  FrameMotion frames = FrameMotion::create({.start = {{}}, .interval = 0.5, .position_error = 0.125}).value();
  EXPECT_EQ(frames.add(0.0, {}).value(), 1u);
  for (std::uint32_t body = 0; body < 2; ++body) {
    const BodyDefinition promise = frames.definition(body, 0.0);
    EXPECT_EQ(promise.acceleration_limit, 0.0);
    EXPECT_EQ(promise.velocity_error, 0.0);
    EXPECT_EQ(promise.position_error, 0.125);
  }
}

TEST(Frames, RefuseQuestionsThatTheyCannotAnswer) {
  FrameMotion frames =
      FrameMotion::create({.start = {{}, {}}, .acceleration_limits = {8, 8}, .interval = 1.0}).value();
  frames.push(std::vector<Vec3>{{1, 0, 0}, {}}).value();
  frames.push(std::vector<Vec3>{{2, 0, 0}, {}}).value();
  const auto code = [&](std::uint32_t body, double time) {
    try {
      (void)frames.state(body, time);
    } catch (const BadResult& refused) {
      return refused.error().code;
    }
    return ErrorCode::diverged;
  };
  EXPECT_EQ(code(0, 1.5), ErrorCode::diverged) << "answered";
  EXPECT_EQ(code(0, 0.5), ErrorCode::time_backwards);
  EXPECT_EQ(code(0, std::nextafter(2.0, 3.0)), ErrorCode::out_of_range);
  EXPECT_EQ(code(2, 1.5), ErrorCode::unknown_body);
  EXPECT_EQ(code(0, std::numeric_limits<double>::quiet_NaN()), ErrorCode::not_finite);
  EXPECT_EQ(frames.set_velocity(1'000'000, 1.5, {}).error().code, ErrorCode::unknown_body);
  EXPECT_THROW((void)frames.definition(2, 1.5), BadResult);
  EXPECT_THROW((void)frames.trajectory(2, 1.5, 2.0), BadResult);
  EXPECT_THROW((void)frames.trajectory(0, 1.5, 2.5), BadResult);
  EXPECT_THROW((void)frames.trajectory(0, 1.75, 1.5), BadResult);
}

/// A body that the world has and the frames do not: a bullet.
TEST(Frames, ProbeTellsOfABodyThatTheyDoNotHave) {
  FrameMotion frames =
      FrameMotion::create({.start = {{0, 0, 0}, {3, 0, 0}}, .acceleration_limits = {1, 1}}).value();
  World world = World::create({}).value();
  for (std::uint32_t body = 0; body < 2; ++body) world.add(frames.definition(body, 0.0)).value();
  const BodyId bullet =
      world.add({.radius = 0.1, .acceleration_limit = 5000, .position = {0, 2, 0}, .velocity = {0, 50, 0}})
          .value();
  const std::vector<Vec3> position = frames.latest();
  try {
    for (int k = 0; k < 100; ++k) {
      frames.push(position).value();
      (void)world.advance(frames.latest_time(), frames.probe());
    }
    FAIL() << "a body was made up";
  } catch (const BadResult& refused) {
    EXPECT_EQ(refused.error().code, ErrorCode::unknown_body);
    EXPECT_EQ(refused.error().body, bullet);
  }
}

TEST(Frames, TrajectoryAndClone) {
  Random random(1);
  FrameMotion frames =
      FrameMotion::create({.start = {{1, 2, 3}}, .acceleration_limits = {1e4}, .interval = 0.1}).value();
  for (int k = 0; k < 20; ++k) {
    frames.push(std::vector<Vec3>{random.point_in_ball()}).value();
    const double begin = random.uniform(frames.previous_time(), frames.latest_time());
    const double end = random.uniform(begin, frames.latest_time());
    ASSERT_EQ(frames.trajectory(0, begin, end).size(), 1u);
    expect_trajectory_gives_states(frames, 0, begin, end, random);
  }
  const auto clone = frames.clone();
  const double now = frames.latest_time();
  const State before = frames.state(0, now);
  frames.push(std::vector<Vec3>{{9, 9, 9}}).value();
  EXPECT_EQ(clone->state(0, now), before);
}

/// The positions that a game computes for one body, frame by frame.
using Game = std::vector<Vec3>;

/// Returns a body with a true motion of bounded acceleration, sampled once a frame.
Game sampled(const Motion& motion, double interval, int frames) {
  Game game;
  for (int k = 0; k < frames; ++k) game.push_back(motion.state(0, k * interval).position);
  return game;
}

/// Integrates x += dt v; v += dt a, with accelerations of full length, at first all in one direction: the
/// worst case.
Game stepped(Random& random, double limit, double interval, int frames) {
  Game game{{}};
  Vec3 velocity = 10 * random.point_in_ball();
  const Vec3 direction = random.unit_vector();
  for (int k = 1; k < frames; ++k) {
    velocity += interval * limit * (k < frames / 2 ? direction : random.unit_vector());
    game.push_back(game.back() + interval * velocity);
  }
  return game;
}

/// Pushes the whole game and compares states at random times with the limits at earlier random times. Returns
/// the largest used part of the limits.
double expect_promise_across_frames(const Game& game, double limit, double interval, double position_error,
                                    Random& random) {
  FrameMotion frames = FrameMotion::create({.start = {game[0]},
                                            .velocities = {(game[1] - game[0]) / interval},
                                            .acceleration_limits = {limit},
                                            .interval = interval,
                                            .position_error = position_error})
                           .value();
  struct Report {
    double time;
    BodyDefinition promise;
  };
  std::vector<Report> reports;
  double largest_part = 0.0;
  for (std::size_t k = 1; k < game.size(); ++k) {
    frames.push(std::vector<Vec3>{game[k]}).value();
    for (int i = 0; i < 3; ++i) {
      const double t = random.uniform(frames.previous_time(), frames.latest_time());
      const State now = frames.state(0, t);
      for (const Report& report : reports) {
        const double s = t - report.time;
        if (s <= 0) continue;
        const BodyDefinition& promise = report.promise;
        const double growth = promise.velocity_error * s + 0.5 * promise.acceleration_limit * s * s;
        const double off = norm(now.position - (promise.position + promise.velocity * s));
        EXPECT_LE(off, 2 * promise.position_error + growth + 1e-11);
        largest_part = std::max(largest_part, off / growth);
      }
      reports.push_back({t, frames.definition(0, t)});
    }
    reports.push_back({frames.previous_time(), frames.definition(0, frames.previous_time())});
    reports.push_back({frames.latest_time(), frames.definition(0, frames.latest_time())});
  }
  return largest_part;
}

TEST(Frames, KeepTheirPromiseAcrossFrames) {
  double largest_part = 0.0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const double limit = random.uniform(0.1, 20);
    const double interval = random.uniform(0.01, 0.5);
    const RandomForces truth = RandomForces::create({.start = random_states(random, 1, 100, 30),
                                                     .acceleration_limits = {limit},
                                                     .interval = random.uniform(0.5, 20) * interval,
                                                     .seed = seed})
                                   .value();
    expect_promise_across_frames(sampled(truth, interval, 60), limit, interval, 0.0, random);
    const double part =
        expect_promise_across_frames(stepped(random, limit, interval, 60), limit, interval, 0.0, random);
    largest_part = std::max(largest_part, part);
  }
  EXPECT_GT(largest_part, 0.9);  // the limits are tight: the worst case comes near them
}

TEST(Frames, KeepTheirPromiseWithSinglePrecision) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Game game = stepped(random, 0.01, 1.0 / 60, 60);
    for (Vec3& position : game) {
      for (int axis = 0; axis < 3; ++axis)
        position[axis] = static_cast<float>(position[axis] + 1000.0) - 1000.0;
    }
    const double half_unit = std::sqrt(3.0) * 0x1p-15;  // unit of numbers from 512 to 1024, on every axis
    expect_promise_across_frames(game, 0.01, 1.0 / 60, half_unit, random);
  }
}

TEST(Frames, NameWhatIsWrongAndStayAsTheyWere) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  FrameMotion frames = FrameMotion::create({.start = {{}, {}}, .acceleration_limits = {1.0, 1.0}}).value();
  const auto too_few = frames.push(std::vector<Vec3>{{1, 1, 1}});
  ASSERT_FALSE(too_few);
  EXPECT_EQ(too_few.error().message, "push: positions must have one entry per body, 2, but is 1");
  const auto not_finite = frames.push(std::vector<Vec3>{{1, 1, 1}, {1, nan, 1}});
  ASSERT_FALSE(not_finite);
  EXPECT_EQ(not_finite.error().code, ErrorCode::not_finite);
  EXPECT_EQ(not_finite.error().body, (BodyId{1, 0}));
  EXPECT_EQ(frames.latest_time(), 0.0);
  EXPECT_EQ(FrameMotion::create({.start = {}, .acceleration_limits = {}, .interval = 0.0}).error().argument,
            "interval");
  EXPECT_EQ(
      FrameMotion::create({.start = {}, .acceleration_limits = {}, .position_error = -1.0}).error().argument,
      "position_error");
  EXPECT_EQ(FrameMotion::create({.start = {{0, 0, nan}}, .acceleration_limits = {1.0}}).error().argument,
            "start");
}

/// A game that changes velocities within its frames, and continues from the resulting position and velocity.
TEST(Frames, KeepTheirPromiseAfterKicks) {
  constexpr double limit = 3.0, interval = 0.1;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Vec3 position, velocity = 5 * random.point_in_ball();
    FrameMotion frames = FrameMotion::create({.start = {position},
                                              .velocities = {velocity},
                                              .acceleration_limits = {limit},
                                              .interval = interval})
                             .value();
    BodyDefinition promise = frames.definition(0, 0.0);
    double since = 0.0;
    const Vec3 push = random.unit_vector();
    for (int k = 0; k < 200; ++k) {
      velocity += limit * interval * (k % 7 == 0 ? random.unit_vector() : push);
      position = frames.latest()[0] + interval * velocity;
      frames.push({&position, 1}).value();
      for (int i = 0; i < 3; ++i) {
        const double now = random.uniform(std::max(since, frames.previous_time()), frames.latest_time());
        const double s = now - since;
        const double growth = promise.velocity_error * s + 0.5 * promise.acceleration_limit * s * s;
        const Vec3 predicted = promise.position + promise.velocity * s;
        ASSERT_LE(norm(frames.state(0, now).position - predicted), growth + 1e-11);
        if (random.uniform() > 0.1) continue;
        velocity = 5 * random.point_in_ball();
        ASSERT_TRUE(frames.set_velocity(0, now, velocity));
        promise = frames.definition(0, now);
        since = now;
      }
    }
  }
}

TEST(Frames, TakesAChangeBackToTheLastBit) {
  FrameMotion frames = FrameMotion::create({.start = {{0.1, 0, 0}, {5, 5, 5}},
                                            .acceleration_limits = {1e6, 1e6},
                                            .interval = 1.0 / 60,
                                            .start_time = 0.3})
                           .value();
  frames.push(std::vector<Vec3>{{0.37, 0.1, -0.7}, {5, 5, 6}}).value();
  const auto before = frames;
  const double time = 0.5 * (frames.previous_time() + frames.latest_time());
  const MotionOrigin origin = frames.origin(0);
  EXPECT_EQ(origin.time, frames.previous_time());
  frames.set_velocity(0, time, {1, 2, 3}).value();
  EXPECT_NE(frames.latest(), before.latest());
  frames.set_origin(0, origin).value();
  EXPECT_EQ(frames.latest(), before.latest());
  EXPECT_EQ(frames.state(0, time), before.state(0, time));

  expect_error(frames.set_origin(0, {0.0, {}}), ErrorCode::time_backwards, "origin",
               "FrameMotion::set_origin:", BodyId{0, 0});
  expect_error(frames.set_origin(0, {1.0, {}}), ErrorCode::out_of_range, "origin",
               "FrameMotion::set_origin:", BodyId{0, 0});
  frames.remove(0).value();
  EXPECT_EQ(frames.set_origin(0, origin).error().code, ErrorCode::stale_body);
}

}  // namespace
}  // namespace kinesphere::frame_motion_test
