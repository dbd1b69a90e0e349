// How two tracks pass each other, against their distances at many moments.
#include "monitor/straight_pass.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kinesphere/random.hpp"

namespace kinesphere::straight_pass_test {
namespace {

constexpr std::uint64_t seed = 5204;
constexpr double now = 100.0;

State at(const State& state, double after) {
  return {state.position + state.velocity * after, state.velocity};
}

/// True if the two are within the separation when they go straight on for so long.
bool are_within(const State& first, const State& second, const Components& separation, double after) {
  const Vec3 offset = at(first, after).position - at(second, after).position;
  for (const Component& component : separation)
    if (norm(component.part(offset)) > component.limit) return false;
  return true;
}

TEST(StraightPass, BeginsAndEndsAsTheDistancesDo) {
  SCOPED_TRACE(seed);
  int passes = 0;
  for (std::uint64_t part = 0; part < 2000; ++part) {
    SCOPED_TRACE(part);
    Random random = Random::at(seed, part, 0);
    const Components separation(part % 2 == 0 ? Separation::sphere(2.0) : Separation::cylinder(2.0, 0.5), 3,
                                1e-6);
    const State first{5.0 * random.point_in_ball(), 2.0 * random.point_in_ball()};
    const State second{5.0 * random.point_in_ball(), 2.0 * random.point_in_ball()};
    const StraightPass pass = straight_pass(first, second, separation, now);
    ASSERT_LE(pass.begin, pass.end);
    constexpr int looks = 1000;
    constexpr double ahead = 20.0;
    double least = infinity;
    for (int k = 0; k <= looks; ++k) {
      const double after = ahead * k / looks;
      const bool expected = now + after >= pass.begin && now + after <= pass.end;
      const double doubt = std::min(std::abs(now + after - pass.begin), std::abs(now + after - pass.end));
      if (doubt > 1e-9) {
        ASSERT_EQ(are_within(first, second, separation, after), expected) << after;
      }
      const Vec3 offset = at(first, after).position - at(second, after).position;
      const double distance = norm(separation.begin()->part(offset));
      ASSERT_GE(distance, pass.closest_distance - 1e-9) << after;
      least = std::min(least, distance);
    }
    if (pass.closest_time < now + ahead) {
      ASSERT_NEAR(least, pass.closest_distance, 0.05);
    }
    if (pass.begin == infinity) continue;
    ++passes;
    ASSERT_GE(pass.closest_within(), pass.begin);
    ASSERT_LE(pass.closest_within(), pass.end);
  }
  EXPECT_GT(passes, 150);
}

TEST(StraightPass, OfTwoAtRestHasNoEnd) {
  const Components separation(Separation::sphere(2.0), 3, 1e-6);
  const StraightPass near = straight_pass({{0, 0, 0}, {}}, {{1, 0, 0}, {}}, separation, now);
  EXPECT_EQ(near.begin, now);
  EXPECT_EQ(near.end, infinity);
  EXPECT_EQ(near.closest_distance, 1.0);
  const StraightPass far = straight_pass({{0, 0, 0}, {}}, {{3, 0, 0}, {}}, separation, now);
  EXPECT_EQ(far.begin, infinity);
  EXPECT_EQ(far.end, infinity);
}

TEST(AvoidableUntil, IsWhenTheHardestManoeuvreJustMisses) {
  // Head-on along x. A deviation of up to 1/2 a s^2 across has to reach the limit at the nearest point or
  // later; braking along the course is no faster.
  const Components separation(Separation::sphere(2.0), 3, 1e-6);
  const State first{{-50, 0, 0}, {5, 0, 0}};
  const State second{{50, 0, 0}, {-5, 0, 0}};
  const StraightPass pass = straight_pass(first, second, separation, now);
  EXPECT_NEAR(pass.begin, now + 9.8, 1e-12);
  const ErrorBound limit = ErrorBound(1.0);
  const double until = avoidable_until(first, second, limit, separation, pass, now);
  // At the nearest point the room is 2, which takes 2 s at an acceleration of 1.
  EXPECT_NEAR(until, pass.closest_time - 2.0, 1e-6);
  EXPECT_EQ(avoidable_until(at(first, 9.9), at(second, 9.9), limit, separation,
                            straight_pass(at(first, 9.9), at(second, 9.9), separation, now), now),
            now)
      << "too late";
  const State away{{50, 9, 0}, {-5, 0, 0}};
  EXPECT_EQ(avoidable_until(first, away, limit, separation, straight_pass(first, away, separation, now), now),
            infinity);
}

}  // namespace
}  // namespace kinesphere::straight_pass_test
