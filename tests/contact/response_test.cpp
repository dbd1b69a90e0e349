// The textbook bounce: momentum, energy, restitution.
#include <gtest/gtest.h>

#include "contact/contact_event.hpp"
#include "contact/contact_rule.hpp"
#include "kinesphere/random.hpp"
#include "kinesphere/response.hpp"
#include "number/infinity.hpp"

namespace kinesphere::response_test {
namespace {

TEST(Bounce, KeepsMomentumAndLosesWhatRestitutionSays) {
  Random random(4);
  for (int k = 0; k < 500; ++k) {
    const Vec3 normal = random.unit_vector();
    const Sphere a{{0, 0}, 0.5, {{}, 3.0 * random.point_in_ball() + normal}};
    const Sphere b{{1, 0}, 0.5, {normal, 3.0 * random.point_in_ball() - normal}};
    const double m = random.uniform(0.01, 10.0), n = random.uniform(0.01, 10.0);
    const double restitution = k % 3 == 0 ? 1.0 : k % 3 == 1 ? 0.0 : random.uniform();
    const Event event = contact_event(EventKind::contact_begin, 0.0, a, b);
    if (event.approach_speed <= 0.0) continue;
    const Bounce after = bounce(event, m, n, restitution);
    const Vec3 v = after.first_velocity, w = after.second_velocity;
    const Vec3 momentum = a.state.velocity * m + b.state.velocity * n;
    EXPECT_NEAR(norm(v * m + w * n - momentum), 0.0, 1e-12);
    EXPECT_NEAR(dot(event.normal, w - v), restitution * event.approach_speed, 1e-12);
    // Frictionless: nothing changes across the normal.
    const Vec3 change = v - a.state.velocity;
    EXPECT_NEAR(norm(change - event.normal * dot(event.normal, change)), 0.0, 1e-12);
    const auto energy = [&](const Vec3& x, const Vec3& y) {
      return m * norm_squared(x) + n * norm_squared(y);
    };
    const double reduced = m * n / (m + n);
    const double loss =
        (1 - restitution * restitution) * reduced * event.approach_speed * event.approach_speed;
    EXPECT_NEAR(energy(v, w), energy(a.state.velocity, b.state.velocity) - loss, 1e-10);
  }
}

TEST(Bounce, EqualMassesSwapAndAHeavyOneStays) {
  const Event event = contact_event(EventKind::contact_begin, 0.0, {{0, 0}, 1, {{}, {2, 0, 0}}},
                                    {{1, 0}, 1, {{2, 0, 0}, {}}});
  const Bounce swapped = bounce(event, 1.0, 1.0, 1.0);
  EXPECT_EQ(swapped.first_velocity, (Vec3{}));
  EXPECT_EQ(swapped.second_velocity, (Vec3{2, 0, 0}));
  const Bounce heavy = bounce(event, 1.0, 1e30, 1.0);
  EXPECT_NEAR(heavy.first_velocity.x, -2.0, 1e-12);
  EXPECT_NEAR(heavy.second_velocity.x, 0.0, 1e-12);
  const Bounce fixed = bounce(event, 1.0, infinity, 0.5);
  EXPECT_EQ(fixed.first_velocity.x, -1.0);
  EXPECT_EQ(fixed.second_velocity, (Vec3{}));
  const Bounce other_way = bounce(event, infinity, 1.0, 1.0);
  EXPECT_EQ(other_way.first_velocity.x, 2.0);
  EXPECT_EQ(other_way.second_velocity.x, 4.0);
}

TEST(Bounce, TakesTheMassesOfTheEventUnlessOthersAreGiven) {
  Event event = contact_event(EventKind::contact_begin, 0.0, {{0, 0}, 1, {{}, {2, 0, 0}}},
                              {{1, 0}, 1, {{2, 0, 0}, {}}});
  event.first_mass = 3.0;
  const Bounce own = bounce(event, 0.5);
  const Bounce told = bounce(event, 3.0, 1.0, 0.5);
  EXPECT_EQ(own.first_velocity, told.first_velocity);
  EXPECT_EQ(own.second_velocity, told.second_velocity);
  EXPECT_EQ(settle(event, 0.5, 0.1).first_velocity, settle(event, 3.0, 1.0, 0.5, 0.1).first_velocity);
  event.first_mass = event.second_mass = infinity;
  EXPECT_EQ(bounce(event, 1.0).first_velocity, (Vec3{2, 0, 0})) << "two of infinite mass";
  EXPECT_EQ(bounce(event, 1.0).second_velocity, Vec3());
}

TEST(Bounce, OffWhatStaysIsThatOfAnInfiniteMassWhateverIsGiven) {
  for (const bool asleep : {false, true}) {
    Event event = contact_event(EventKind::contact_begin, 0.0, {{0, 0}, 1, {{}, {2, 0, 0}}},
                                {{1, 0}, 1, {{2, 0, 0}, {}}});
    (asleep ? event.second_traits.is_sleeping : event.second_traits.is_static) = true;
    for (const double mass : {1.0, 0.0, infinity}) {
      EXPECT_EQ(bounce(event, mass, 1.0, 0.5).first_velocity, (Vec3{-1, 0, 0})) << mass;
      EXPECT_EQ(bounce(event, mass, 1.0, 0.5).second_velocity, Vec3()) << mass;
      EXPECT_EQ(settle(event, mass, 1.0, 0.5, 0.1).first_velocity, (Vec3{-1, 0, 0})) << mass;
    }
    const Response response = response_of(event, bounce(event, 0.5));
    EXPECT_EQ(response.first_velocity, (Vec3{-1, 0, 0}));
    EXPECT_FALSE(response.second_velocity);
    event.first_traits = event.second_traits;
    EXPECT_EQ(bounce(event, 1.0).first_velocity, (Vec3{2, 0, 0})) << "both stay";
  }
  const Event wall = wall_event(EventKind::wall_begin, 0.0, {{0, 0}, 1, {{9, 5, 5}, {3, 1, -2}}},
                                Box{{0, 0, 0}, {10, 10, 10}}, Wall::x_upper);
  EXPECT_EQ(wall.second_mass, infinity);
  EXPECT_EQ(response_of(wall, bounce(wall, 0.5)).first_velocity, (Vec3{-1.5, 1, -2}));
  EXPECT_FALSE(response_of(wall, bounce(wall, 0.5)).second_velocity);
}

TEST(Bounce, OfMassesThatAreNoneIsTheLimitOfSmallOnes) {
  const Event event = contact_event(EventKind::contact_begin, 0.0, {{0, 0}, 1, {{}, {2, 0, 0}}},
                                    {{1, 0}, 1, {{2, 0, 0}, {}}});
  for (const double none : {0.0, -0.0, -3.0, -infinity}) {
    const Bounce light = bounce(event, none, 1.0, 1.0);
    EXPECT_EQ(light.first_velocity, (Vec3{-2, 0, 0})) << none;
    EXPECT_EQ(light.second_velocity, Vec3()) << none;
    const Bounce both = bounce(event, none, none, 1.0);
    EXPECT_EQ(both.first_velocity, Vec3()) << none;
    EXPECT_EQ(both.second_velocity, (Vec3{2, 0, 0})) << none;
    const Bounce settled = settle(event, none, none, 0.5, 0.1);
    EXPECT_EQ(settled.first_velocity, (Vec3{0.5, 0, 0})) << none;
  }
  const Bounce huge = bounce(event, 1.5e308, 1e308, 1.0);
  EXPECT_NEAR(huge.first_velocity.x, 2.0 - 4.0 * 0.4, 1e-12);
  EXPECT_NEAR(huge.second_velocity.x, 4.0 * 0.6, 1e-12);
}

TEST(Bounce, OfTheLeastApproachIsFinite) {
  Event event = contact_event(EventKind::contact_begin, 0.0, {{0, 0}, 1, {{}, {0, 0, 0}}},
                              {{1, 0}, 1, {{2, 0, 0}, {}}});
  event.approach_speed = 5e-324;
  event.repeated = true;  // otherwise no speed is gained
  const Bounce after = settle(event, 1.0, 1.0, 0.5, 0.1);
  EXPECT_NEAR(after.second_velocity.x - after.first_velocity.x, 0.1, 1e-12);
}

TEST(Bounce, OfANaNIsNaN) {
  const Event event = contact_event(EventKind::contact_begin, 0.0, {{0, 0}, 1, {{}, {2, 0, 0}}},
                                    {{1, 0}, 1, {{2, 0, 0}, {}}});
  EXPECT_FALSE(is_finite(bounce(event, std::numeric_limits<double>::quiet_NaN(), 1.0, 1.0).first_velocity));
}

TEST(Bounce, OffAWallReflects) {
  const Event event = wall_event(EventKind::wall_begin, 0.0, {{0, 0}, 1, {{9, 5, 5}, {3, 1, -2}}},
                                 Box{{0, 0, 0}, {10, 10, 10}}, Wall::x_upper);
  EXPECT_EQ(bounce(event, 1.0, 0.0, 1.0).first_velocity, (Vec3{-3, 1, -2}));
  EXPECT_EQ(bounce(event, 1.0, 0.0, 0.5).first_velocity, (Vec3{-1.5, 1, -2}));
  EXPECT_EQ(bounce(event, 1.0, 0.0, 0.0).first_velocity, (Vec3{0, 1, -2}));
  EXPECT_EQ(bounce(event, 1.0, 0.0, 0.0).second_velocity, (Vec3{}));
}

TEST(Bounce, RepeatedContactLosesNothing) {
  Event event = contact_event(EventKind::contact_begin, 0.0, {{0, 0}, 1, {{}, {2, 0, 0}}},
                              {{1, 0}, 1, {{2, 0, 0}, {}}});
  event.repeated = true;
  const Bounce after = bounce(event, 1.0, 3.0, 0.0);
  EXPECT_NEAR(norm_squared(after.first_velocity) + 3.0 * norm_squared(after.second_velocity), 4.0, 1e-12);
}

Event head_on(double approach, bool repeated) {
  Event event = contact_event(EventKind::contact_begin, 0.0, {{0, 0}, 1, {{}, {approach, 0, 0}}},
                              {{1, 0}, 1, {{2, 0, 0}, {}}});
  event.repeated = repeated;
  return event;
}

double parting_speed(const Bounce& after) { return after.second_velocity.x - after.first_velocity.x; }

TEST(Settle, LosesEnergyUntilTheRestingSpeed) {
  for (const bool repeated : {false, true}) {
    const Event event = head_on(8.0, repeated);
    const Bounce fast = settle(event, 1.0, 3.0, 0.25, 0.5);
    EXPECT_NEAR(parting_speed(fast), 2.0, 1e-12) << "repeated or not";
    EXPECT_NEAR(fast.first_velocity.x + 3.0 * fast.second_velocity.x, 8.0, 1e-12) << "momentum";
    EXPECT_NEAR(parting_speed(settle(event, 1.0, 3.0, 0.0, 0.5)), 0.5, 1e-12) << "never a dead stop";
    const double slow = parting_speed(settle(head_on(0.125, repeated), 1.0, 1.0, 0.5, 0.5));
    EXPECT_NEAR(slow, repeated ? 0.5 : 0.125, 1e-12);
    EXPECT_NEAR(parting_speed(settle(head_on(0.125, repeated), 1.0, 1.0, 1.0, 0.5)), 0.125, 1e-12);
    EXPECT_EQ(parting_speed(settle(head_on(0.0, repeated), 1.0, 1.0, 0.5, 0.5)), 0.0);
  }
}

/// A body that falls from the outer edge of the tolerance to half of it inside arrives with this speed, and a
/// hop that begins with it ends within the Zeno interval.
TEST(Settle, LeastRestingSpeedFitsTheTolerance) {
  for (const double tolerance : {1e-6, 1e-3}) {
    const double speed = least_resting_speed(tolerance, 9.81);
    EXPECT_NEAR(speed * speed / (2.0 * 9.81), 1.5 * tolerance, 1e-12 * tolerance);
    const ContactRule rule({.contact_tolerance = tolerance});
    EXPECT_EQ(rule.guarded_gap(0.0), -0.5 * tolerance);
    EXPECT_LT(2.0 * speed / 9.81, rule.zeno_interval(9.81));
  }
  EXPECT_EQ(least_resting_speed(1e-3, 0.0), 0.0);
}

/// A response to every event, contact_end included, does not turn bodies back upon each other.
TEST(Bounce, LeavesBodiesThatDoNotApproachAlone) {
  for (const double approach : {0.0, -3.0}) {
    const Event event = head_on(approach, false);
    for (const Bounce& after : {bounce(event, 0.5), bounce(event, 1.0, 2.0, 1.0), settle(event, 0.5, 0.1)}) {
      EXPECT_EQ(after.first_velocity, event.first_state.velocity);
      EXPECT_EQ(after.second_velocity, event.second_state.velocity);
    }
  }
}

}  // namespace
}  // namespace kinesphere::response_test
