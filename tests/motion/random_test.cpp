// The random numbers: known values, ranges, and independence of streams.
#include "kinesphere/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <set>

namespace kinesphere::random_test {
namespace {

TEST(Random, IsSplitmix64) {
  Random random(1234567);
  const std::uint64_t published[] = {6457827717110365317u, 3203168211198807973u, 9817491932198370423u,
                                     4593380528125082431u, 16408922859458223821u};
  for (const std::uint64_t bits : published) EXPECT_EQ(random.bits(), bits);
}

TEST(Random, UniformStaysInItsRangeAndFillsIt) {
  Random random(1);
  double sum = 0.0;
  double least = 1.0;
  double greatest = 0.0;
  for (int k = 0; k < 100000; ++k) {
    const double number = random.uniform(3.0, 5.0);
    ASSERT_GE(number, 3.0);
    ASSERT_LE(number, 5.0);
    sum += number;
    least = std::min(least, (number - 3.0) / 2.0);
    greatest = std::max(greatest, (number - 3.0) / 2.0);
  }
  EXPECT_NEAR(sum / 100000, 4.0, 0.01);
  EXPECT_LT(least, 1e-3);
  EXPECT_GT(greatest, 1.0 - 1e-3);
}

TEST(Random, BallIsFilledEvenly) {
  Random random(2);
  Vec3 sum;
  int inner = 0;
  constexpr int draws = 100000;
  for (int k = 0; k < draws; ++k) {
    const Vec3 point = random.point_in_ball();
    ASSERT_LE(norm_squared(point), 1.0);
    sum += point;
    inner += norm_squared(point) < 0.25;
  }
  EXPECT_LT(norm(sum) / draws, 0.01);
  EXPECT_NEAR(inner / double{draws}, 0.125, 0.005);  // (1/2)^3
}

TEST(Random, UnitVectorsHaveUnitLengthAndNoPreference) {
  Random random(3);
  Vec3 sum;
  for (int k = 0; k < 100000; ++k) {
    const Vec3 vector = random.unit_vector();
    ASSERT_NEAR(norm(vector), 1.0, 1e-15);
    sum += vector;
  }
  EXPECT_LT(norm(sum) / 100000, 0.01);
}

TEST(Random, EverySeedStreamAndIndexHasItsOwnDraws) {
  std::set<std::uint64_t> seen;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    for (std::uint64_t stream = 0; stream < 20; ++stream) {
      for (std::uint64_t index = 0; index < 20; ++index) seen.insert(Random::at(seed, stream, index).bits());
    }
  }
  EXPECT_EQ(seen.size(), 8000u);
  EXPECT_EQ(Random::at(5, 6, 7).bits(), Random::at(5, 6, 7).bits());
}

}  // namespace
}  // namespace kinesphere::random_test
