// Bounds and planes, compared with the quadratics in higher precision: entering is never late, leaving is
// never early, and each is close to the truth.
#include "research/rivals/event_driven/crossing.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kinesphere/random.hpp"
#include "number/infinity.hpp"
#include "support/bound_cases.hpp"

namespace kinesphere::crossing_test {
namespace {

constexpr std::uint64_t seed = 3105;

struct Case {
  Bound bound;
  int axis;
  bool upper;
  double from;
  double plane;

  /// Returns the distance of the surface from the plane, negative beyond it.
  long double room(long double t) const {
    const long double sign = upper ? 1.0L : -1.0L;
    const long double s = t - static_cast<long double>(bound.time);
    const long double speed = sign * bound.velocity[axis] + bound.growth_speed;
    const long double acceleration = sign * bound.planned_acceleration[axis] + bound.acceleration_limit;
    return sign * (static_cast<long double>(plane) - bound.position[axis]) - bound.radius -
           (speed + acceleration / 2 * s) * s;
  }
  double scale(double t) const { return length_scale(bound, t) + std::abs(plane); }
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.bound << ", axis " << c.axis << ", upper " << c.upper << ", from " << c.from << ", plane "
             << c.plane;
}

/// Some cases start close to the plane.
Case random_case(std::uint64_t k) {
  Random random = Random::at(seed, k, 0);
  const auto maybe = [&](double largest) {
    return chance(random, 0.6) ? random.uniform(-largest, largest) : 0.0;
  };
  Case c{};
  c.axis = static_cast<int>(random.bits() % 3);
  c.upper = random.bits() % 2 == 0;
  c.bound.time = maybe(100.0);
  c.bound.position = 100.0 * random.point_in_ball();
  c.bound.velocity[c.axis] = maybe(20.0);
  c.bound.planned_acceleration[c.axis] = maybe(10.0);
  c.bound.radius = std::abs(maybe(5.0));
  c.bound.growth_speed = std::abs(maybe(0.5));
  c.bound.acceleration_limit = std::abs(maybe(10.0));
  c.from = c.bound.time + std::abs(maybe(2.0));
  const double surface = c.bound.position[c.axis] + (c.upper ? 1.0 : -1.0) * c.bound.radius_at(c.from);
  c.plane = surface + maybe(chance(random, 0.3) ? log_uniform(random, -50, -20) : 40.0);
  return c;
}

constexpr int cases = 100000;
constexpr double reach = 10.0;

TEST(MovingSide, never_enters_late_and_hardly_early) {
  int entering = 0;
  for (std::uint64_t k = 0; k < cases; ++k) {
    const Case c = random_case(k);
    const double time = MovingSide(c.bound, c.axis, c.upper, c.from).earliest_entering(c.plane, infinity);
    ASSERT_GE(time, c.from);
    const double end = std::min(time, c.from + reach);
    for (int step = 0; step <= 16; ++step) {
      const double t = c.from + (end - c.from) * step / 16.0;
      if (t < time) {
        ASSERT_GE(c.room(t), 0.0L) << "seed " << seed << ", case " << k << ": " << c << " at " << t;
      }
    }
    if (time == infinity) continue;
    ++entering;
    if (time > c.from) {
      ASSERT_LE(c.room(time), 1e-6 * c.scale(time)) << "seed " << seed << ", case " << k << ": " << c;
    }
  }
  EXPECT_GT(entering, cases / 4);
}

TEST(MovingSide, never_leaves_early_and_hardly_late) {
  int leaving = 0;
  for (std::uint64_t k = 0; k < cases; ++k) {
    const Case c = random_case(k);
    const double time = MovingSide(c.bound, c.axis, c.upper, c.from).latest_leaving(c.plane, infinity);
    ASSERT_GT(time, c.from);
    if (time < infinity) {
      ++leaving;
      ASSERT_GE(c.room(time), 0.0L) << "seed " << seed << ", case " << k << ": " << c;
      if (time > std::nextafter(c.from + 0x1p-51 * std::abs(c.from), infinity)) {
        ASSERT_LE(c.room(time), 1e-6 * c.scale(time)) << "seed " << seed << ", case " << k << ": " << c;
      }
      continue;
    }
    // The surface does not come back over the plane.
    bool beyond = false;
    for (int step = 0; step <= 16; ++step) {
      const double t = c.from + reach * step / 16.0;
      beyond = beyond || c.room(t) < -1e-6 * c.scale(t);
      ASSERT_FALSE(beyond && c.room(t) > 1e-6 * c.scale(t)) << "seed " << seed << ", case " << k << ": " << c;
    }
  }
  EXPECT_GT(leaving, cases / 4);
}

TEST(MovingSide, keeps_to_its_horizon_and_never_reaches_infinity) {
  const Bound bound{.velocity = {1, 0, 0}, .radius = 1.0};
  const MovingSide right(bound, 0, true, 0.0);
  EXPECT_NEAR(right.earliest_entering(5.0, 10.0), 4.0, 1e-9);
  EXPECT_EQ(right.earliest_entering(5.0, 3.9), infinity);
  EXPECT_EQ(right.earliest_entering(infinity, infinity), infinity);
  const MovingSide left(bound, 0, false, 0.0);
  EXPECT_NEAR(left.latest_leaving(2.0, 10.0), 3.0, 1e-9);
  EXPECT_EQ(left.latest_leaving(2.0, 2.9), infinity);
  EXPECT_EQ(left.earliest_entering(-infinity, infinity), infinity);
}

TEST(Outgrowing, comes_when_the_diameter_reaches_the_edge) {
  for (std::uint64_t k = 0; k < 10000; ++k) {
    Random random = Random::at(seed, k, 1);
    Bound bound{.time = random.uniform(-5.0, 5.0), .radius = random.uniform()};
    bound.growth_speed = chance(random, 0.5) ? random.uniform() : 0.0;
    bound.acceleration_limit = chance(random, 0.7) ? log_uniform(random, -10, 10) : 0.0;
    const double edge = 4.0 * bound.radius * random.uniform(1.0, 3.0);
    const double time = outgrowing_time(bound, edge);
    if (bound.growth_speed + bound.acceleration_limit == 0.0) {
      ASSERT_EQ(time, infinity);
      continue;
    }
    const double diameter = 2.0 * bound.radius_at(time);
    ASSERT_LE(diameter, edge) << "seed " << seed << ", case " << k;
    ASSERT_GE(diameter, edge * 0.998) << "seed " << seed << ", case " << k;
  }
}

}  // namespace
}  // namespace kinesphere::crossing_test
