// The relative position of two bodies as one polynomial, against their distance in quadruple precision.
#include "paths/relative_arc.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kinesphere/random.hpp"
#include "paths/path_set.hpp"

namespace kinesphere::relative_arc_test {
namespace {

constexpr std::uint64_t seed = 6108;

TEST(RelativeArc, HasTheDistanceAndItsSlope) {
  SCOPED_TRACE(seed);
  PoolLease alone;
  for (std::uint64_t k = 0; k < 100; ++k) {
    Random random = Random::at(seed, k, 0);
    PathSet paths{.basis = k % 2 == 0 ? PolynomialPaths::Basis::monomial : PolynomialPaths::Basis::chebyshev,
                  .arcs = {}};
    for (std::uint32_t body = 0; body < 2; ++body) {
      TestArc arc{body, -random.uniform(), 1.0 + random.uniform(), std::vector<Vec3>(6)};
      for (Vec3& c : arc.coefficients) c = random.point_in_ball();
      paths.arcs.push_back(arc);
    }
    const PolynomialPaths view = paths.view();
    const ArcTable arcs(view, alone);
    const double begin = 0.5 * random.uniform();
    const RelativeArc pair(arcs, 0, 1, begin, begin + 0.4);
    EXPECT_EQ(pair.time(0.0), begin);
    EXPECT_EQ(pair.time(1.0), pair.end());
    for (const double x : {0.0, 0.2, 0.7, 1.0}) {
      const double t = pair.time(x);
      const double distance = *paths.distance(0, 1, t);
      EXPECT_NEAR(pair.distance(x), distance, pair.rounding() + 1e-12);
      const double s = 1e-6;
      const auto square = [&](double at) { return std::pow(*paths.distance(0, 1, at), 2); };
      const double slope = 0.5 * (square(t + s) - square(t - s)) / (2 * s) * 0.4;
      EXPECT_NEAR(pair.at(x), slope, 1e-7 * (1.0 + std::abs(slope)));
    }
    double error = 0.0;
    const BernsteinCoefficients c = pair.over(0.25, 0.75, error);
    ASSERT_GT(c.count, 1u);
    EXPECT_GE(error, 0.0);
    const auto same_sign = [&](double coefficient, double value) {
      EXPECT_TRUE(std::abs(coefficient) <= error || std::abs(value) < 1e-12 || coefficient * value > 0.0);
    };
    same_sign(*c.begin(), pair.at(0.25));
    same_sign(*(c.end() - 1), pair.at(0.75));
  }
}

}  // namespace
}  // namespace kinesphere::relative_arc_test
