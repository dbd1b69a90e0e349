// Games that violate the limits of their frames: which body, when, and that no contact is lost.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "kinesphere/body_map.hpp"
#include "kinesphere/motion/frame_motion.hpp"
#include "kinesphere/random.hpp"

namespace kinesphere::frame_violations_test {
namespace {

/// An integrator that bounces its balls off the walls of a room by itself, and lets them pass each other.
class BouncingGame {
 public:
  static constexpr double dt = 1.0 / 60, radius = 0.3, room = 10.0, gravity = 9.81, limit = 1.01 * gravity;
  static constexpr std::uint32_t balls = 40;

  explicit BouncingGame(std::uint64_t seed) {
    Random random(seed);
    for (std::uint32_t k = 0; k < balls; ++k) {
      const auto along = [&] { return random.uniform(radius, room - radius); };
      const double x = along(), y = along(), z = along();
      position.push_back({x, y, z});
      velocity.push_back(8.0 * random.point_in_ball());
    }
  }

  /// Returns the bodies that turned at a wall by more than their limits allow for in two frames.
  std::set<std::uint32_t> step() {
    std::set<std::uint32_t> turned;
    for (std::uint32_t k = 0; k < balls; ++k) {
      velocity[k].z -= gravity * dt;
      position[k] += velocity[k] * dt;
      for (int axis = 0; axis < 3; ++axis) {
        double& x = position[k][axis];
        const double wall = std::clamp(x, radius, room - radius);
        if (x == wall) continue;
        x = 2.0 * wall - x;
        velocity[k][axis] = -velocity[k][axis];
        if (2.0 * std::abs(velocity[k][axis]) > 2.0 * limit * dt) turned.insert(k);
      }
    }
    return turned;
  }

  std::vector<Vec3> position, velocity;
};

FrameMotion frames_of(const BouncingGame& game, double limit) {
  return FrameMotion::create({.start = game.position,
                              .velocities = game.velocity,
                              .acceleration_limits = std::vector(game.balls, limit),
                              .interval = game.dt})
      .value();
}

TEST(FrameViolations, NameEveryTurnAndNothingElse) {
  std::uint64_t turns = 0, reported = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    BouncingGame game(seed);
    FrameMotion frames = frames_of(game, game.limit);
    World world = World::create({}).value();
    BodyMap bodies;
    bodies.add_all(world, frames, {.radius = 0.0}).value();
    std::vector<Vec3> before = game.position, last = game.position;
    for (std::uint32_t k = 0; k < game.balls; ++k) before[k] -= game.velocity[k] * game.dt;
    std::set<std::uint32_t> waiting;  // turned in the last frame, and not reported in it
    for (int frame = 1; frame <= 300; ++frame) {
      const std::set<std::uint32_t> turned = game.step();
      turns += turned.size();
      bodies.push(world, frames, game.position).value();
      while (world.advance(frames.latest_time(), bodies.probe()).value()) {
      }
      std::map<std::uint32_t, FrameViolation> named;
      for (const FrameViolation& violation : frames.violations()) named.emplace(violation.body, violation);
      ASSERT_EQ(named.size(), frames.violations().size());
      for (std::uint32_t k = 0; k < game.balls; ++k) {
        const double deviation = norm(game.position[k] - 2.0 * last[k] + before[k]);
        const double allowed = game.limit * game.dt * game.dt;
        ASSERT_EQ(named.count(k) == 1, deviation > allowed) << "ball " << k << ", frame " << frame;
        if (deviation <= allowed) continue;
        EXPECT_NEAR(named.at(k).excess, deviation - allowed, 1e-12);
        EXPECT_NEAR(named.at(k).acceleration, deviation / (game.dt * game.dt), 1e-8);
        EXPECT_EQ(named.at(k).velocity, frames.state(k, frames.latest_time()).velocity);
      }
      for (const std::uint32_t k : waiting) EXPECT_EQ(named.count(k), 1u) << "ball " << k;
      waiting.clear();
      for (const std::uint32_t k : turned)
        if (named.count(k) == 0) waiting.insert(k);
      reported += named.size();
      before = std::exchange(last, game.position);
    }
    EXPECT_EQ(frames.violation_count(), reported);
    reported = 0;
  }
  EXPECT_GT(turns, 2000u);
}

TEST(FrameViolations, AreNoRoundingOfTheGame) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    // The limit to the last digit, far from the origin.
    Vec3 position = 1e6 * random.point_in_ball(), velocity = 10 * random.point_in_ball();
    const double limit = 9.81, dt = 1.0 / 60;
    FrameMotion frames =
        FrameMotion::create(
            {.start = {position}, .velocities = {velocity}, .acceleration_limits = {limit}, .interval = dt})
            .value();
    for (int k = 0; k < 1000; ++k) {
      velocity += Vec3{0, 0, -limit} * dt;
      position += velocity * dt;
      frames.push({&position, 1}).value();
      ASSERT_TRUE(frames.violations().empty()) << frames.violations()[0].excess;
    }
  }
}

