// What a core finds, compared with brute force and with the truth; and its invariants, checked by brute
// force.
#include "core/core.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "core/bouncing_balls.hpp"
#include "support/test_size.hpp"

namespace kinesphere::core_test {
namespace {

constexpr std::uint64_t seed = 6801;

WorldDefinition with_walls() { return {.box = Box{{0, 0, 0}, {10, 10, 10}}, .contact_tolerance = 1e-6}; }
WorldDefinition periodic() {
  WorldDefinition definition = with_walls();
  definition.periodic = {true, true, true};
  return definition;
}
WorldDefinition unbounded() { return {.contact_tolerance = 1e-6}; }
WorldDefinition flat() {
  WorldDefinition definition = with_walls();
  definition.dimensions = 2;
  return definition;
}

/// The first impact of balls that move straight on, of all pairs in all images, and of all balls and walls.
Bounce first_impact(const WorldDefinition& definition, const std::vector<TrueBall>& balls, double now) {
  Bounce first{std::numeric_limits<double>::infinity(), 0, 0, Wall::none, 0.0};
  const auto consider = [&](double time, std::uint32_t a, std::uint32_t b, Wall wall) {
    if (time < first.time) first = {time, a, b, wall, 0.0};
  };
  const Vec3 period = definition.periodic[0] ? definition.box->upper - definition.box->lower : Vec3{};
  const int images = definition.periodic[0] ? 1 : 0;
  for (std::uint32_t a = 0; a < balls.size(); ++a) {
    for (int axis = 0; axis < definition.dimensions && definition.box && images == 0; ++axis)
      for (const bool upper : {false, true}) {
        const double v = balls[a].state.velocity[axis], x = balls[a].state.position[axis];
        if (upper ? v <= 0.0 : v >= 0.0) continue;
        const double face = upper ? definition.box->upper[axis] - balls[a].radius
                                  : definition.box->lower[axis] + balls[a].radius;
        consider(now + (face - x) / v, a, core::none, static_cast<Wall>(1 + 2 * axis + (upper ? 1 : 0)));
      }
    for (std::uint32_t b = a + 1; b < balls.size(); ++b) {
      const Vec3 v = balls[b].state.velocity - balls[a].state.velocity;
      for (int k = 0; k < (images ? 27 : 1); ++k) {
        const Vec3 shift =
            images ? Vec3{(k % 3 - 1) * period.x, (k / 3 % 3 - 1) * period.y, (k / 9 - 1) * period.z}
                   : Vec3{};
        const Vec3 d = balls[b].state.position - balls[a].state.position + shift;
        const double radii = balls[a].radius + balls[b].radius, dv = dot(d, v), vv = norm_squared(v);
        const double root = dv * dv - vv * (norm_squared(d) - radii * radii);
        if (dv < 0.0 && root >= 0.0)
          consider(now + (norm_squared(d) - radii * radii) / (std::sqrt(root) - dv), a, b, Wall::none);
      }
    }
  }
  return first;
}

/// In this time no two balls of the tests go as far as a period towards each other.
constexpr double longest_step = 0.25;

/// Event-driven simulation by first_impact().
std::vector<Bounce> by_brute_force(const WorldDefinition& definition, std::vector<TrueBall> balls,
                                   double until) {
  std::vector<Bounce> bounces;
  double now = 0.0;
  for (;;) {
    Bounce next = first_impact(definition, balls, now);
    // Images farther away may come near later.
    const bool is_near = next.time <= now + longest_step;
    if (!is_near) next.time = now + longest_step;
    if (next.time > until) return bounces;
    for (TrueBall& ball : balls) {
      ball.state.position += ball.state.velocity * (next.time - now);
      for (int axis = 0; axis < 3 && definition.periodic[0]; ++axis) {
        const double period = definition.box->upper[axis];
        ball.state.position[axis] -= period * std::floor(ball.state.position[axis] / period);
      }
    }
    now = next.time;
    if (!is_near) continue;
    bounces.push_back(next);
    TrueBall& first = balls[next.first];
    if (next.wall != Wall::none) {
      const int axis = (static_cast<int>(next.wall) - 1) / 2;
      first.state.velocity[axis] = -first.state.velocity[axis];
      continue;
    }
    TrueBall& second = balls[next.second];
    Vec3 offset = second.state.position - first.state.position;
    for (int axis = 0; axis < 3 && definition.periodic[0]; ++axis)
      offset[axis] -= definition.box->upper[axis] * std::round(offset[axis] / definition.box->upper[axis]);
    bounce_off(first.state.velocity, second.state.velocity, first.mass, second.mass, offset / norm(offset));
  }
}

/// Plays balls that move straight on under a core and by brute force: the same bounces at the same times.
void expect_as_by_brute_force(const WorldDefinition& definition, const Crowd& crowd, double until,
                              std::size_t least) {
  SCOPED_TRACE(testing::Message() << "seed " << seed << ", " << crowd.count << " balls");
  const std::vector<TrueBall> balls = random_balls(crowd, definition, seed);
  const std::vector<Bounce> expected = by_brute_force(definition, balls, until);
  BouncingBalls run(definition, {balls, seed});
  const double energy = run.energy();
  run.play(until);
  ASSERT_EQ(run.audit(), nullptr);
  ASSERT_GE(expected.size(), least);
  ASSERT_EQ(run.bounces.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) {
    ASSERT_TRUE(run.bounces[k].is_of(expected[k])) << "bounce " << k << " at " << expected[k].time;
    ASSERT_NEAR(run.bounces[k].time, expected[k].time, 1e-3) << "bounce " << k;
    EXPECT_NEAR(run.bounces[k].gap, 0.0, definition.contact_tolerance);
  }
  EXPECT_NEAR(run.energy(), energy, 1e-12 * energy);
}

TEST(Core, FindsTheImpactsThatBruteForceFinds) {
  expect_as_by_brute_force(with_walls(), {.count = 30}, 8.0, 45);
  expect_as_by_brute_force(periodic(), {.count = 40}, 12.0, 25);
  expect_as_by_brute_force(flat(), {.count = 30}, 4.0, 55);
  expect_as_by_brute_force(with_walls(), {.count = 24, .least_radius = 0.002, .largest_radius = 2.0}, 12.0,
                           40);
}

TEST(Balls, AreDueNoLaterThanTheyMayLeaveTheirSafeRegions) {
  core::Balls balls(core::Periods{}, 0.0);
  balls.grow(1);
  balls[0].set(core::Ball::present, true);
  balls[0].due = 0.5;
  balls[0].second = balls[0].own = 1.0;
  EXPECT_TRUE(balls.is_valid(0));
  balls[0].second = 2.0;
  EXPECT_FALSE(balls.is_valid(0));
}

TEST(Core, FindsTheImpactsOfADenseGas) {
  expect_as_by_brute_force(periodic(), {.count = 300, .least_radius = 0.5, .largest_radius = 0.5}, 0.5, 100);
}

/// Everything that a ball promises, in all spaces.
struct Case {
  const char* name;
  WorldDefinition definition;
  Crowd crowd;
};

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const auto& [name, definition] : {std::pair("walls", with_walls()), std::pair("periodic", periodic()),
                                         std::pair("unbounded", unbounded()), std::pair("flat", flat())}) {
    cases.push_back({name, definition, {.acceleration = 4.0}});
    cases.push_back({name, definition, {.speed = 3.0, .acceleration = 1.0, .plan = 5.0}});
    cases.push_back(
        {name, definition, {.count = 25, .least_radius = 0.002, .largest_radius = 1.5, .acceleration = 2.0}});
    cases.push_back(
        {name, definition, {.acceleration = 1.0, .position_error = 1e-7, .velocity_error = 1e-3}});
    cases.push_back({name, definition, {.count = 2, .speed = 5.0, .acceleration = 100.0}});
  }
  return cases;
}

