// When two that go straight on meet or part, against the roots in long double.
#include "bound/straight_pair.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kinesphere/random.hpp"

namespace kinesphere {
namespace {

constexpr std::uint64_t seed = 3101;
constexpr double margin = 1e-9;

/// Returns the time at which two at this offset are at this distance from each other, on their way out
/// (`sign` 1) or in (-1); NaN if they never are.
long double crossing(const Vec3& offset, const Vec3& velocity, long double distance, int sign) {
  const auto dot_of = [](const Vec3& a, const Vec3& b) {
    return static_cast<long double>(a.x) * b.x + static_cast<long double>(a.y) * b.y +
           static_cast<long double>(a.z) * b.z;
  };
  const long double rise = dot_of(offset, velocity), speed = dot_of(velocity, velocity);
  const long double root = std::sqrt(rise * rise - speed * (dot_of(offset, offset) - distance * distance));
  return (sign * root - rise) / speed;
}

TEST(StraightPair, PartsHardlyEarlyHoweverNearTheDistance) {
  SCOPED_TRACE(seed);
  Random random(seed);
  for (int k = 0; k < 20000; ++k) {
    const double radii = random.uniform(0.1, 10.0), distance = random.uniform(0.0, 5.0);
    const double depth = std::pow(10.0, random.uniform(-7.0, -0.01));
    const Vec3 offset = (radii + distance) * (1.0 - depth) * random.unit_vector();
    const Vec3 velocity = std::pow(10.0, random.uniform(-3.0, 3.0)) * random.unit_vector();
    const double until = StraightPair(offset, velocity, radii).parting(distance, margin);
    const long double truth = crossing(offset, velocity, radii + distance, 1);
    ASSERT_LE(until, truth) << k;
    // So much sooner they are within the margin, where they are slowest on their way out.
    const long double sooner = crossing(offset, velocity, radii + distance - 3.0 * margin, 1);
    ASSERT_GE(until, sooner) << k;
  }
}

TEST(StraightPair, MeetsHardlyEarly) {
  SCOPED_TRACE(seed);
  Random random(seed);
  int met = 0;
  for (int k = 0; k < 20000; ++k) {
    const double radii = random.uniform(0.1, 2.0), distance = random.uniform(0.0, 1.0);
    const Vec3 offset =
        (radii + distance) * (1.0 + std::pow(10.0, random.uniform(-6.0, 1.0))) * random.unit_vector();
    const Vec3 velocity = random.unit_vector() - 0.5 * offset / norm(offset);
    const StraightPair pair(offset, velocity, radii);
    ASSERT_FALSE(pair.are_near(distance)) << k;
    const double until = pair.meeting(distance, margin);
    const long double truth = crossing(offset, velocity, radii + distance, -1);
    const long double sooner = crossing(offset, velocity, radii + distance + 3.0 * margin, -1);
    const bool meets = truth >= 0.0L;
    met += static_cast<int>(meets);
    if (meets) {
      ASSERT_LE(until, truth) << k;
    }
    if (sooner >= 0.0L) {
      ASSERT_GE(until, sooner * (1.0L - 0x1p-40L)) << k;
    } else if (!meets) {
      ASSERT_EQ(until, infinity) << k;
    }
  }
  EXPECT_GT(met, 1000);
}

TEST(StraightPair, SaysNothingOfThoseWhoAreAtTheDistance) {
  EXPECT_EQ(StraightPair({3, 0, 0}, {1, 0, 0}, 2.0).parting(1.0, margin), 0.0);
  EXPECT_EQ(StraightPair({2, 0, 0}, {}, 2.0).parting(1.0, margin), infinity);
  EXPECT_TRUE(StraightPair({3, 0, 0}, {1, 0, 0}, 2.0).are_near(1.0));
}

}  // namespace
}  // namespace kinesphere
