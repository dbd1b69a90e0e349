// gap_limits and the values of a bound at a time, against quadruple precision.
#include <gtest/gtest.h>

#include "support/bound_checks.hpp"
#include "support/test_size.hpp"

namespace kinesphere::gap_limits_test {
namespace {

constexpr std::uint64_t seed = 1687;
const auto cases_per_family = rounds_of<std::uint64_t>(8000);

testing::AssertionResult encloses(const GapLimits& got, const exact::Gaps& truth, double scale) {
  const exact::Wide below = truth.lower - got.lower;
  const exact::Wide above = got.upper - truth.upper;
  const double allowed = Tightness{}.length * scale;
  if (below >= 0 && above >= 0 && below <= allowed && above <= allowed) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "lower by " << static_cast<double>(below) << ", upper by "
                                     << static_cast<double>(above) << " of " << scale;
}

class GapLimitsOf : public testing::TestWithParam<Family> {};

TEST_P(GapLimitsOf, two_bounds_enclose_the_truth_closely) {
  for (std::uint64_t k = 0; k < cases_per_family; ++k) {
    Random random = Random::at(seed, k, 0);
    const PairCase c = GetParam().draw(random);
    const double t = c.from + (c.horizon - c.from) * random.uniform();
    ASSERT_TRUE(encloses(gap_limits(c.a, c.b, t), exact::gap_limits(c.a, c.b, t), length_scale(c, t)))
        << "seed " << seed << ", case " << k << ", t " << t << "\n"
        << c;
  }
}

TEST_P(GapLimitsOf, a_bound_and_a_wall_enclose_the_truth_closely) {
  for (std::uint64_t k = 0; k < cases_per_family; ++k) {
    Random random = Random::at(seed, k, 1);
    const PairCase c = GetParam().draw(random);
    const double t = c.from + (c.horizon - c.from) * random.uniform();
    const HalfSpace wall{random.unit_vector(), length_scale(c, t) * random.uniform(-1.0, 1.0)};
    const double scale = length_scale(c.a, t) + std::abs(wall.offset);
    ASSERT_TRUE(encloses(gap_limits(c.a, wall, t), exact::gap_limits(c.a, wall, t), scale))
        << "seed " << seed << ", case " << k << ", t " << t << "\n"
        << c;
  }
}

/// A pair that is certified apart has a positive lower limit at any earlier time.
TEST_P(GapLimitsOf, two_bounds_agree_with_their_certificate) {
  for (std::uint64_t k = 0; k < cases_per_family; ++k) {
    Random random = Random::at(seed, k, 2);
    const PairCase c = GetParam().draw(random);
    const double until = std::min(c.horizon, earliest_meeting(c.a, c.b, c.from, c.horizon, c.distance));
    const double t = c.from + (until - c.from) * random.uniform();
    if (until <= c.from) continue;
    const double allowed = Tightness{}.length * length_scale(c, t);
    ASSERT_GE(gap_limits(c.a, c.b, t).lower, c.distance - allowed)
        << "seed " << seed << ", case " << k << ", t " << t << "\n"
        << c;
  }
}

INSTANTIATE_TEST_SUITE_P(Families, GapLimitsOf, testing::ValuesIn(all_families), family_name);

TEST(GapLimitsOfTwoBounds, are_as_wide_as_both_growths) {
  const Bound a{.radius = 1, .growth_speed = 1};
  const Bound b{.position = {10, 0, 0}, .velocity = {1, 0, 0}, .radius = 2, .acceleration_limit = 2};
  const GapLimits got = gap_limits(a, b, 3.0);
  EXPECT_NEAR(got.lower, 10.0 + 3.0 - 3.0 - (3.0 + 9.0), 1e-12);
  EXPECT_NEAR(got.upper, 10.0 + 3.0 - 3.0 + (3.0 + 9.0), 1e-12);
}

TEST(BoundAtATime, is_the_quadratic_of_the_header) {
  const Bound bound{.time = 2,
                    .position = {1, 2, 3},
                    .velocity = {4, 5, 6},
                    .planned_acceleration = {2, -2, 4},
                    .radius = 7,
                    .growth_speed = 0.5,
                    .acceleration_limit = 3};
  EXPECT_EQ(bound.centre_at(2), bound.position);
  EXPECT_EQ(bound.velocity_at(2), bound.velocity);
  EXPECT_EQ(bound.radius_at(2), 7.0);
  EXPECT_EQ(bound.centre_at(4), (Vec3{1 + 8 + 4, 2 + 10 - 4, 3 + 12 + 8}));
  EXPECT_EQ(bound.velocity_at(4), (Vec3{8, 1, 14}));
  EXPECT_EQ(bound.radius_at(4), 7.0 + 1.0 + 6.0);
}

TEST(BoundOfABody, holds_what_the_body_promises) {
  const BodyDefinition body{.radius = 2,
                            .acceleration_limit = 3,
                            .planned_acceleration = {0, 0, -9.81},
                            .position_error = 0.25,
                            .velocity_error = 0.5};
  const Bound bound = bound_of(body, {{1, 2, 3}, {4, 5, 6}}, 7);
  EXPECT_EQ(bound.time, 7.0);
  EXPECT_EQ(bound.position, (Vec3{1, 2, 3}));
  EXPECT_EQ(bound.velocity, (Vec3{4, 5, 6}));
  EXPECT_EQ(bound.planned_acceleration, (Vec3{0, 0, -9.81}));
  EXPECT_EQ(bound.radius, 2.25);
  EXPECT_EQ(bound.growth_speed, 0.5);
  EXPECT_EQ(bound.acceleration_limit, 3.0);
}

}  // namespace
}  // namespace kinesphere::gap_limits_test