/// When two balls that move in straight lines during a frame come into contact in it, and their depth.
struct Approach {
  double begin;
  double deepest;
};

std::optional<Approach> approach(const Vec3& from, const Vec3& way, double reach) {
  const double along = dot(from, way), speed = norm_squared(way);
  const double deepest_at = speed > 0 ? std::clamp(-along / speed, 0.0, 1.0) : 0.0;
  const double deepest = reach - norm(from + way * deepest_at);
  if (deepest <= 0) return std::nullopt;
  const double gap = norm_squared(from) - reach * reach;
  if (gap <= 0) return Approach{0.0, deepest};
  return Approach{(-along - std::sqrt(along * along - speed * gap)) / speed, deepest};
}

using Pair = std::pair<std::uint32_t, std::uint32_t>;

struct Outcome {
  std::uint64_t approaches = 0;
  std::uint64_t lost = 0;      ///< contacts without a begin event at their time
  std::uint64_t breaches = 0;  ///< bound_violation events
};

/// A world watches the game; an independent computation on its straight lines gives the expected reports.
Outcome watch(std::uint64_t seed, double limit) {
  constexpr double tolerance = 1e-4, deep_enough = 0.01;
  BouncingGame game(seed);
  FrameMotion frames = frames_of(game, limit);
  World world = World::create({.contact_tolerance = tolerance}).value();
  BodyMap bodies;
  bodies.add_all(world, frames, {.radius = game.radius}).value();

  Outcome outcome;
  std::map<Pair, std::vector<double>> begins_of;
  struct Touch {
    double begin, deepest;
  };
  std::map<Pair, Touch> touching;
  for (int frame = 1; frame <= 300; ++frame) {
    game.step();
    const std::vector<Vec3> before = frames.latest();
    bodies.push(world, frames, game.position).value();
    while (const auto event = world.advance(frames.latest_time(), bodies.probe()).value()) {
      if (event->kind == EventKind::bound_violation) ++outcome.breaches;
      if (event->kind == EventKind::contact_begin)
        begins_of[{event->first.index, event->second.index}].push_back(event->time);
    }
    for (std::uint32_t a = 0; a < game.balls; ++a)
      for (std::uint32_t b = a + 1; b < game.balls; ++b) {
        const Vec3 from = before[b] - before[a], to = game.position[b] - game.position[a];
        const auto met = approach(from, to - from, 2 * game.radius);
        const auto known = touching.find({a, b});
        if (met) {
          const double begin = frames.previous_time() + met->begin * game.dt;
          Touch& touch = touching.try_emplace({a, b}, Touch{begin, 0.0}).first->second;
          touch.deepest = std::max(touch.deepest, met->deepest);
        } else if (known != touching.end()) {
          const Touch touch = known->second;
          touching.erase(known);
          if (touch.deepest < deep_enough) continue;
          ++outcome.approaches;
          // Reported at a gap of at most the tolerance, never after the contact.
          const std::vector<double>& begins = begins_of[{a, b}];
          const bool in_time = std::any_of(begins.begin(), begins.end(), [&](double time) {
            return time <= touch.begin + 1e-9 && time > touch.begin - 0.1;
          });
          if (!in_time && touch.begin > 0.0) ++outcome.lost;
        }
      }
  }
  return outcome;
}

TEST(FrameViolations, LoseNoContact) {
  std::uint64_t approaches = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Outcome limited = watch(seed, BouncingGame::limit);
    EXPECT_EQ(limited.lost, 0u);
    EXPECT_EQ(limited.breaches, 0u);
    const Outcome unlimited = watch(seed, std::numeric_limits<double>::infinity());
    EXPECT_EQ(unlimited.lost, 0u);
    EXPECT_EQ(unlimited.breaches, 0u);
    EXPECT_EQ(limited.approaches, unlimited.approaches);
    approaches += limited.approaches;
  }
  EXPECT_GT(approaches, 1000u);
}

}  // namespace
}  // namespace kinesphere::frame_violations_test
