// Approaches on paths of which the answer is known.
#include <gtest/gtest.h>

#include <cmath>

#include "paths/path_set.hpp"

namespace kinesphere::approaches_by_hand_test {
namespace {

using Basis = PolynomialPaths::Basis;

Approaches approaches_of(PathSet paths, double distance, const Approaches::Options& options = {}) {
  return Approaches::of(paths.view(), distance, options).value();
}

TEST(ApproachesByHand, TwoPassEachOther) {
  const auto found = approaches_of(
      {Basis::monomial, {{0, 0, 10, {{0, 0, 0}, {1, 0, 0}}}, {1, 0, 10, {{9, 0, 2}, {-1, 0, 0}}}}}, 3.0);
  ASSERT_EQ(found.approaches.size(), 1u);
  const Approaches::Approach& approach = found.approaches[0];
  EXPECT_EQ(approach.first, 0u);
  EXPECT_EQ(approach.second, 1u);
  EXPECT_NEAR(approach.begin, 4.5 - std::sqrt(5.0) / 2, 1e-12);
  EXPECT_NEAR(approach.end, 4.5 + std::sqrt(5.0) / 2, 1e-12);
  EXPECT_FALSE(approach.begins_with_path);
  EXPECT_FALSE(approach.ends_with_path);
  EXPECT_TRUE(approach.is_certain);
  ASSERT_EQ(found.minima.size(), 1u);
  EXPECT_NEAR(found.minima[0].time, 4.5, 1e-12);
  EXPECT_NEAR(found.minima[0].distance, 2.0, 1e-12);
  EXPECT_FALSE(found.minima[0].is_cut_off);
  EXPECT_NEAR(found.minima[0].relative_velocity().x, -2.0, 1e-15);
  EXPECT_NEAR(found.minima[0].relative_position().z, 2.0, 1e-12);
}

TEST(ApproachesByHand, ChebyshevIsTheSameParabola) {
  // x = 5 u + 2 (2 u^2 - 1), u = (t - 5) / 5.
  const auto found = approaches_of(
      {Basis::chebyshev,
       {{0, 0, 10, {{0, 0, 0}, {5, 0, 0}, {2, 0, 0}}}, {1, 0, 10, {{0.5, 1, 0}, {0, 0, 0}, {0, 0, 0}}}}},
      2.0);
  ASSERT_EQ(found.minima.size(), 1u);
  const double u = (-5.0 + std::sqrt(25.0 + 40.0)) / 8.0;
  EXPECT_NEAR(found.minima[0].time, 5.0 + 5.0 * u, 1e-12);
  EXPECT_NEAR(found.minima[0].distance, 1.0, 1e-12);
  EXPECT_NEAR(found.minima[0].first.velocity.x, 1.0 + 8.0 * u / 5.0, 1e-12);
}

TEST(ApproachesByHand, OnePathTwice) {
  const std::vector<Vec3> path{{7000, 0, 0}, {0, 7, 0}, {-0.004, 0, 0.001}};
  const auto found = approaches_of(
      {Basis::monomial, {{0, 0, 50, path}, {0, 50, 90, path}, {1, 0, 50, path}, {1, 50, 90, path}}}, 1.0);
  ASSERT_EQ(found.approaches.size(), 1u);
  EXPECT_EQ(found.approaches[0].begin, 0.0);
  EXPECT_EQ(found.approaches[0].end, 90.0);
  EXPECT_TRUE(found.approaches[0].begins_with_path && found.approaches[0].ends_with_path);
  ASSERT_EQ(found.minima.size(), 1u);
  EXPECT_EQ(found.minima[0].distance, 0.0);
}

TEST(ApproachesByHand, BodiesAtRestAndPathsOfDegreeZero) {
  const PathSet rest{Basis::chebyshev,
                     {{0, 0, 10, {{0, 0, 0}}}, {1, 2, 8, {{1, 0, 0}}}, {2, 0, 10, {{5, 0, 0}}}}};
  const auto found = approaches_of(rest, 1.0);
  ASSERT_EQ(found.approaches.size(), 1u);
  EXPECT_EQ(found.approaches[0].begin, 2.0);
  EXPECT_EQ(found.approaches[0].end, 8.0);
  EXPECT_EQ(found.minima[0].distance, 1.0);
  EXPECT_TRUE(approaches_of(rest, 0.999).approaches.empty());
}

TEST(ApproachesByHand, AMinimumAtABorderOfArcsIsOne) {
  for (const double border : {5.0, 5.0 - 1e-9, 5.0 + 1e-9}) {
    const double before = border - 5.0;
    const auto found = approaches_of({Basis::monomial,
                                      {{0, 0, border, {{-5, 0, 0}, {1, 0, 0}}},
                                       {0, border, 10, {{before, 0, 0}, {1, 0, 0}}},
                                       {1, 0, 10, {{0, 1, 0}, {0, 0, 0}}}}},
                                     2.0);
    ASSERT_EQ(found.minima.size(), 1u) << before;
    EXPECT_NEAR(found.minima[0].time, 5.0, 1e-7);
    EXPECT_NEAR(found.minima[0].distance, 1.0, 1e-12);
  }
}

TEST(ApproachesByHand, AbsentBodiesMeetNobody) {
  // Body 1 is absent from 3 to 6, when the other passes.
  const std::vector<Vec3> rest{{0, 1, 0}, {0, 0, 0}};
  const auto found = approaches_of({Basis::monomial,
                                    {{0, 0, 10, {{-5, 0, 0}, {1, 0, 0}}},
                                     {1, 0, 3, rest},
                                     {1, 6, 9, rest},
                                     {3, 0, 10, {{0, 50, 0}, {0, 0, 0}}}}},
                                   3.0);
  ASSERT_EQ(found.approaches.size(), 2u);
  EXPECT_EQ(found.approaches[0].end, 3.0);
  EXPECT_TRUE(found.approaches[0].ends_with_path);
  EXPECT_TRUE(found.minima[0].is_cut_off);
  EXPECT_EQ(found.approaches[1].begin, 6.0);
  EXPECT_TRUE(found.approaches[1].begins_with_path);
  EXPECT_NEAR(found.approaches[1].end, 5.0 + std::sqrt(8.0), 1e-12);
}

TEST(ApproachesByHand, AJumpGoesStraight) {
  // Body 1 jumps at 5 from a distance of 9 to one of 1, and on from there.
  const auto found = approaches_of({Basis::monomial,
                                    {{0, 0, 10, {{0, 0, 0}, {0, 0, 0}}},
                                     {1, 0, 5, {{9, 0, 0}, {0, 0, 0}}},
                                     {1, 5, 10, {{1, 0, 0}, {1, 0, 0}}}}},
                                   3.0);
  ASSERT_EQ(found.approaches.size(), 1u);
  EXPECT_EQ(found.approaches[0].begin, 5.0);
  EXPECT_FALSE(found.approaches[0].begins_with_path);
  EXPECT_NEAR(found.approaches[0].end, 7.0, 1e-12);
  EXPECT_EQ(found.minima[0].time, 5.0);
  EXPECT_FALSE(found.minima[0].is_cut_off);
}

TEST(ApproachesByHand, ErrorsMakeApproachesPossibleAndHideShallowMinima) {
  PathSet paths{
      Basis::monomial, {{0, 0, 10, {{0, 0, 0}, {1, 0, 0}}}, {1, 0, 10, {{5, 2, 0}, {0, 0, 0}}}}, {0.25, 0.5}};
  EXPECT_TRUE(approaches_of(paths, 1.2).approaches.empty());
  for (const double distance : {1.3, 2.0, 2.7, 2.8}) {
    const auto found = approaches_of(paths, distance);
    ASSERT_EQ(found.approaches.size(), 1u) << distance;
    EXPECT_EQ(found.approaches[0].is_certain, distance == 2.8) << distance;
    EXPECT_NEAR(std::hypot(found.approaches[0].end - 5.0, 2.0), distance + 0.75, 1e-12);
  }
  // T_8 has minima -1 at four places, so |2 + T_8| has four; a rise of 2 between them.
  const std::vector<Vec3> wave{{2, 0, 0}, {}, {}, {}, {}, {}, {}, {}, {1, 0, 0}}, rest(9);
  PathSet waves{Basis::chebyshev, {{0, 0, 1, wave}, {1, 0, 1, rest}}};
  EXPECT_EQ(approaches_of(waves, 4.0).minima.size(), 4u);
  waves.errors = {0.2, 0.7};
  EXPECT_EQ(approaches_of(waves, 4.0).minima.size(), 4u);
  waves.errors = {0.4, 0.7};
  EXPECT_EQ(approaches_of(waves, 4.0).minima.size(), 1u);
}

TEST(ApproachesByHand, TheSearchMayBePartOfTheTime) {
  const PathSet paths{Basis::monomial,
                      {{0, 0, 10, {{0, 0, 0}, {1, 0, 0}}}, {1, 0, 10, {{5, 2, 0}, {0, 0, 0}}}}};
  const auto before = approaches_of(paths, 3.0, {.end = 4.0});
  ASSERT_EQ(before.approaches.size(), 1u);
  EXPECT_EQ(before.approaches[0].end, 4.0);
  EXPECT_TRUE(before.approaches[0].ends_with_path);
  EXPECT_TRUE(before.minima[0].is_cut_off);
  EXPECT_TRUE(approaches_of(paths, 3.0, {.begin = 8.0}).approaches.empty());
  EXPECT_TRUE(approaches_of(paths, 3.0, {.begin = 12.0}).approaches.empty());
}

TEST(ApproachesByHand, OrbitalFrame) {
  const State body{{7000, 0, 0}, {1, 7, 0}};
  EXPECT_EQ(in_orbital_frame(body, {2, 3, 4}), (Vec3{2, 3, 4}));
  EXPECT_FALSE(is_finite(in_orbital_frame({{1, 0, 0}, {1, 0, 0}}, {1, 0, 0})));
}

TEST(ApproachesByHand, NoPathsNoApproaches) {
  EXPECT_TRUE(approaches_of({Basis::monomial, {}}, 1.0).approaches.empty());
}

}  // namespace
}  // namespace kinesphere::approaches_by_hand_test
