// earliest_separation of two bounds against its slow twin.
#include <gtest/gtest.h>

#include "support/bound_checks.hpp"
#include "support/test_size.hpp"

namespace kinesphere::separation_test {
namespace {

constexpr std::uint64_t seed = 1957;
const auto cases_per_family = rounds_of<std::uint64_t>(12000);
double certificate(const PairCase& c) { return earliest_separation(c.a, c.b, c.from, c.horizon, c.distance); }

exact::Wide truth(const PairCase& c, exact::Wide extra = 0) {
  return exact::earliest_separation(c.a, c.b, c.from, c.horizon, c.distance, extra);
}

/// Chooses the distance so that most pairs are closer than it at `from`.
PairCase draw_within(const Family& family, Random& random) {
  PairCase c = family.draw(random);
  const double upper = gap_limits(c.a, c.b, c.from).upper;
  const double extra = c.a.radius + c.b.radius + std::abs(c.distance);
  const double part = chance(random, 0.2) ? 0x1p-30 : 1.0;
  c.distance = upper + part * extra * random.uniform(-0.1, 2.0);
  return c;
}

testing::AssertionResult tight(const PairCase& c) {
  const Tightness allowed;
  const double got = certificate(c);
  const double scale = length_scale(c, std::min(got, c.horizon));
  // Squares are compared, so an error has more weight if the distance is less than the lengths in it.
  const double slack = c.a.radius + c.b.radius + c.distance;
  const double extra = allowed.length * scale * std::max(1.0, scale / std::abs(slack));
  return hardly_early(got, truth(c, -extra), c.from, c.horizon, allowed.part);
}

class EarliestSeparation : public testing::TestWithParam<Family> {};

TEST_P(EarliestSeparation, is_never_late) {
  for (std::uint64_t k = 0; k < cases_per_family; ++k) {
    Random random = Random::at(seed, k, 0);
    const PairCase c = draw_within(GetParam(), random);
    ASSERT_TRUE(never_late(certificate(c), truth(c), c.from, c.horizon))
        << "seed " << seed << ", case " << k << "\n"
        << c;
  }
}

TEST_P(EarliestSeparation, is_tight) {
  for (std::uint64_t k = 0; k < cases_per_family / 2; ++k) {
    Random random = Random::at(seed, k, 1);
    const PairCase c = draw_within(GetParam(), random);
    ASSERT_TRUE(tight(c)) << "seed " << seed << ", case " << k << "\n" << c;
  }
}

TEST_P(EarliestSeparation, does_not_depend_on_the_order_of_the_bounds) {
  for (std::uint64_t k = 0; k < 1000; ++k) {
    Random random = Random::at(seed, k, 2);
    PairCase c = draw_within(GetParam(), random);
    const double got = certificate(c);
    std::swap(c.a, c.b);
    ASSERT_EQ(got, certificate(c)) << "seed " << seed << ", case " << k << "\n" << c;
  }
}

TEST_P(EarliestSeparation, asked_again_on_the_way_is_never_late) {
  for (std::uint64_t k = 0; k < 1000; ++k) {
    Random random = Random::at(seed, k, 3);
    PairCase c = draw_within(GetParam(), random);
    const exact::Wide first_truth = truth(c);
    for (int question = 0; question < 4; ++question) {
      const double got = certificate(c);
      ASSERT_TRUE(never_late(got, first_truth, c.from, c.horizon))
          << "seed " << seed << ", case " << k << ", question " << question << "\n"
          << c;
      if (got == infinity || got <= c.from) break;
      c.from += (got - c.from) * random.uniform();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Families, EarliestSeparation, testing::ValuesIn(all_families), family_name);

TEST(EarliestSeparationOfTwoBounds, is_exact_for_bodies_on_a_line) {
  const Bound a{.radius = 1};
  const Bound b{.position = {2, 0, 0}, .velocity = {0.5, 0, 0}, .radius = 1};
  const double got = earliest_separation(a, b, 0, 100, 0.25);
  EXPECT_LE(got, 0.5);
  EXPECT_NEAR(got, 0.5, 1e-9);
}

TEST(EarliestSeparationOfTwoBounds, is_infinite_for_bodies_at_rest) {
  const Bound a{.radius = 1};
  const Bound b{.position = {1.5, 0, 0}, .radius = 1};
  EXPECT_EQ(earliest_separation(a, b, 0, 10, 0.1), infinity);
  EXPECT_EQ(earliest_separation(a, b, 0, infinity, 0.1), infinity);
  EXPECT_EQ(earliest_separation(a, a, 0, infinity, 0.1), infinity);
}

TEST(EarliestSeparationOfTwoBounds, is_from_when_they_are_apart_or_the_slack_is_gone) {
  const Bound a{.radius = 1};
  EXPECT_EQ(earliest_separation(a, {.position = {3, 0, 0}, .radius = 1}, 0, 10, 1.0), 0.0);
  EXPECT_EQ(earliest_separation(a, {.position = {3, 0, 0}, .radius = 1}, 5, 10, 0.5), 5.0);
  const Bound grown{.radius = 1, .acceleration_limit = 4};
  EXPECT_EQ(earliest_separation(grown, grown, 5, 10, 0.5), 5.0);
}

TEST(EarliestSeparationOfTwoBounds, is_not_late_when_only_the_quartic_term_falls) {
  // The accelerations are chosen so that the lowered coefficient of the square is exactly zero.
  for (const double radius : {0.75, 0.875, 1.0, 1.25, 1.5, 2.0}) {
    double pull = 0.0;
    for (int k = 0; k < 20; ++k) pull = 0x1p-45 * ((1.0 + 2.0 * radius) * (pull + 1.0));
    PairCase c{.a = {.position = {1, 0, 0}, .planned_acceleration = {-pull, 1, 0}, .radius = radius},
               .b = {.radius = radius},
               .horizon = 100.0};
    EXPECT_TRUE(never_late(certificate(c), truth(c), c.from, c.horizon)) << c;
  }
}

TEST(EarliestSeparationOfTwoBounds, is_tight_when_the_quadratic_part_hardly_falls) {
  for (const double turn : {0.0, 1e-16, 1e-13, 1e-10, 1e-5, -1e-10, -1e-5}) {
    const PairCase c{.a = {.position = {1, 0, 0},
                           .velocity = {0, 1, 0},
                           .planned_acceleration = {-1 - turn, 0, 1},
                           .radius = 1},
                     .b = {.radius = 1},
                     .horizon = 100.0,
                     .distance = 0.5};
    EXPECT_TRUE(never_late(certificate(c), truth(c), c.from, c.horizon)) << c;
    EXPECT_TRUE(tight(c)) << c;
  }
}

}  // namespace
}  // namespace kinesphere::separation_test
