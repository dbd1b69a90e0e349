// Size classes: a class is about a factor of 8, few bodies share the grid level of larger ones, and measured
// margins are remembered.
#include "broadphase/size_classes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kinesphere/random.hpp"
#include "support/bound_cases.hpp"
#include "support/read_back.hpp"

namespace kinesphere::size_classes_test {
namespace {

constexpr std::uint64_t seed = 4511;

InflatedBound ball(double radius, const Vec3& velocity = {}) {
  return {BoundAt(Bound{.velocity = velocity, .radius = radius}, 0.0), 0.0};
}

TEST(SizeClasses, AreThoseOfTheCapsuleForTheWholeWindow) {
  Random random(seed);
  for (int k = 0; k < 5000; ++k) {
    const double radius = log_uniform(random, -60, 60);
    const int level = SizeClasses::size_class_of(ball(radius), Window::endless());
    ASSERT_GE(2.0 * radius, SizeClasses::unit_of(level)) << "seed " << seed << ", case " << k;
    ASSERT_LT(2.0 * radius, SizeClasses::unit_of(level + 1)) << "seed " << seed << ", case " << k;
    ASSERT_TRUE(SizeClasses::is_size_class(level));
  }
  const InflatedBound fast = ball(0.25, {0.0, -8.0, 1.0});
  EXPECT_EQ(SizeClasses::size_class_of(fast, {0, 0.5}), 1) << "2^0 long, however little of it is left";
  EXPECT_EQ(SizeClasses::size_class_of(fast, {6, 64.0}), 3);
}

TEST(SizeClasses, OfFewAreMergedIntoLargerOnesFromTheNextStartOn) {
  for (const bool flat : {false, true}) {
    SizeClasses levels;
    // A volume in which a search of class 0 finds few of class -2 and many of class -1.
    const double searched = flat ? 100.0 : 1000.0;
    levels.merge({{-2, 10}, {-1, 1000}, {0, 10}, {3, 5}}, 10.0 * searched, flat);
    EXPECT_EQ(levels.size_class_to_start(-2), -2) << "not yet";
    levels.use_merged();
    EXPECT_EQ(levels.size_class_to_start(-2), -1);
    EXPECT_EQ(levels.size_class_to_start(-1), -1);
    EXPECT_EQ(levels.size_class_to_start(0), 0) << "the search of level 3 is so large that it finds many";
    EXPECT_EQ(levels.size_class_to_start(3), 3);
    EXPECT_EQ(levels.size_class_to_start(1), 1) << "of which nothing is known";
    EXPECT_EQ(levels.size_class_to_enter(1), 3) << "with the next larger ones";
    EXPECT_EQ(levels.size_class_to_enter(-5), -1);
    EXPECT_EQ(levels.size_class_to_enter(4), 4);
    EXPECT_TRUE(levels.is_valid());
  }
}

TEST(SizeClasses, RememberHowCoarseCellsHaveToBe) {
  SizeClasses levels;
  EXPECT_EQ(levels.coarseness(2, 1), 1.0f);
  levels.set_coarseness(2, 1, 4.0f);
  levels.set_coarseness(2, 1, 8.0f);
  EXPECT_EQ(levels.coarseness(2, 1), 8.0f);
  EXPECT_EQ(levels.coarseness(2, 2), 1.0f);
  EXPECT_EQ(levels.coarseness(1, 1), 1.0f);
  EXPECT_TRUE(levels.is_valid());
  SizeClasses back;
  EXPECT_TRUE(read_back(levels, back));
  EXPECT_EQ(back.coarseness(2, 1), 8.0f);
  levels.set_coarseness(2, 1, 1.0f);
  EXPECT_EQ(levels.coarseness(2, 1), 1.0f);
  levels.set_coarseness(2, 1, 0.5f);
  EXPECT_FALSE(levels.is_valid());
}

}  // namespace
}  // namespace kinesphere::size_classes_test