/// No two balls ever overlap by more than the tolerance without an answer, and each bounce is at a contact.
TEST(Core, MissesNoContactOfBallsThatKeepTheirLimits) {
  for (const Case& scene : all_cases()) {
    for (std::uint64_t round = 0; round < rounds_of(4u); ++round) {
      SCOPED_TRACE(testing::Message() << scene.name << ", seed " << seed + round << ", " << scene.crowd.count
                                      << " balls, acceleration " << scene.crowd.acceleration << ", plan "
                                      << scene.crowd.plan << ", error " << scene.crowd.velocity_error);
      BouncingBalls run(scene.definition,
                        {random_balls(scene.crowd, scene.definition, seed + round), seed + round});
      const double slack = scene.definition.contact_tolerance + 4.0 * scene.crowd.position_error;
      for (int step = 1; step <= 200; ++step) {
        run.play(0.01 * step);
        ASSERT_GE(run.least_gap(), -slack) << "at " << run.core().time();
        if (step % 20 == 0) {
          ASSERT_STREQ(run.audit(), nullptr) << "at " << run.core().time();
        }
      }
      for (const Bounce& bounce : run.bounces) ASSERT_LE(std::abs(bounce.gap), slack) << "at " << bounce.time;
    }
  }
}

/// Balls come, go and change while the others move.
TEST(Core, KeepsItsInvariantsWhenBallsComeAndGo) {
  for (const WorldDefinition& definition : {with_walls(), periodic(), unbounded(), flat()}) {
    const Crowd crowd{.count = 60, .least_radius = 0.05, .largest_radius = 0.5, .acceleration = 1.0};
    BouncingBalls run(definition, {random_balls(crowd, definition, seed), seed});
    Random random(seed);
    for (int step = 0; step < 300; ++step) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", step " << step);
      run.play(0.01 * step);
      const auto number = static_cast<std::uint32_t>(random.bits() % crowd.count);
      TrueBall& ball = run.truth.balls[number];
      const double now = run.core().time();
      const auto is_free = [&](const Vec3& place) {
        for (std::uint32_t k = 0; k < crowd.count; ++k) {
          if (k == number || !run.truth.balls[k].present) continue;
          Vec3 way = run.truth.at(k, now).position - place;
          for (int axis = 0; axis < 3 && definition.periodic[0]; ++axis)
            way[axis] -= 10.0 * std::round(way[axis] / 10.0);
          if (norm(way) < ball.radius + run.truth.balls[k].radius + 1e-3) return false;
        }
        return true;
      };
      Vec3 place{random.uniform(1.0, 9.0), random.uniform(1.0, 9.0), random.uniform(1.0, 9.0)};
      if (definition.dimensions == 2) place.z = 0.0;
      if (ball.present && random.bits() % 2 == 0) {
        run.leave(number);
      } else if (is_free(place)) {
        ball.state.position = place;
        ball.time = now;
        if (ball.present)
          run.move(number);
        else
          run.enter(number);
      }
      ASSERT_STREQ(run.audit(), nullptr);
      ASSERT_GE(run.least_gap(), -definition.contact_tolerance);
    }
  }
}

