// Radii that change with time.
#include "bodies/changing_radii.hpp"

#include <gtest/gtest.h>

namespace kinesphere::changing_radii_test {
namespace {

TEST(ChangingRadii, FollowTheirLaw) {
  const ChangingRadius grows{.rate = 0.5, .radius = 1.0, .time = 2.0, .is_kept = true};
  EXPECT_EQ(grows.at(2.0), 1.0);
  EXPECT_EQ(grows.at(6.0), 3.0);
  EXPECT_EQ(grows.rate_at(6.0), 0.5);
  const ChangingRadius shrinks{.rate = -0.5, .radius = 1.0, .time = 2.0, .is_kept = true};
  EXPECT_EQ(shrinks.end(), 4.0);
  EXPECT_EQ(shrinks.at(3.0), 0.5);
  EXPECT_EQ(shrinks.rate_at(3.0), -0.5);
  for (const double late : {4.0, 5.0, 1e300}) {
    EXPECT_EQ(shrinks.at(late), 0.0) << "never below a point";
    EXPECT_EQ(shrinks.rate_at(late), 0.0);
    EXPECT_TRUE(shrinks.is_point(late));
  }
}

TEST(ChangingRadii, HaveRecordsOfBodiesThatChangedOnly) {
  ChangingRadii radii;
  radii.keep(5, {});
  EXPECT_FALSE(radii.any()) << "a body whose radius never changes takes no memory";
  radii.keep(5, {.rate = 1.0, .radius = 2.0, .is_kept = true});
  ASSERT_NE(radii.find(5), nullptr);
  EXPECT_EQ(radii.find(4), nullptr);
  EXPECT_EQ(radii.find(6), nullptr);
  EXPECT_EQ(radii.of(5).radius, 2.0);
  EXPECT_EQ(radii.of(4).radius, 0.0);
  EXPECT_TRUE(radii.is_valid(6));
  EXPECT_FALSE(radii.is_valid(5));
  radii.keep(5, {});
  EXPECT_EQ(radii.find(5), nullptr) << "the number belongs to another body";
}

}  // namespace
}  // namespace kinesphere::changing_radii_test
