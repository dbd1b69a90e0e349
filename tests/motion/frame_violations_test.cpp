// Games that violate the limits of their frames: which body, when, and how to lose no contact.
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

FrameMotion frames_of(const BouncingGame& game, bool refuse = false) {
  return FrameMotion::create({.start = game.position,
                              .velocities = game.velocity,
                              .acceleration_limits = std::vector(game.balls, game.limit),
                              .interval = game.dt,
                              .refuse_violations = refuse})
      .value();
}

TEST(FrameViolations, NameEveryTurnAndNothingElse) {
  std::uint64_t turns = 0, reported = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    BouncingGame game(seed);
    FrameMotion frames = frames_of(game);
    std::vector<Vec3> before = game.position, last = game.position;
    for (std::uint32_t k = 0; k < game.balls; ++k) before[k] -= game.velocity[k] * game.dt;
    std::set<std::uint32_t> waiting;  // turned in the last frame, and not reported in it
    for (int frame = 1; frame <= 300; ++frame) {
      const std::set<std::uint32_t> turned = game.step();
      turns += turned.size();
      frames.push(game.position).value();
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

TEST(FrameViolations, CanBeRefused) {
  FrameMotion frames =
      FrameMotion::create(
          {.start = {{}, {}}, .acceleration_limits = {4.0, 4.0}, .interval = 0.5, .refuse_violations = true})
          .value();
  frames.push(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}}).value();
  const auto refused = frames.push(std::vector<Vec3>{{0, 0, 0}, {4, 0, 0}});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::out_of_range);
  EXPECT_EQ(refused.error().body, (BodyId{1, 0}));
  EXPECT_EQ(refused.error().message,
            "push: positions of body 1, acceleration, must be at most its limit 4, but is 8");
  EXPECT_EQ(frames.latest_time(), 0.5) << "as it was";
  frames.set_velocity(1, frames.latest_time(), {6, 0, 0}).value();
  frames.push(std::vector<Vec3>{{0, 0, 0}, {4, 0, 0}}).value();
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
Outcome watch(std::uint64_t seed, bool tell) {
  constexpr double tolerance = 1e-4, deep_enough = 0.01;
  BouncingGame game(seed);
  FrameMotion frames = frames_of(game);
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
    frames.push(game.position).value();
    if (tell) bodies.report_violations(world, frames).value();
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

TEST(FrameViolations, LoseNoContactWhenTheWorldIsToldOfThem) {
  std::uint64_t approaches = 0, lost_untold = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Outcome with_reports = watch(seed, true);
    EXPECT_EQ(with_reports.lost, 0u);
    EXPECT_EQ(with_reports.breaches, 0u);
    const Outcome without_reports = watch(seed, false);
    EXPECT_EQ(with_reports.approaches, without_reports.approaches);
    EXPECT_GT(without_reports.breaches, 0u);
    approaches += with_reports.approaches;
    lost_untold += without_reports.lost;
  }
  EXPECT_GT(approaches, 1000u);
  EXPECT_GT(lost_untold, 0u) << "otherwise this test shows nothing";
}

}  // namespace
}  // namespace kinesphere::frame_violations_test
