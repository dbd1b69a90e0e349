// Angles against the math library in long double, and bit for bit against what every machine must give.
#include "number/angles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>

#include "kinesphere/random.hpp"
#include "number/bit_cast.hpp"

namespace kinesphere::angles_test {
namespace {

constexpr std::uint64_t seed = 6107;

TEST(Angles, HaveTheirSinesAndCosines) {
  SCOPED_TRACE(seed);
  Random random(seed);
  const auto check = [](double angle) {
    const auto [sine, cosine] = sine_and_cosine(angle);
    EXPECT_NEAR(sine, static_cast<double>(std::sin(static_cast<long double>(angle))), 0x1p-51) << angle;
    EXPECT_NEAR(cosine, static_cast<double>(std::cos(static_cast<long double>(angle))), 0x1p-51) << angle;
  };
  for (int k = 0; k < 20000; ++k) check(random.uniform(-1.58, 1.58));
  for (const double angle : {0.0, 1e-300, 1e-9, 0.5 * std::numbers::pi, -0.5 * std::numbers::pi})
    check(angle);
  EXPECT_EQ(sine_and_cosine(1e-300).sine, 1e-300);
  EXPECT_TRUE(std::isnan(sine_and_cosine(std::nan("")).cosine));
}

TEST(Angles, AreThoseOfTheirTangents) {
  SCOPED_TRACE(seed);
  Random random(seed);
  const auto check = [](double tangent) {
    const double expected = static_cast<double>(std::atan(static_cast<long double>(tangent)));
    EXPECT_NEAR(arc_tangent(tangent), expected, 0x1p-50 * expected) << tangent;
  };
  for (int k = 0; k < 20000; ++k) check(random.uniform());
  for (const double tangent : {0.0, 1e-300, 1e-9, 1.0}) check(tangent);
}

/// The bits are those of the same steps in Python.
TEST(Angles, AreEqualOnEveryMachine) {
  std::uint64_t bits = 0;
  const auto add = [&bits](double value) { bits = bits * 0x100000001b3u + bit_cast<std::uint64_t>(value); };
  for (int k = -100; k <= 100; ++k) {
    const auto [sine, cosine] = sine_and_cosine(0x1p-6 * k);
    add(sine);
    add(cosine);
    add(arc_tangent(0x1p-7 * std::abs(k)));
  }
  EXPECT_EQ(bits, 0xc46166f0013b9b22u);
}

}  // namespace
}  // namespace kinesphere::angles_test
