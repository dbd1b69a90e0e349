// earliest_exit and swept_box against their slow twins.
#include <gtest/gtest.h>

#include "support/bound_checks.hpp"
#include "support/test_size.hpp"

namespace kinesphere::bound_test {
namespace {

constexpr std::uint64_t seed = 1564;
const auto cases_per_family = rounds_of<std::uint64_t>(8000);
struct BoxCase {
  Bound bound;
  Box box;
  double from, horizon;
};

std::ostream& operator<<(std::ostream& out, const BoxCase& c) {
  return out << "bound = " << c.bound << std::hexfloat << "\nbox " << c.box.lower << " to " << c.box.upper
             << "\nfrom " << c.from << ", horizon " << c.horizon << std::defaultfloat;
}

/// Returns a box that contains the bound for a part of the time; now and then the result of swept_box for a
/// part of it.
BoxCase draw(const Family& family, Random& random) {
  const PairCase pair = family.draw(random);
  BoxCase c{pair.a, {}, pair.from, pair.horizon};
  const double later = c.from + (c.horizon - c.from) * random.uniform();
  c.box = swept_box(c.bound, c.from, later);
  if (chance(random, 0.5)) return c;
  for (int axis = 0; axis < 3; ++axis) {
    const double width = c.box.upper[axis] - c.box.lower[axis];
    const double part = chance(random, 0.5) ? 1.0 : log_uniform(random, -50, -1);
    c.box.lower[axis] -= width * part * random.uniform(-0.01, 1.0);
    c.box.upper[axis] += width * part * random.uniform(-0.01, 1.0);
  }
  return c;
}

double length_scale(const BoxCase& c, double t) {
  return length_scale(c.bound, t) + norm_one(c.box.lower) + norm_one(c.box.upper);
}

class Boxes : public testing::TestWithParam<Family> {};

TEST_P(Boxes, exit_is_never_late_and_tight) {
  // Each case takes two roots in quadruple precision.
  for (std::uint64_t k = 0; k < cases_per_family / 4; ++k) {
    Random random = Random::at(seed, k, 0);
    const BoxCase c = draw(GetParam(), random);
    const double got = earliest_exit(c.bound, c.box, c.from, c.horizon);
    const exact::Wide extra = Tightness{}.length * length_scale(c, std::min(got, c.horizon));
    ASSERT_TRUE(never_late(got, exact::earliest_exit(c.bound, c.box, c.from, c.horizon), c.from, c.horizon))
        << "seed " << seed << ", case " << k << "\n"
        << c;
    ASSERT_TRUE(hardly_early(got, exact::earliest_exit(c.bound, c.box, c.from, c.horizon, extra), c.from,
                             c.horizon, 1e-12))
        << "seed " << seed << ", case " << k << "\n"
        << c;
  }
}

TEST_P(Boxes, swept_box_contains_the_bound_and_hardly_more) {
  for (std::uint64_t k = 0; k < cases_per_family; ++k) {
    Random random = Random::at(seed, k, 1);
    const PairCase c = GetParam().draw(random);
    const double from = c.from + (c.horizon - c.from) * (chance(random, 0.5) ? 0.0 : 0.5 * random.uniform());
    const Box box = swept_box(c.a, from, c.horizon);
    const double allowed = Tightness{}.length * length_scale(c.a, c.horizon);
    for (int axis = 0; axis < 3; ++axis) {
      const exact::Wide above = box.upper[axis] - exact::farthest(c.a, axis, 1, from, c.horizon);
      const exact::Wide below = exact::farthest(c.a, axis, -1, from, c.horizon) - box.lower[axis];
      ASSERT_TRUE(above >= 0 && below >= 0 && above <= allowed && below <= allowed)
          << "seed " << seed << ", case " << k << ", axis " << axis << ": " << static_cast<double>(above)
          << " above, " << static_cast<double>(below) << " below\n"
          << c;
    }
  }
}

TEST_P(Boxes, a_bound_stays_in_its_swept_box_as_long_as_that_was_meant_for) {
  for (std::uint64_t k = 0; k < 1000; ++k) {
    Random random = Random::at(seed, k, 2);
    const PairCase c = GetParam().draw(random);
    Box box = swept_box(c.a, c.from, c.horizon);
    const double margin = Tightness{}.length * length_scale(c.a, c.horizon);
    box.lower -= {margin, margin, margin};
    box.upper += {margin, margin, margin};
    const double got = earliest_exit(c.a, box, c.from, c.horizon);
    ASSERT_TRUE(hardly_early(got, infinity, c.from, c.horizon, 0.0))
        << "seed " << seed << ", case " << k << "\n"
        << c;
  }
}

INSTANTIATE_TEST_SUITE_P(Families, Boxes, testing::ValuesIn(all_families), family_name);

constexpr Box box{{-5, -5, -5}, {5, 5, 5}};

TEST(EarliestExit, is_the_first_of_the_six_sides) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0}) {
      Bound bound{.velocity = {0.1, -0.2, 0.3}, .radius = 1};
      bound.velocity[axis] = 2.0 * sign;
      const double got = earliest_exit(bound, box, 0, 100);
      EXPECT_LE(got, 2.0);
      EXPECT_NEAR(got, 2.0, 1e-12);
    }
}

TEST(EarliestExit, is_infinite_for_a_body_at_rest_and_from_for_one_outside) {
  EXPECT_EQ(earliest_exit({.radius = 1}, box, 0, infinity), infinity);
  EXPECT_EQ(earliest_exit({.radius = 5}, box, 7, 9), 7.0);
  EXPECT_EQ(earliest_exit({.position = {0, 4.5, 0}, .velocity = {0, -1, 0}, .radius = 1}, box, 0, 9), 0.0);
  EXPECT_EQ(earliest_exit({.position = {0, 0, -40}, .radius = 1}, box, 2, 9), 2.0);
}

TEST(EarliestExit, asks_nothing_on_axes_without_end) {
  const Box channel{{-infinity, -2, -infinity}, {infinity, 2, infinity}};
  EXPECT_EQ(earliest_exit({.velocity = {1e100, 0, -1e50}, .radius = 1, .acceleration_limit = 0}, channel, 0,
                          infinity),
            infinity);
  const double got = earliest_exit({.velocity = {5, 1, 7}, .radius = 1}, channel, 0, infinity);
  EXPECT_LE(got, 1.0);
  EXPECT_NEAR(got, 1.0, 1e-12);
}

TEST(SweptBox, reaches_to_the_turning_point) {
  // Up and down again: highest, with its radius, at 5 + 1 after one unit of time.
  const Bound ball{.velocity = {1, 0, 10}, .planned_acceleration = {0, 0, -10}, .radius = 1};
  const Box swept = swept_box(ball, 0, 2);
  EXPECT_NEAR(swept.upper.z, 6.0, 1e-12);
  EXPECT_GE(swept.upper.z, 6.0);
  EXPECT_NEAR(swept.lower.z, -1.0, 1e-12);
  EXPECT_LE(swept.lower.z, -1.0);
  EXPECT_NEAR(swept.lower.x, -1.0, 1e-12);
  EXPECT_NEAR(swept.upper.x, 3.0, 1e-12);
}

}  // namespace
}  // namespace kinesphere::bound_test