/// All balls, or two of three, get other velocities together, as often as a game has frames.
TEST(Core, KeepsItsInvariantsWhenManyBallsTurnTogether) {
  for (const double acceleration : {0.0, 1.0})
    for (const WorldDefinition& definition : {with_walls(), periodic(), unbounded(), flat()}) {
      const Crowd crowd{
          .count = 200, .least_radius = 0.05, .largest_radius = 0.4, .acceleration = acceleration};
      BouncingBalls run(definition, {random_balls(crowd, definition, seed), seed});
      Random random(seed);
      for (int step = 0; step < 60; ++step) {
        SCOPED_TRACE(testing::Message() << "seed " << seed << ", step " << step);
        run.play(step / 60.0);
        for (std::uint32_t number = 0; number < crowd.count; ++number) {
          Vec3 velocity = 4.0 * random.point_in_ball();
          if (definition.dimensions == 2) velocity.z = 0.0;
          if (step % 2 == 0 || number % 3 > 0) run.turn(number, velocity);
        }
        ASSERT_STREQ(run.audit(), nullptr);
        ASSERT_GE(run.least_gap(), -definition.contact_tolerance);
      }
      EXPECT_GT(run.bounces.size(), 10u);
    }
}

/// The same with several threads, to the last bit.
TEST(Core, SettlesManyBallsOnAnyNumberOfThreads) {
  for (const WorldDefinition& definition : {with_walls(), periodic()}) {
    const Crowd crowd{.count = 4000, .least_radius = 0.05, .largest_radius = 0.15};
    const std::vector<TrueBall> balls = random_balls(crowd, definition, seed);
    const auto play = [&](Workers* workers) {
      BouncingBalls run(definition, {balls, seed});
      run.workers = workers;
      Random random(seed);
      for (int step = 0; step < 6; ++step) {
        run.play(step / 60.0);
        for (std::uint32_t number = 0; number < crowd.count; ++number)
          run.turn(number, 4.0 * random.point_in_ball());
      }
      run.play(0.1);
      std::vector<std::tuple<double, double, std::uint32_t>> all{{double(run.bounces.size()), 0.0, 0}};
      for (const core::Ball& ball : run.core().balls().all())
        all.emplace_back(ball.due, ball.own, ball.about);
      return all;
    };
    const auto expected = play(nullptr);
    EXPECT_GT(std::get<0>(expected.front()), 100.0);
    for (const int threads : {1, 2, 3}) {
      Workers workers = Workers::create(threads).value();
      EXPECT_EQ(play(&workers), expected) << threads << " threads";
    }
  }
}

