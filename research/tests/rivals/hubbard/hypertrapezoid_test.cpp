// A hypertrapezoid contains its horn, and not much more.
#include "research/rivals/hubbard/hypertrapezoid.hpp"

#include <gtest/gtest.h>

#include "kinesphere/random.hpp"

namespace kinesphere::hypertrapezoid_test {
namespace {

Bound random_bound(Random& random) {
  const auto sometimes = [&random](double value) { return random.bits() % 2 == 0 ? value : 0.0; };
  return {.time = random.uniform(0.0, 100.0),
          .position = random.point_in_ball() * 100.0,
          .velocity = random.point_in_ball() * sometimes(50.0),
          .planned_acceleration = random.point_in_ball() * sometimes(30.0),
          .radius = sometimes(random.uniform(0.0, 5.0)),
          .growth_speed = sometimes(random.uniform(0.0, 3.0)),
          .acceleration_limit = sometimes(random.uniform(0.0, 20.0))};
}

/// Edges of the horn, with more digits than those of the library.
struct Edges {
  long double lower, upper;
};
Edges edges(const Bound& bound, int axis, long double s) {
  const long double centre =
      bound.position[axis] + (bound.velocity[axis] + 0.5L * bound.planned_acceleration[axis] * s) * s;
  const long double radius = bound.radius + (bound.growth_speed + 0.5L * bound.acceleration_limit * s) * s;
  return {centre - radius, centre + radius};
}

long double at(const Line& line, long double s) { return line.start + line.speed * s; }

TEST(Hypertrapezoid, contains_the_horn) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    SCOPED_TRACE(seed);
    Random random = Random::at(1995, 2, seed);
    const Bound bound = random_bound(random);
    const double duration = random.bits() % 2 == 0 ? random.uniform(1e-9, 1e-6) : random.uniform(0.0, 10.0);
    const double clearance = random.bits() % 2 == 0 ? 0.0 : 1e-3;
    const Hypertrapezoid hypertrapezoid = enclose(bound, duration, clearance);
    for (int axis = 0; axis < 3; ++axis)
      for (int k = 0; k <= 32; ++k) {
        const long double s = static_cast<long double>(duration) * k / 32;
        const Edges horn = edges(bound, axis, s);
        const auto which = static_cast<std::size_t>(axis);
        ASSERT_LE(at(hypertrapezoid.lower[which], s), horn.lower - clearance);
        ASSERT_GE(at(hypertrapezoid.upper[which], s), horn.upper + clearance);
      }
  }
}

TEST(Hypertrapezoid, touches_a_convex_edge_at_both_ends_and_a_concave_one_in_the_middle) {
  const Bound bound{.time = 3.0,
                    .position = {5.0, 0.0, 0.0},
                    .velocity = {2.0, 0.0, 0.0},
                    .planned_acceleration = {6.0, 0.0, 0.0},
                    .radius = 1.0,
                    .acceleration_limit = 2.0};
  const Hypertrapezoid hypertrapezoid = enclose(bound, 4.0, 0.0);
  EXPECT_NEAR(hypertrapezoid.upper[0].at(0.0), 6.0, 1e-10);
  EXPECT_NEAR(hypertrapezoid.upper[0].at(4.0), 5.0 + 8.0 + 48.0 + 1.0 + 16.0, 1e-10);
  // Along x the lower edge accelerates with 6 - 2: it is convex, so the line below it touches in the middle.
  EXPECT_NEAR(hypertrapezoid.lower[0].at(2.0), 5.0 + 4.0 + 12.0 - 1.0 - 4.0, 1e-10);
  EXPECT_NEAR(hypertrapezoid.lower[1].at(0.0), -1.0, 1e-10);
  EXPECT_NEAR(hypertrapezoid.lower[1].at(4.0), -17.0, 1e-10);
}

TEST(Hypertrapezoid, where_numbers_overflow_it_is_everywhere) {
  const Bound bound{.velocity = {1e300, 0.0, 0.0}, .radius = 1.0};
  const Hypertrapezoid hypertrapezoid = enclose(bound, 1e20, 0.0);
  EXPECT_LT(hypertrapezoid.lower[0].at(1e20), -1e300);
  EXPECT_GT(hypertrapezoid.upper[0].at(1e20), 1e300);
  EXPECT_NEAR(hypertrapezoid.upper[1].at(1e20), 1.0, 1e-10);
}

}  // namespace
}  // namespace kinesphere::hypertrapezoid_test
