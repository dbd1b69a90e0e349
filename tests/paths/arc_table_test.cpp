// Positions on arcs in both bases, and the bounds that are known of them, against sums in quadruple
// precision.
#include "paths/arc_table.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kinesphere/random.hpp"
#include "paths/path_set.hpp"

namespace kinesphere::arc_table_test {
namespace {

constexpr std::uint64_t seed = 6107;

/// Three bodies with up to four arcs each, which follow each other without gaps.
PathSet random_paths(Random& random, PolynomialPaths::Basis basis) {
  PathSet paths{.basis = basis, .arcs = {}};
  for (std::uint32_t body = 0; body < 3; ++body) {
    double begin = 10.0 * random.uniform();
    for (std::uint64_t count = 1 + random.bits() % 4; count > 0; --count) {
      TestArc arc{body, begin, begin + 0.5 + random.uniform(), std::vector<Vec3>(5)};
      for (Vec3& c : arc.coefficients) c = random.point_in_ball();
      begin = arc.end;
      paths.arcs.push_back(arc);
    }
  }
  return paths;
}

class ArcTables : public testing::TestWithParam<PolynomialPaths::Basis> {};

TEST_P(ArcTables, HavePositionsAndBounds) {
  SCOPED_TRACE(seed);
  PoolLease alone;
  for (std::uint64_t k = 0; k < 30; ++k) {
    Random random = Random::at(seed, k, 0);
    PathSet paths = random_paths(random, GetParam());
    const PolynomialPaths view = paths.view();
    ASSERT_EQ(first_error("call", view, alone), std::nullopt);
    const ArcTable arcs(view, alone);
    ASSERT_EQ(arcs.bodies(), 3u);
    for (std::size_t arc = 0; arc < paths.arcs.size(); ++arc) {
      ArcTable::Times times;
      for (double& t : times) t = arcs.begin(arc) + (0.01 + 0.98 * random.uniform()) * arcs.duration(arc);
      const ArcTable::Positions positions = arcs.positions_at(arc, times);
      for (std::size_t i = 0; i < times.size(); ++i) {
        const State state = arcs.state_at(arc, times[i]);
        for (int axis = 0; axis < 3; ++axis) {
          const auto at = [&](double t) { return paths.coordinate(paths.arcs[arc], axis, t); };
          const auto value = static_cast<double>(at(times[i]));
          const double s = 0x1p-20;
          const auto slope = static_cast<double>((at(times[i] + s) - at(times[i] - s)) / (2 * s));
          EXPECT_NEAR(positions[i][axis], value, arcs.error(paths.arcs[arc].body));
          EXPECT_NEAR(state.position[axis], value, 1e-13);
          EXPECT_NEAR(state.velocity[axis], slope, 1e-7);
          EXPECT_LE(std::abs(slope), arcs.largest_speed() + 1e-7);
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Bases, ArcTables,
                         testing::Values(PolynomialPaths::Basis::monomial,
                                         PolynomialPaths::Basis::chebyshev));

TEST(ArcTable, FindsArcsByTime) {
  PoolLease alone;
  PathSet paths{.basis = PolynomialPaths::Basis::monomial,
                .arcs = {{0, 0.0, 1.0, {Vec3{}}}, {0, 1.0, 2.0, {Vec3{}}}, {2, 5.0, 6.0, {Vec3{1, 1, 1}}}},
                .errors = {0.5, 0.25, 0.125}};
  const PolynomialPaths view = paths.view();
  ASSERT_EQ(first_error("call", view, alone), std::nullopt);
  const ArcTable arcs(view, alone);
  EXPECT_EQ(arcs.first_of(0), 0u);
  EXPECT_EQ(arcs.first_of(1), 2u);
  EXPECT_EQ(arcs.first_of(2), 2u) << "body 1 has none";
  EXPECT_EQ(arcs.arc_after(0, -1.0), 0u);
  EXPECT_EQ(arcs.arc_after(0, 1.0), 1u);
  EXPECT_EQ(arcs.arc_after(0, 2.0), 2u) << "none is left";
  EXPECT_TRUE(arcs.continues(1));
  EXPECT_FALSE(arcs.continues(2)) << "of another body";
  EXPECT_EQ(arcs.declared_error(2), 0.125);
  EXPECT_GT(arcs.error(2), 0.125) << "and rounding";
}

TEST(ArcTable, NamesWhatIsWrong) {
  PoolLease alone;
  const auto refuse = [&](std::vector<TestArc> arcs, const std::string& argument) {
    PathSet paths{.basis = PolynomialPaths::Basis::monomial, .arcs = std::move(arcs)};
    const auto error = first_error("call", paths.view(), alone);
    ASSERT_TRUE(error) << argument;
    EXPECT_EQ(error->argument, argument);
  };
  refuse({{0, 1.0, 1.0, {Vec3{}}}}, "paths.ends");
  refuse({{1, 0.0, 1.0, {Vec3{}}}, {0, 0.0, 1.0, {Vec3{}}}}, "paths.bodies");
  refuse({{0, 0.0, 1.0, {Vec3{}}}, {0, 0.5, 2.0, {Vec3{}}}}, "paths.begins");
  refuse({{0, 0.0, 1.0, {Vec3{1e200, 0, 0}}}}, "paths.coefficients");
}

}  // namespace
}  // namespace kinesphere::arc_table_test
