// The motion of one bound relative to another, against the two seen one by one.
#include "bound/relative_motion.hpp"

#include <gtest/gtest.h>

#include "support/bound_cases.hpp"
#include "support/exact_certificates.hpp"

namespace kinesphere::relative_motion_test {
namespace {

constexpr std::uint64_t seed = 4109;

class RelativeMotions : public testing::TestWithParam<Family> {};

TEST_P(RelativeMotions, are_those_of_two_bounds_within_their_sizes) {
  for (std::uint64_t k = 0; k < 500 && !HasFailure(); ++k) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", case " << k);
    Random random = Random::at(seed, k, 0);
    const PairCase c = GetParam().draw(random);
    const RelativeMotion motion(c.a, c.b, c.from);
    const double d = (c.horizon - c.from) * random.uniform();
    const exact::Course a(c.a, c.from), b(c.b, c.from);
    const auto difference = [d](const exact::Polynomial& of_a, const exact::Polynomial& of_b) {
      return static_cast<double>(of_a.at(d) - of_b.at(d));
    };
    const double errors = rounding::margin * motion.size_at(d);
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      EXPECT_NEAR(motion.centre_at(d)[axis], difference(a.centre[i], b.centre[i]), errors);
    }
    EXPECT_NEAR(motion.growth_at(d), static_cast<double>(a.growth.at(d) + b.growth.at(d)), errors);
    EXPECT_GE(motion.size_at(d) * (1.0 + 1e-12),
              norm_one(motion.centre_at(d)) + motion.radii + motion.growth_at(d));
    EXPECT_GE(motion.velocity_size * (1.0 + 1e-12), norm_one(motion.velocity) + motion.growth_speed);
    EXPECT_GE(motion.acceleration_size * (1.0 + 1e-12),
              norm_one(motion.acceleration) + motion.acceleration_limit);
  }
}

TEST_P(RelativeMotions, as_bounds_contain_what_two_bodies_may_do) {
  for (std::uint64_t k = 0; k < 500 && !HasFailure(); ++k) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", case " << k);
    Random random = Random::at(seed, k, 1);
    const PairCase c = GetParam().draw(random);
    const BoundBesideBound motion(c.a, c.b, c.from);
    using exact::Wide;
    const Wide d = Wide(c.horizon - c.from) * Wide(random.uniform());
    const exact::Course a(c.a, c.from), b(c.b, c.from), both(motion.bound, c.from);
    // What the one may be beside where the other one may be, and still within the bound that is for both.
    const Wide room = both.growth.at(d) + Wide(motion.bound.radius) + Wide(motion.slack) - a.growth.at(d) -
                      b.growth.at(d) - Wide(c.a.radius) - Wide(c.b.radius);
    Wide square = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Wide astray = a.centre[axis].at(d) - b.centre[axis].at(d) - both.centre[axis].at(d);
      square += astray * astray;
    }
    EXPECT_GE(static_cast<double>(room), 0.0);
    EXPECT_TRUE(square <= room * room);
  }
}

INSTANTIATE_TEST_SUITE_P(Families, RelativeMotions, testing::ValuesIn(all_families), family_name);

}  // namespace
}  // namespace kinesphere::relative_motion_test
