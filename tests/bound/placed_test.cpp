// Certificates of bounds and solids that others carry, against bodies that move as their limits allow.
#include "bound/placed.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bound/convex.hpp"
#include "kinesphere/random.hpp"
#include "kinesphere/shape.hpp"

namespace kinesphere::placed_test {
namespace {

constexpr std::uint64_t seed = 4106;
constexpr double errors = 1e-12;

Bound random_bound(Random& random, double radius) {
  return {.time = -random.uniform(),
          .position = 3.0 * random.point_in_ball(),
          .velocity = 2.0 * random.point_in_ball(),
          .planned_acceleration = random.point_in_ball(),
          .radius = radius,
          .growth_speed = 0.1 * random.uniform(),
          .acceleration_limit = random.uniform()};
}

/// Where a body is that goes by a part of what its bound allows, always in one direction.
Vec3 place_of(const Bound& bound, const Vec3& push, double time) {
  return bound.centre_at(time) + push * (bound.radius_at(time) - bound.radius);
}

template <class Solid>
void expect_certain(const Solid& solid, double shape_radius, Random& random) {
  const double radius = random.uniform();
  const Bound ball = random_bound(random, radius);
  const Bound carrier = random_bound(random, shape_radius);
  const Vec3 push = random.point_in_ball();
  const Vec3 other_push = random.point_in_ball();
  const Placed<Solid> shape{solid, &carrier, shape_radius};
  const auto true_gap = [&](double time) {
    const Vec3 seen = place_of(ball, push, time) - place_of(carrier, other_push, time);
    return nearest_point(solid, seen).distance - radius;
  };
  const double distance = random.uniform() < 0.5 ? 0.0 : random.uniform(-0.2, 0.5);
  const double within = std::max(true_gap(0.0), 0.0) + random.uniform();
  const double meets = earliest_meeting(ball, shape, 0.0, 1.0, distance);
  const double parts = earliest_separation(ball, shape, 0.0, 1.0, within);
  for (int look = 0; look <= 20; ++look) {
    const double time = look / 20.0;
    const GapLimits limits = gap_limits(ball, shape, time);
    ASSERT_LE(limits.lower, true_gap(time) + errors);
    ASSERT_GE(limits.upper, true_gap(time) - errors);
    if (time < meets) {
      ASSERT_GT(true_gap(time), distance - errors) << time << " before " << meets;
    }
    if (time < parts) {
      ASSERT_LT(true_gap(time), within + errors) << time << " before " << parts;
    }
  }
}

TEST(Placed, IsCertainWhereverTheTwoAre) {
  SCOPED_TRACE(seed);
  for (std::uint64_t k = 0; k < 1500 && !testing::Test::HasFailure(); ++k) {
    SCOPED_TRACE(k);
    Random random = Random::at(seed, 0, k);
    const Vec3 half{random.uniform(), random.uniform(), random.uniform()};
    expect_certain(Convex(Box{-half, half}), norm(half), random);
    expect_certain(Convex(Triangle{random.unit_vector(), random.unit_vector(), random.unit_vector()}), 1.0,
                   random);
  }
}

TEST(Placed, OnABodyAtRestIsAtRest) {
  const Box box{{-1, -1, -1}, {1, 1, 1}};
  const Bound carrier{.position = {5, 0, 0}, .radius = std::sqrt(3.0)};
  const Bound falling{.position = {0, 0, 0}, .velocity = {1, 0, 0}, .radius = 0.5};
  const Placed<Box> shape{box, &carrier, carrier.radius};
  EXPECT_NEAR(earliest_meeting(falling, shape, 0.0, 10.0), 3.5, 1e-9);
  EXPECT_NEAR(gap_limits(falling, shape, 1.0).lower, 2.5, 1e-9);
}

}  // namespace
}  // namespace kinesphere::placed_test
