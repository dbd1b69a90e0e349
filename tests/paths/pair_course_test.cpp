// The course of two bodies whose paths are simple enough to know their approaches.
#include "paths/pair_course.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "paths/path_set.hpp"

namespace kinesphere::pair_course_test {
namespace {

/// Follows two bodies on one arc each, from 0 to 10.
PairCourse follow(const std::vector<Vec3>& one, const std::vector<Vec3>& other, double distance) {
  PoolLease alone;
  PathSet paths{.basis = PolynomialPaths::Basis::monomial,
                .arcs = {{0, 0.0, 10.0, one}, {1, 0.0, 10.0, other}}};
  const PolynomialPaths view = paths.view();
  const ArcTable arcs(view, alone);
  PairCourse course(arcs, distance);
  course.follow(0, 1, 0.0, 10.0);
  return course;
}

TEST(PairCourse, OfStraightPathsHasOneApproach) {
  // At (t - 4, 1): the distance is sqrt(1 + (t - 4)^2).
  const PairCourse course = follow({{-4, 1, 0}, {1, 0, 0}}, {{0, 0, 0}, {0, 0, 0}}, 2.0);
  ASSERT_EQ(course.approaches.size(), 1u);
  EXPECT_NEAR(course.approaches[0].begin, 4.0 - std::sqrt(3.0), 1e-9);
  EXPECT_NEAR(course.approaches[0].end, 4.0 + std::sqrt(3.0), 1e-9);
  ASSERT_EQ(course.minima.size(), 1u);
  EXPECT_NEAR(course.minima[0].time, 4.0, 1e-6);
  EXPECT_NEAR(course.minima[0].distance, 1.0, 1e-12);
  EXPECT_FALSE(course.minima[0].is_cut_off);
}

TEST(PairCourse, OfAParabolaHasTwoMinima) {
  // At ((t - 5)^2 - 4, 0.5): nearest where the square is 4.
  const PairCourse course = follow({{21, 0.5, 0}, {-10, 0, 0}, {1, 0, 0}}, {{}, {}, {}}, 10.0);
  ASSERT_EQ(course.approaches.size(), 1u);
  ASSERT_EQ(course.minima.size(), 2u);
  EXPECT_NEAR(course.minima[0].time, 3.0, 1e-6);
  EXPECT_NEAR(course.minima[1].time, 7.0, 1e-6);
  EXPECT_NEAR(course.minima[1].distance, 0.5, 1e-12);
}

TEST(PairCourse, OfPathsFarApartIsEmpty) {
  EXPECT_TRUE(follow({{-4, 1, 0}, {1, 0, 0}}, {{}, {}}, 0.5).approaches.empty());
}

TEST(PairCourse, IsCutOffWhereASearchEnds) {
  const PairCourse course = follow({{-20, 1, 0}, {1.5, 0, 0}}, {{}, {}}, 8.0);
  ASSERT_EQ(course.approaches.size(), 1u);
  EXPECT_EQ(course.approaches[0].end, 10.0);
  ASSERT_EQ(course.minima.size(), 1u);
  EXPECT_TRUE(course.minima[0].is_cut_off) << "it still comes nearer";
}

}  // namespace
}  // namespace kinesphere::pair_course_test