/// In a small box, regions are as wide as images permit, and all neighbours are met in several images.
TEST(Core, FindsImpactsOfBallsThatFillAPeriodicBox) {
  WorldDefinition definition = periodic();
  definition.box = Box{{0, 0, 0}, {3, 3, 3}};
  expect_as_by_brute_force(definition, {.count = 2, .least_radius = 0.5, .largest_radius = 0.55}, 20.0, 4);
  const Crowd crowd{
      .count = 3, .least_radius = 0.3, .largest_radius = 0.5, .speed = 2.0, .acceleration = 2.0};
  BouncingBalls run(definition, {random_balls(crowd, definition, seed), seed});
  for (int step = 1; step <= 2000; ++step) {
    run.play(0.005 * step);
    ASSERT_GE(run.least_gap(), -definition.contact_tolerance) << "at " << run.core().time();
    if (step % 100 == 0) {
      ASSERT_STREQ(run.audit(), nullptr) << "at " << run.core().time();
    }
  }
  EXPECT_GT(run.bounces.size(), 5u);
}

/// It is exact as long as it falls, and comes far from where it reported.
TEST(Core, AsksABallThatFallsFromRest) {
  std::vector<TrueBall> balls(1);
  balls[0].radius = 0.5;
  balls[0].planned_acceleration = {0, 0, -1};
  BouncingBalls run(periodic(), {balls, seed});
  run.play(20.0);
  EXPECT_GT(run.core().balls()[0].time, 0.0);
}

TEST(Core, LosesNoDigitsInALongFlight) {
  std::vector<TrueBall> balls(1);
  balls[0].radius = 0.5;
  balls[0].state = {{1, 2, 3}, {0.75, 0.5, 0.25}};
  BouncingBalls run(periodic(), {balls, seed});
  run.play(1e4);
  EXPECT_GT(run.core().balls()[0].time, 0.0);
  // All numbers here are short in binary, so the flight is exact.
  const Vec3 way = run.core().balls().nearest(run.core().balls().position(0) - run.truth.at(0, 1e4).position);
  EXPECT_LT(norm(way), 1e-9);
}

/// Balls whose motion is known are asked where they meet alone.
TEST(Core, ProbesBallsWhoseMotionIsKnownAtContacts) {
  BouncingBalls run(with_walls(), {random_balls({.count = 100}, with_walls(), seed), seed});
  run.play(5.0);
  EXPECT_GT(run.bounces.size(), 100u);
  EXPECT_LE(run.probes, 2 * run.bounces.size());
}

/// A ball far from all others costs little, however long time goes on.
TEST(Core, LetsLonelyBallsAlone) {
  std::vector<TrueBall> balls(2);
  balls[0].state = {{0, 0, 0}, {1, 0, 0}};
  balls[1].state = {{0, 1e4, 0}, {1, 0, 0}};
  BouncingBalls run(unbounded(), {balls, seed});
  run.play(1e4);
  EXPECT_LT(run.work.starts, 200u);
  balls[0].state.velocity = balls[1].state.velocity = {};
  BouncingBalls standing(unbounded(), {balls, seed});
  standing.play(1e9);
  EXPECT_EQ(standing.work.starts, 0u);
}

constexpr double never = std::numeric_limits<double>::infinity();

/// Of its balls nothing ever happens to any.
class QuietHost : public core::Host {
 public:
  explicit QuietHost(const WorldDefinition& definition) : core(definition) {}
  void settle(std::uint32_t number) { core.settle(std::span(&number, 1), *this, alone); }

  PoolLease alone;

  core::Core core;

