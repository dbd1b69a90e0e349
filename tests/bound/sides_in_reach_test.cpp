// The quick test for the sides of a box, against exact polynomials.
#include "bound/sides_in_reach.hpp"

#include <gtest/gtest.h>

#include "number/infinity.hpp"
#include "support/exact_certificates.hpp"
#include "support/family_test.hpp"

namespace kinesphere::sides_in_reach_test {
namespace {

using exact::Wide;

constexpr std::uint64_t seed = 3307;

struct BoxCase {
  Bound bound;
  Box box;
  double from, horizon, room;
};

std::ostream& operator<<(std::ostream& out, const BoxCase& c) {
  return out << c.bound << std::hexfloat << "\nin " << c.box.lower << " to " << c.box.upper << ", from "
             << c.from << ", horizon " << c.horizon << ", room " << c.room << std::defaultfloat;
}

/// The rounding error that quick_reject.hpp allows.
double rounding_error(const BoxCase& c) {
  return 0x1p-49 *
         (length_scale(c.bound, c.horizon) + norm_one(c.box.lower) + norm_one(c.box.upper) + c.room);
}

/// Returns a box that contains the bound as the test takes it: with its final radius, enlarged by half of its
/// turn.
Box straightened_box(const Bound& bound, double from, double horizon) {
  const BoundAt moved(bound, from);
  const double duration = horizon - from;
  Bound straight{.time = from, .position = moved.centre, .velocity = moved.velocity};
  straight.radius = bound.radius_at(horizon) + 0.5 * norm_one(moved.acceleration) * duration * duration;
  return swept_box(straight, from, horizon);
}

/// Returns a case with sides about as far as the bound and its margin reach: from far outside to just reached
/// or just not.
BoxCase in_a_box(const PairCase& pair, Random& random) {
  BoxCase c{pair.a, swept_box(pair.a, pair.from, pair.horizon), pair.from, pair.horizon, 0.0};
  if (chance(random, 0.7)) c.box = straightened_box(pair.a, pair.from, pair.horizon);
  const double scale = length_scale(c.bound, c.horizon);
  c.room = chance(random, 0.5) ? 0.0 : scale * log_uniform(random, -30, -2);
  for (int axis = 0; axis < 3; ++axis) {
    const auto slack = [&] {
      return c.room + (chance(random, 0.2) ? -1.0 : 1.0) * scale * log_uniform(random, -50, 0);
    };
    c.box.lower[axis] -= slack();
    c.box.upper[axis] += slack();
  }
  return c;
}

bool is_cleared(const Box& near, int axis) {
  return near.lower[axis] == -infinity && near.upper[axis] == infinity;
}

Box near_sides(const BoxCase& c) {
  return sides_in_reach(BoundAt(c.bound, c.from), c.box, c.horizon - c.from, c.room);
}

class SidesInReach : public FamilyTest<seed, in_a_box> {};

TEST_P(SidesInReach, that_are_cleared_are_never_reached) {
  int cleared = 0;
  for_each_case(0, [&](const BoxCase& c, Random&) {
    const Box near = near_sides(c);
    const Wide least = Wide(c.room) - Wide(rounding_error(c));
    for (int axis = 0; axis < 3; ++axis) {
      if (!is_cleared(near, axis)) {
        EXPECT_EQ(near.lower[axis], c.box.lower[axis]);
        EXPECT_EQ(near.upper[axis], c.box.upper[axis]);
        continue;
      }
      ++cleared;
      EXPECT_GT(c.box.upper[axis] - exact::farthest(c.bound, axis, 1, c.from, c.horizon), least) << axis;
      EXPECT_GT(exact::farthest(c.bound, axis, -1, c.from, c.horizon) - c.box.lower[axis], least) << axis;
    }
  });
  EXPECT_GT(cleared, 1000);
}

TEST_P(SidesInReach, are_cleared_where_the_straightened_way_stays_off) {
  for_each_case(1, [](const BoxCase& c, Random&) {
    const Box near = near_sides(c);
    const Box way = straightened_box(c.bound, c.from, c.horizon);
    const double margin = c.room + 2.0 * rounding_error(c);
    for (int axis = 0; axis < 3; ++axis) {
      const bool off =
          way.lower[axis] - margin > c.box.lower[axis] && way.upper[axis] + margin < c.box.upper[axis];
      if (off) {
        EXPECT_TRUE(is_cleared(near, axis)) << axis;
      }
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Families, SidesInReach, testing::ValuesIn(all_families), family_name);

TEST(SidesInReach, of_a_straight_way_are_exact) {
  const BoundAt ball({.velocity = {1, -2, 0}, .radius = 1}, 0.0);
  const Box box{{-5, -5, -5}, {5, 5, 5}};
  const Box near = sides_in_reach(ball, box, 2.0, 0.5);
  EXPECT_TRUE(is_cleared(near, 0));
  EXPECT_EQ(near.lower.y, -5.0);
  EXPECT_EQ(near.upper.y, 5.0);
  EXPECT_TRUE(is_cleared(near, 2));
  EXPECT_TRUE(has_sides(near));
  EXPECT_FALSE(has_sides(sides_in_reach(ball, box, 1.5, 0.5)));
  EXPECT_FALSE(is_cleared(sides_in_reach(ball, box, 0.0, 4.0), 2));
}

TEST(SidesInReach, are_all_that_there_are_where_a_number_is_none) {
  const Box box{{-5, -5, -5}, {5, 5, 5}};
  EXPECT_EQ(sides_in_reach(BoundAt({.radius = 1}, 0.0), box, infinity, 0.0), box);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(sides_in_reach(BoundAt({.velocity = {nan, nan, nan}}, 0.0), box, 1.0, 0.0), box);
  EXPECT_EQ(sides_in_reach(BoundAt({.radius = nan}, 0.0), box, 1.0, 0.0), box);
}

}  // namespace
}  // namespace kinesphere::sides_in_reach_test
