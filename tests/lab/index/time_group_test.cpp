// The least of a few times and the place of one, with vector instructions as without.
#include "lab/index/time_group.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "kinesphere/random.hpp"
#include "number/infinity.hpp"

namespace kinesphere::time_group_test {
namespace {

constexpr std::uint64_t seed = 1002;
constexpr std::size_t width = TimeGroup::width;

TEST(TimeGroup, FillsACacheLineWithInfinity) {
  const TimeGroup group;
  static_assert(sizeof group == 64 && alignof(TimeGroup) == 64);
  for (std::size_t place = 0; place < width; ++place) EXPECT_EQ(group[place], infinity);
  EXPECT_EQ(group.least(), infinity);
  EXPECT_EQ(group.find(infinity), 0u);
  EXPECT_EQ(group.find(1.0), width);
  EXPECT_EQ(group.find_one_by_one(1.0), width);
}

TEST(TimeGroup, FindsEachPlaceAlone) {
  for (std::size_t place = 0; place < width; ++place) {
    TimeGroup group;
    group[place] = -2.5;
    EXPECT_EQ(group.least(), -2.5);
    EXPECT_EQ(group.find(-2.5), place);
    EXPECT_EQ(group.find_one_by_one(-2.5), place);
  }
}

/// Times that differ in half of their bits only, too.
TEST(TimeGroup, FindsTheFirstOfEqualsAndNothingElse) {
  const double nearly_one = 1.0 + 0x1p-52;
  constexpr double largest = std::numeric_limits<double>::max();
  constexpr double smallest = std::numeric_limits<double>::denorm_min();
  const double times[] = {0.0, 1.0, nearly_one, 0x1.00001p0, -1.0, infinity, largest, -largest, smallest};
  Random random(seed);
  for (int round = 0; round < 20000; ++round) {
    TimeGroup group;
    std::array<double, width> plain;
    for (std::size_t place = 0; place < width; ++place)
      plain[place] = group[place] = times[random.bits() % std::size(times)];
    ASSERT_EQ(group.least(), *std::min_element(plain.begin(), plain.end())) << "round " << round;
    for (const double time : times) {
      const auto first =
          static_cast<std::size_t>(std::find(plain.begin(), plain.end(), time) - plain.begin());
      ASSERT_EQ(group.find(time), first) << "round " << round << ", time " << time;
      ASSERT_EQ(group.find_one_by_one(time), first) << "round " << round << ", time " << time;
    }
  }
}

}  // namespace
}  // namespace kinesphere::time_group_test
