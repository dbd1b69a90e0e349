// Where a body certainly is: around each place it may have, and in each place it certainly fills.
#include "query/certain_sphere.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kinesphere/random.hpp"

namespace kinesphere::certain_sphere_test {
namespace {

constexpr std::uint64_t seed = 5225;

/// A body with a radius of its own within its bound.
Body any_body(Random& random) {
  Body body;
  body.radius = random.uniform(0.1, 2.0);
  body.bound = {.time = random.uniform(),
                .position = 10.0 * random.point_in_ball(),
                .velocity = random.point_in_ball(),
                .planned_acceleration = 0.3 * random.point_in_ball(),
                .radius = body.radius + 0.1 * random.uniform(),
                .growth_speed = 0.1 * random.uniform(),
                .acceleration_limit = random.uniform()};
  return body;
}

TEST(CertainSphere, IsAroundAndWithinTheBodyWhereverItMayBe) {
  SCOPED_TRACE(seed);
  for (std::uint64_t k = 0; k < 500; ++k) {
    SCOPED_TRACE(k);
    Random random = Random::at(seed, 0, k);
    const Body body = any_body(random);
    const double now = body.bound.time + 2.0 * random.uniform();
    const auto [centre, outer, inner] = certain_sphere_of(body, now);
    for (int look = 0; look < 10; ++look) {
      // The farthest place that the bound allows.
      const Vec3 direction = random.unit_vector();
      const Vec3 place = body.bound.centre_at(now) + direction * (body.bound.radius_at(now) - body.radius);
      EXPECT_LE(norm(place + direction * body.radius - centre), outer);
      if (inner >= 0.0) {
        EXPECT_LE(norm(place - centre) + inner, body.radius * (1.0 + 1e-12)) << "all of it is in the body";
      }
    }
    Body rigid = body;
    rigid.is_rigid = true;
    EXPECT_LT(certain_sphere_of(rigid, now).inner, 0.0) << "it may have holes";
    EXPECT_EQ(certain_sphere_of(rigid, now).outer, outer);
  }
}

TEST(PresentBound, IsTheLastOneWithoutAChange) {
  Random random(seed);
  const Body body = any_body(random);
  EXPECT_EQ(present_bound(body, nullptr, 0.0, 5.0), body.bound);
}

TEST(PresentBound, ContainsTheBodyAfterAChange) {
  SCOPED_TRACE(seed);
  for (std::uint64_t k = 0; k < 500; ++k) {
    SCOPED_TRACE(k);
    Random random = Random::at(seed, 1, k);
    const Body body = any_body(random);
    const double now = body.bound.time + 2.0 * random.uniform();
    Change change;
    change.limits = {.acceleration_limit = random.uniform(),
                     .planned_acceleration = 0.3 * random.point_in_ball()};
    if (k % 2 == 0) change.velocity = 2.0 * random.point_in_ball();
    const Bound bound = present_bound(body, &change, 0.0, now);
    EXPECT_EQ(bound.time, now);
    for (int look = 0; look < 10; ++look) {
      // Anywhere in the last bound, with any of its velocities, and then within the new limits.
      const Bound& last = body.bound;
      const double s = now - last.time;
      const Vec3 turn = last.acceleration_limit * random.unit_vector();
      const Vec3 astray = last.growth_speed * random.unit_vector();
      const Vec3 place = last.centre_at(now) + (last.radius - body.radius) * random.unit_vector() +
                         (astray + turn * (0.5 * s)) * s;
      const Vec3 velocity = change.velocity.value_or(last.velocity_at(now) + astray + turn * s);
      const Vec3 acceleration =
          change.limits.planned_acceleration + change.limits.acceleration_limit * random.unit_vector();
      const double after = 3.0 * random.uniform();
      const Vec3 later = place + (velocity + acceleration * (0.5 * after)) * after;
      EXPECT_LE(norm(later - bound.centre_at(now + after)) + body.radius,
                bound.radius_at(now + after) * (1.0 + 1e-12));
    }
  }
}

}  // namespace
}  // namespace kinesphere::certain_sphere_test
