// Powers of two, roots, exponentials and logarithms against the math library.
#include "number/powers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "kinesphere/random.hpp"
#include "number/exponential.hpp"
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

TEST(Exponential, AndItsLogarithmAreRightToTheLastBits) {
  Random random(6102);
  const auto check = [](double x) {
    const auto close = [&](double value, long double exact) {
      EXPECT_NEAR(value, static_cast<double>(exact), 0x1p-50 * std::abs(static_cast<double>(exact))) << x;
    };
    close(exponential_less_one(x), std::expm1(static_cast<long double>(x)));
    if (x > -1.0) close(logarithm_of_one_and(x), std::log1p(static_cast<long double>(x)));
  };
  for (int k = 0; k < 20000; ++k) {
    check(random.uniform(-2.0, 2.0));
    check(random.uniform(-700.0, 700.0));
    check(std::ldexp(random.uniform(-1.0, 1.0), -static_cast<int>(random.bits() % 60)));
    check(random.uniform(-1.0, -0.999));
  }
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double x : {0.0, 0.3, -0.3, 1e-300}) check(x);
  EXPECT_EQ(exponential_less_one(infinity), infinity);
  EXPECT_EQ(exponential_less_one(720.0), infinity);
  EXPECT_EQ(exponential_less_one(-infinity), -1.0);
  EXPECT_EQ(exponential_less_one(-1e9), -1.0);
  EXPECT_EQ(logarithm_of_one_and(infinity), infinity);
  EXPECT_EQ(logarithm_of_one_and(-1.0), -infinity);
  for (const double wrong :
       {exponential_less_one(std::nan("")), logarithm_of_one_and(std::nan("")), logarithm_of_one_and(-1.5)})
    EXPECT_TRUE(std::isnan(wrong));
}

TEST(Exponential, IsTheSameOnEveryMachine) {
  double sum = 0.0;
  for (int k = 1; k < 1000; ++k)
    sum += exponential_less_one(-0.01 * k) + 0.001 * exponential_less_one(0.02 * k) +
           logarithm_of_one_and(0.7 * k);
  EXPECT_EQ(sum, 0x1.6e8897c1fdf0cp+24);
}

}  // namespace
}  // namespace kinesphere::powers_test
