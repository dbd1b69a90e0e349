// The purpose of bounds: bodies with any motion within their limits stay inside their bounds and boxes, and
// meet or separate no earlier than certified.
#include <gtest/gtest.h>

#include "bound/bound_violation.hpp"
#include "support/bound_checks.hpp"

namespace kinesphere::bound_violation_test {
namespace {

constexpr std::uint64_t seed = 2718;
constexpr int pairs_per_habit = 1500;
constexpr int pieces = 12;
using WideVector = std::array<exact::Wide, 3>;

exact::Wide squared_distance(const WideVector& a, const WideVector& b) {
  exact::Wide sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) sum += (a[axis] - b[axis]) * (a[axis] - b[axis]);
  return sum;
}

/// A body with its true motion, in quadruple precision.
struct TrueBody {
  BodyDefinition promise;
  Bound bound;
  WideVector position, velocity;
  Vec3 acceleration;

  void move(exact::Wide time) {
    for (int k = 0; k < 3; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      position[axis] += (velocity[axis] + acceleration[k] * time / 2) * time;
      velocity[axis] += acceleration[k] * time;
    }
  }

  /// Precondition: `direction` has a length of at most 1; the factor exceeds the loss by rounding.
  void deviate(const Vec3& direction) {
    acceleration = promise.planned_acceleration + direction * (promise.acceleration_limit * (1.0 - 0x1p-40));
  }

  Vec3 rounded_position() const {
    return {static_cast<double>(position[0]), static_cast<double>(position[1]),
            static_cast<double>(position[2])};
  }
};

/// Returns a body with the largest report errors that its limits allow.
TrueBody draw_body(Random& random, bool exact_reports) {
  const double error = exact_reports ? 0.0 : 1.0 - 0x1p-40;
  TrueBody body;
  body.promise = {.radius = random.uniform(),
                  .acceleration_limit = chance(random, 0.2) ? 0.0 : 5.0 * random.uniform(),
                  .planned_acceleration = 3.0 * random.point_in_ball(),
                  .position_error = exact_reports ? 0.0 : 0.2 * random.uniform(),
                  .velocity_error = exact_reports ? 0.0 : 0.3 * random.uniform(),
                  .position = 4.0 * random.point_in_ball(),
                  .velocity = 3.0 * random.point_in_ball()};
  const Vec3 wrong_position = random.unit_vector() * (error * body.promise.position_error);
  const Vec3 wrong_velocity = random.unit_vector() * (error * body.promise.velocity_error);
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    body.position[axis] = exact::Wide(body.promise.position[k]) + wrong_position[k];
    body.velocity[axis] = exact::Wide(body.promise.velocity[k]) + wrong_velocity[k];
  }
  body.bound = bound_of(body.promise, {body.promise.position, body.promise.velocity}, 0.0);
  body.acceleration = body.promise.planned_acceleration;
  return body;
}

/// The deviation of a body from its plan during the next piece, relative to the direction to the other one.
struct Habit {
  const char* name;
  Vec3 (*direction)(Random&, const Vec3& towards);

  friend std::ostream& operator<<(std::ostream& out, const Habit& habit) { return out << habit.name; }
};

const std::vector<Habit> habits{
    {"erratic", [](Random& random, const Vec3&) { return random.point_in_ball(); }},
    {"always_full_power", [](Random& random, const Vec3&) { return random.unit_vector(); }},
    {"attacking", [](Random&, const Vec3& towards) { return towards; }},
    {"fleeing", [](Random&, const Vec3& towards) { return -towards; }},
};

testing::AssertionResult inside_bound(const TrueBody& body, exact::Wide time) {
  const exact::Course course(body.bound, 0.0);
  WideVector centre;
  for (std::size_t axis = 0; axis < 3; ++axis) centre[axis] = course.centre[axis].at(time);
  const exact::Wide margin = course.growth.at(time) + body.bound.radius - body.promise.radius;
  if (squared_distance(body.position, centre) <= margin * margin) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "outside of its bound at " << static_cast<double>(time);
}

testing::AssertionResult inside_box(const TrueBody& body, const Box& box) {
  for (int axis = 0; axis < 3; ++axis) {
    const exact::Wide x = body.position[static_cast<std::size_t>(axis)];
    if (x - body.promise.radius < box.lower[axis] || x + body.promise.radius > box.upper[axis])
      return testing::AssertionFailure() << "outside of its box on axis " << axis;
  }
  return testing::AssertionSuccess();
}

