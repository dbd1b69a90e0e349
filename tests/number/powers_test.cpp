// Powers of two and roots against the math library.
#include "number/powers.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kinesphere/random.hpp"
#include "number/roots.hpp"

namespace kinesphere::powers_test {
namespace {

TEST(Powers, OfTwoAreExact) {
  for (int exponent = -1022; exponent <= 1023; ++exponent) {
    EXPECT_EQ(power_of_two(exponent), std::ldexp(1.0, exponent));
    EXPECT_EQ(exponent_of(power_of_two(exponent)), exponent);
  }
}

TEST(Powers, ExponentsAreThoseOfTheLargestPowerBelow) {
  Random random(6101);
  for (int k = 0; k < 5000; ++k) {
    const double value = std::ldexp(1.0 + random.uniform(), static_cast<int>(random.bits() % 2000) - 1000);
    EXPECT_EQ(exponent_of(value), std::ilogb(value));
    EXPECT_EQ(exponent_of(-value), std::ilogb(value));
  }
  EXPECT_EQ(exponent_of(0.0), -1023);
  EXPECT_EQ(exponent_of(std::numeric_limits<double>::denorm_min()), -1023);
  EXPECT_EQ(exponent_of(std::numeric_limits<double>::infinity()), 1024);
  EXPECT_EQ(exponent_of(std::numeric_limits<double>::quiet_NaN()), 1024);
}

TEST(CubeRoot, IsRightToTheLastBits) {
  for (const double root : {1e-30, 0.001, 0.5, 1.0, 3.0, 1e20}) {
    EXPECT_NEAR(cube_root(root * root * root), root, 4e-16 * root);
  }
}

}  // namespace
}  // namespace kinesphere::powers_test
