// The extrema of polynomials whose slopes have known roots are found in order, and none is left out.
#include "number/slope_signs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "kinesphere/random.hpp"

namespace kinesphere::slope_signs_test {
namespace {

constexpr std::uint64_t seed = 6102;

/// (s - r1) (s - r2) (s - r3), times a factor.
struct Cubic {
  std::array<double, 3> roots;
  double factor;

  double at(double s) const { return factor * (s - roots[0]) * (s - roots[1]) * (s - roots[2]); }
  /// Bernstein coefficients by polar forms.
  std::array<double, 4> over(double lower, double upper, double& error) const {
    const double sum = roots[0] + roots[1] + roots[2];
    const double pairs = roots[0] * roots[1] + roots[1] * roots[2] + roots[2] * roots[0];
    const double product = roots[0] * roots[1] * roots[2];
    const auto polar = [&](double a, double b, double c) {
      return factor * (a * b * c - sum * (a * b + b * c + c * a) / 3.0 + pairs * (a + b + c) / 3.0 - product);
    };
    error = 1e-14 * std::abs(factor);
    return {polar(lower, lower, lower), polar(lower, lower, upper), polar(lower, upper, upper),
            polar(upper, upper, upper)};
  }
};

/// Notes the signs that it is told.
struct Visitor {
  void rises(double s) { note(s, 1); }
  void falls(double s) { note(s, -1); }
  void stays(double s) { note(s, 0); }
  void note(double s, int sign) {
    if (!times.empty()) {
      EXPECT_GE(s, times.back());
    }
    times.push_back(s);
    signs.push_back(sign);
  }
  std::vector<double> times;
  std::vector<int> signs;
};

TEST(SlopeSigns, ChangeAtTheRoots) {
  SCOPED_TRACE(seed);
  Random random(seed);
  for (int k = 0; k < 2000; ++k) {
    Cubic slope{{random.uniform(), random.uniform(), random.uniform()}, random.uniform(-2.0, 2.0)};
    std::sort(slope.roots.begin(), slope.roots.end());
    Visitor visitor;
    SlopeSigns(slope, visitor).visit(0.0, 1.0);
    std::vector<double> changes;
    int last = slope.at(0.0) > 0.0 ? 1 : -1;
    for (std::size_t n = 0; n < visitor.signs.size(); ++n) {
      if (visitor.signs[n] == 0 || visitor.signs[n] == last) continue;
      last = visitor.signs[n];
      changes.push_back(visitor.times[n]);
    }
    if (slope.roots[1] - slope.roots[0] < 1e-4 || slope.roots[2] - slope.roots[1] < 1e-4) continue;
    ASSERT_EQ(changes.size(), 3u) << k;
    for (std::size_t n = 0; n < 3; ++n) EXPECT_NEAR(changes[n], slope.roots[n], 1e-6) << k;
  }
}

TEST(SlopeSigns, OfATouchedZeroAreHidden) {
  const Cubic slope{{0.5, 0.5, 2.0}, -1.0};  // touches zero in the middle, from above
  Visitor visitor;
  SlopeSigns(slope, visitor).visit(0.0, 1.0);
  EXPECT_EQ(std::count(visitor.signs.begin(), visitor.signs.end(), -1), 0) << "it never falls";
  EXPECT_EQ(visitor.signs.front(), 1);
}

}  // namespace
}  // namespace kinesphere::slope_signs_test