class Promise : public testing::TestWithParam<Habit> {
 protected:
  /// Moves both bodies through random pieces up to `end` and calls check(time) at random times.
  template <class Check>
  void live(Random& random, TrueBody& a, TrueBody& b, double end, Check check) {
    exact::Wide time = 0;
    for (int piece = 0; piece < pieces; ++piece) {
      const Vec3 between = b.rounded_position() - a.rounded_position();
      const Vec3 towards = between / std::max(norm(between) * (1.0 + 0x1p-48), 0x1p-100);
      a.deviate(GetParam().direction(random, towards));
      b.deviate(GetParam().direction(random, -towards));
      const double longest = 2.0 * end / pieces;
      for (int sample = 0; sample < 3; ++sample) {
        const exact::Wide step = exact::min(longest / 3 * random.uniform(), end - time);
        a.move(step);
        b.move(step);
        time += step;
        check(time);
        if (HasFatalFailure()) return;
      }
    }
  }
};

TEST_P(Promise, keeps_bodies_inside_their_bounds_and_boxes) {
  for (std::uint64_t k = 0; k < pairs_per_habit; ++k) {
    Random random = Random::at(seed, k, 0);
    TrueBody a = draw_body(random, false);
    TrueBody b = draw_body(random, false);
    const Box box_a = swept_box(a.bound, 0.0, 2.0);
    const Box box_b = swept_box(b.bound, 0.0, 2.0);
    live(random, a, b, 2.0, [&](exact::Wide time) {
      ASSERT_TRUE(inside_bound(a, time)) << "seed " << seed << ", case " << k;
      ASSERT_TRUE(inside_bound(b, time)) << "seed " << seed << ", case " << k;
      ASSERT_TRUE(inside_box(a, box_a)) << "seed " << seed << ", case " << k;
      ASSERT_TRUE(inside_box(b, box_b)) << "seed " << seed << ", case " << k;
    });
    if (HasFatalFailure()) return;
  }
}