 private:
  bool answers_threads() const override { return false; }
  void linked_with(std::uint32_t, std::vector<std::uint32_t>&) override {}
  std::size_t keep_partners(std::uint32_t, std::span<std::uint32_t> others) override { return others.size(); }
  double unchanged_until(std::uint32_t, std::uint32_t) override { return never; }
  Result<double> recheck(std::uint32_t, std::uint32_t) override { return never; }
  double walls_unchanged_until(std::uint32_t) override { return never; }
  Result<double> recheck_walls(std::uint32_t) override { return never; }
  Result<bool> report(std::span<const std::uint32_t>, Reason) override { return true; }
  void note_image(std::uint32_t, const Vec3&) override {}
  Counters& work_counters(std::uint32_t) override { return work_; }

  Counters work_;
};

/// Two balls that are neighbours, or that touch each other without being neighbours.
class TwoBalls final : public QuietHost {
 public:
  explicit TwoBalls(bool are_neighbours) : QuietHost(unbounded()), are_neighbours_(are_neighbours) {
    for (const std::uint32_t number : {0u, 1u}) {
      core.enter(number, {.position = {2.0625 * number, 0, 0}, .velocity = {1, 0, 0}, .radius = 1.0}, false,
                 false);
      core.set_kind(number, !are_neighbours, false, true);
    }
    core.settle(partners_, *this, alone);
  }

 private:
  void linked_with(std::uint32_t ball, std::vector<std::uint32_t>& linked) override {
    linked.push_back(partners_[ball]);
  }
  std::size_t keep_partners(std::uint32_t, std::span<std::uint32_t> others) override {
    return are_neighbours_ ? others.size() : 0;
  }

  std::array<std::uint32_t, 2> partners_{1, 0};
  bool are_neighbours_;
};

/// Otherwise both would look out for each other, or none.
TEST(Core, TakesABallThatHasChangedForTheLaterOne) {
  for (const bool are_neighbours : {true, false}) {
    TwoBalls balls(are_neighbours);
    for (const std::uint32_t number : {0u, 0u, 1u, 1u, 1u, 0u}) {
      balls.settle(number);
      const core::Core::Record changed = balls.core.record_of(number),
                               other = balls.core.record_of(1 - number);
      EXPECT_EQ(changed.neighbours.size(), are_neighbours ? 1u : 0u);
      EXPECT_GT(changed.change, other.change) << number << ", " << are_neighbours;
    }
  }
}

/// A ball near a wall that reports when it may reach it, and will not before its own time.
class BallAtAWall final : public QuietHost {
 public:
  BallAtAWall() : QuietHost(with_walls()) {
    core.enter(0, {.position = place_, .radius = 1.0, .acceleration_limit = 0.5}, false, true);
    core.set_kind(0, false, false, true);
    settle(0);
  }

  double looked_until = 0.0;

 private:
  Result<double> recheck_walls(std::uint32_t ball) override {
    looked_until = core.balls()[ball].own;
    core.report(ball, {.position = place_});
    return never;
  }

  Vec3 place_{1.25, 5, 5};
};

/// The report would let the ball stay in its safe region for longer.
TEST(Core, LooksNoFartherThanItsHostHasLooked) {
  BallAtAWall ball;
  const double due = ball.core.next_due(never);
  ASSERT_LT(due, never);
  ball.core.set_time(due);
  ASSERT_TRUE(ball.core.handle_next(ball));
  EXPECT_GT(ball.looked_until, due);
  EXPECT_EQ(ball.core.balls()[0].own, ball.looked_until);
}

/// Bounds that were read from bytes are refused if no safe region can be around them.
TEST(Core, HoldsNoBoundBeyondAllRegions) {
  for (const WorldDefinition& definition : {with_walls(), periodic(), unbounded(), flat()}) {
    const core::Core core(definition);
    EXPECT_TRUE(core.can_hold({.position = {1, 2, 3}, .velocity = {4, 5, 6}, .radius = 1.0}, 1e6));
    EXPECT_FALSE(core.can_hold({.position = {1, 2, 0x1p480}, .radius = 1.0}, 0.0));
    EXPECT_FALSE(core.can_hold({.velocity = {-1e100, 0, 0}, .radius = 1.0}, 1.0));
    EXPECT_FALSE(core.can_hold({.radius = 1.0, .acceleration_limit = 1e100}, 1.0));
  }
}

}  // namespace
}  // namespace kinesphere::core_test
