// The arithmetic under the certificates: sums and first roots that are never late, for any doubles.
#include "bound/rounding.hpp"

#include <gtest/gtest.h>

#include "support/bound_cases.hpp"
#include "support/exact_polynomial.hpp"

namespace kinesphere::rounding_test {
namespace {

constexpr std::uint64_t seed = 1202;
double any_sign(Random& random, double size) { return chance(random, 0.5) ? size : -size; }

TEST(SumDown, is_below_the_exact_sum_and_sum_up_above_it) {
  for (std::uint64_t k = 0; k < 200000; ++k) {
    Random random = Random::at(seed, k, 0);
    const int exponent = static_cast<int>(random.bits() % 2040) - 1030;
    const double a = any_sign(random, log_uniform(random, exponent, exponent));
    const double b = any_sign(random, log_uniform(random, exponent - 60, exponent + 3));
    const exact::Wide sum = exact::Wide(a) + b;
    const double down = rounding::sum_down(a, b);
    const double up = rounding::sum_up(a, b);
    ASSERT_TRUE(down <= sum && sum <= up) << std::hexfloat << a << " + " << b;
    ASSERT_LE(up - down, 0x1p-50 * std::abs(a + b)) << std::hexfloat << a << " + " << b;
  }
}

TEST(SumDown, of_infinity_is_infinity) {
  EXPECT_EQ(rounding::sum_down(1.0, infinity), infinity);
  EXPECT_EQ(rounding::sum_down(-1.0, -infinity), -infinity);
  EXPECT_EQ(rounding::sum_up(1.0, infinity), infinity);
}

exact::Wide true_crossing(double c, double b, double a) {
  if (c <= 0.0) return 0;
  const exact::Wide discriminant = exact::Wide(b) * b - exact::Wide(2) * a * c;
  if ((a >= 0.0 && b >= 0.0) || discriminant < 0) return infinity;
  const exact::Wide root = exact::sqrt(discriminant);
  return b >= 0.0 ? (b + root) / -exact::Wide(a) : exact::Wide(2) * c / (root - b);
}

TEST(FirstCrossing, is_never_late_and_hardly_early) {
  for (std::uint64_t k = 0; k < 200000; ++k) {
    Random random = Random::at(seed, k, 1);
    const double c = log_uniform(random, -60, 60);
    const double b = any_sign(random, log_uniform(random, -60, 60));
    const double a = any_sign(random, log_uniform(random, -60, 60));
    const double got = rounding::first_crossing(c, b, a);
    const exact::Wide truth = true_crossing(c, b, a);
    ASSERT_TRUE(got <= truth) << std::hexfloat << "seed " << seed << ", case " << k << ": " << c << ", " << b
                              << ", " << a;
    ASSERT_TRUE(truth == infinity || got >= truth * (1.0 - 1e-6))
        << std::hexfloat << "seed " << seed << ", case " << k << ": " << c << ", " << b << ", " << a;
  }
}

TEST(FirstCrossing, is_not_late_at_double_roots) {
  for (std::uint64_t k = 0; k < 200000; ++k) {
    Random random = Random::at(seed, k, 2);
    const double c = log_uniform(random, -20, 20);
    const double b = -log_uniform(random, -20, 20);
    const double nearly_double = 1.0 + any_sign(random, log_uniform(random, -54, -48));
    const double a = b * b / (2.0 * c) * nearly_double;
    const double got = rounding::first_crossing(c, b, a);
    ASSERT_TRUE(got <= true_crossing(c, b, a))
        << std::hexfloat << "seed " << seed << ", case " << k << ": " << c << ", " << b << ", " << a;
  }
}

TEST(FirstCrossing, is_not_late_where_the_root_underflows) {
  // The root is 2730 2/3 of the smallest double, which would be rounded up, and its margin to zero.
  EXPECT_EQ(rounding::first_crossing(0x1p-1061, -3.0, 0.0), 0.0);
  for (std::uint64_t k = 0; k < 200000; ++k) {
    Random random = Random::at(seed, k, 4);
    const double c = log_uniform(random, -1074, -1000);
    const double b = -log_uniform(random, -80, 80);
    const double a = any_sign(random, log_uniform(random, -80, 80));
    ASSERT_TRUE(rounding::first_crossing(c, b, a) <= true_crossing(c, b, a))
        << std::hexfloat << "seed " << seed << ", case " << k << ": " << c << ", " << b << ", " << a;
  }
}

TEST(FirstCrossing, is_not_late_where_squares_overflow_or_underflow) {
  for (std::uint64_t k = 0; k < 200000; ++k) {
    Random random = Random::at(seed, k, 3);
    const auto any = [&random](int exponent) { return log_uniform(random, exponent - 4, exponent + 4); };
    const int exponent = static_cast<int>(random.bits() % 1200) - 600;
    const int time = static_cast<int>(random.bits() % 400) - 200;
    const double c = any(exponent);
    const double b = any_sign(random, any(exponent - time));
    const double a = any_sign(random, any(exponent - 2 * time));
    ASSERT_TRUE(rounding::first_crossing(c, b, a) <= true_crossing(c, b, a))
        << std::hexfloat << "seed " << seed << ", case " << k << ": " << c << ", " << b << ", " << a;
  }
}

TEST(FirstCrossing, is_now_for_anything_that_is_no_number) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double wrong : {nan, -infinity}) {
    EXPECT_EQ(rounding::first_crossing(wrong, 1.0, 1.0), 0.0);
    EXPECT_EQ(rounding::first_crossing(1.0, wrong, 1.0), 0.0);
    EXPECT_EQ(rounding::first_crossing(1.0, 1.0, wrong), 0.0);
    EXPECT_EQ(rounding::first_crossing(1.0, -1.0, wrong), 0.0);
  }
}

}  // namespace
}  // namespace kinesphere::rounding_test