TEST_P(Promise, keeps_pairs_apart_before_their_earliest_meeting) {
  int alive = 0;
  for (std::uint64_t k = 0; k < pairs_per_habit; ++k) {
    Random random = Random::at(seed, k, 1);
    TrueBody a = draw_body(random, false);
    TrueBody b = draw_body(random, false);
    const double distance = chance(random, 0.5) ? 0.0 : 0.5 * random.uniform();
    const double until = std::min(2.0, earliest_meeting(a.bound, b.bound, 0.0, 2.0, distance));
    const exact::Wide reach = exact::Wide(a.promise.radius) + b.promise.radius + distance;
    live(random, a, b, until, [&](exact::Wide time) {
      if (until == 0.0) return;
      ++alive;
      ASSERT_TRUE(squared_distance(a.position, b.position) >= reach * reach)
          << "too close at " << static_cast<double>(time) << " before " << until << ", seed " << seed
          << ", case " << k;
    });
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(alive, 10 * pairs_per_habit);
}

TEST_P(Promise, keeps_pairs_together_before_their_earliest_separation) {
  int alive = 0;
  for (std::uint64_t k = 0; k < pairs_per_habit; ++k) {
    Random random = Random::at(seed, k, 2);
    TrueBody a = draw_body(random, true);
    TrueBody b = draw_body(random, true);
    const double distance = gap_limits(a.bound, b.bound, 0.0).upper + random.uniform();
    const double until = std::min(2.0, earliest_separation(a.bound, b.bound, 0.0, 2.0, distance));
    const exact::Wide reach = exact::Wide(a.promise.radius) + b.promise.radius + distance;
    live(random, a, b, until, [&](exact::Wide time) {
      if (until == 0.0) return;
      ++alive;
      ASSERT_TRUE(squared_distance(a.position, b.position) <= reach * reach)
          << "too far at " << static_cast<double>(time) << " before " << until << ", seed " << seed
          << ", case " << k;
    });
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(alive, 10 * pairs_per_habit);
}

INSTANTIATE_TEST_SUITE_P(Habits, Promise, testing::ValuesIn(habits),
                         [](const auto& habit) { return std::string(habit.param.name); });

/// The certificate is tight: bodies that attack each other on a line meet at its time.
TEST(PromiseOnALine, is_used_up_by_the_worst_behaviour) {
  for (std::uint64_t k = 0; k < 2000; ++k) {
    Random random = Random::at(seed, k, 3);
    TrueBody a = draw_body(random, true);
    TrueBody b = draw_body(random, true);
    for (TrueBody* body : {&a, &b}) {
      body->promise.acceleration_limit += 0.1;
      body->promise.position = {body == &a ? 0.0 : random.uniform(2.5, 9.0), 0.0, 0.0};
      body->promise.velocity = {random.uniform(-2.0, 2.0), 0.0, 0.0};
      body->promise.planned_acceleration = {random.uniform(-2.0, 2.0), 0.0, 0.0};
      body->bound = bound_of(body->promise, {body->promise.position, body->promise.velocity}, 0.0);
      body->position = {body->promise.position.x, 0, 0};
      body->velocity = {body->promise.velocity.x, 0, 0};
    }
    const double until = earliest_meeting(a.bound, b.bound, 0.0, 100.0);
    if (until == infinity) continue;
    a.deviate({1, 0, 0});
    b.deviate({-1, 0, 0});
    a.move(until);
    b.move(until);
    const double gap =
        static_cast<double>(b.position[0] - a.position[0]) - a.promise.radius - b.promise.radius;
    ASSERT_NEAR(gap, 0.0, 1e-8 * (1.0 + until * until)) << "seed " << seed << ", case " << k;
    ASSERT_GE(gap, 0.0) << "seed " << seed << ", case " << k;
  }
}

/// At the top of a throw the velocity that is left is the rounding of the two that cancel.
TEST(BoundViolations, AllowForTheRoundingOfAPlannedVelocity) {
  const Bound before{.velocity = {0, 0, 9.81}, .planned_acceleration = {0, 0, -9.81}};
  Bound after = before;
  after.time = 1.0;
  after.position = {0, 0, 4.905};
  after.velocity = {0, 0, 1e-14};
  EXPECT_FALSE(bound_violation(before, after, 0.0, {}, 1e-6));
  after.velocity = {0, 0, 1e-6};
  EXPECT_TRUE(bound_violation(before, after, 0.0, {}, 1e-6));
}

constexpr double eps = 1e-3;

/// The acceleration that a report at s = 0.5 proves of a body with these limits, at the origin at time 0.
double observed(const BodyDefinition& promise, const State& report, double s = 0.5) {
  return observed_acceleration(bound_of(promise, {promise.position, promise.velocity}, 0.0),
                               bound_of(promise, report, s), promise.radius, eps);
}

TEST(ObservedAcceleration, IsThatOfAConstantForceBeyondThePlan) {
  const auto falls = [](const BodyDefinition& promise, const Vec3& a, double s) {
    return observed(promise,
                    {promise.position + (promise.velocity + a * (0.5 * s)) * s, promise.velocity + a * s}, s);
  };
  for (const double s : {1.0 / 64.0, 1.0, 100.0}) {
    EXPECT_NEAR(falls({.radius = 1.0}, {0, 0, -9.8}, s), (1.0 + 0x1p-6) * 9.8, 1e-9);
    EXPECT_NEAR(falls({.radius = 1.0, .velocity = {3, 2, 1}}, {0, 0, -9.8}, s), (1.0 + 0x1p-6) * 9.8, 1e-9);
    EXPECT_NEAR(falls({.planned_acceleration = {0, 0, -9.0}}, {0, 0, -9.8}, s), (1.0 + 0x1p-6) * 0.8, 1e-9);
  }
}

TEST(ObservedAcceleration, IsNoneOfBodiesThatWereMovedOrOfNoise) {
  EXPECT_EQ(observed({}, {{10, 0, 0}, {}}), 0.0) << "moved without a velocity";
  EXPECT_EQ(observed({}, {{}, {10, 0, 0}}), 0.0) << "turned just now";
  EXPECT_EQ(observed({}, {{-0.1, 0, 0}, {0.1, 0, 0}}), 0.0) << "place and velocity contradict each other";
  EXPECT_EQ(observed({}, {{1, 0, 0}, {1, 0, 0}}, 0.0), 0.0) << "no time has passed";
  EXPECT_EQ(observed({.position_error = 0.01, .velocity_error = 0.1}, {{0.06, 0, 0}, {0.19, 0, 0}}), 0.0)
      << "within the errors";
  const BodyDefinition noisy{.position_error = 0.01, .velocity_error = 0.1};
  EXPECT_NEAR(observed(noisy, {{0.32, 0, 0}, {1.2, 0, 0}}), (1.0 + 0x1p-6) * 2.0, 1e-9);
}

/// The least of what place and velocity need, and a jump of the velocity takes a 16th of the tolerance at
/// least.
TEST(ObservedAcceleration, IsNotThatOfAJump) {
  EXPECT_NEAR(observed({}, {{0.1, 0, 0}, {10, 0, 0}}), (1.0 + 0x1p-6) * 0.8, 1e-9);
  EXPECT_NEAR(observed({}, {{100, 0, 0}, {1, 0, 0}}), (1.0 + 0x1p-6) * 2.0, 1e-9);
  const double s = 1e-12;
  EXPECT_NEAR(observed({}, {{1e-12, 0, 0}, {1e-3, 0, 0}}, s), (1.0 + 0x1p-6) * 8.0 * 1e-6 / eps, 1e-9);
}

}  // namespace
}  // namespace kinesphere::bound_violation_test
