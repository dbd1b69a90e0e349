// Pairs by distance: as all pairs counted one by one, and as a crystal has them.
#include "kinesphere/radial_distribution.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "kinesphere/random.hpp"
#include "support/expect_error.hpp"

namespace kinesphere::radial_distribution_test {
namespace {

constexpr Box box{{-3, 5, 2}, {7, 21, 14}};

std::vector<Vec3> random_points(std::size_t count, int dimensions, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> points(count);
  // In some image of the box.
  for (Vec3& point : points)
    point = {random.uniform(-30, 30), random.uniform(-30, 30), random.uniform(-30, 30)};
  if (dimensions == 2)
    for (Vec3& point : points) point.z = 0.0;
  return points;
}

/// Counts all pairs one by one.
std::vector<double> by_all_pairs(const std::vector<Vec3>& points, double range, std::size_t bins,
                                 int dimensions) {
  std::vector<double> counts(bins);
  for (std::size_t a = 0; a < points.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      double square = 0.0;
      for (int axis = 0; axis < dimensions; ++axis) {
        const double along =
            std::remainder(points[a][axis] - points[b][axis], box.upper[axis] - box.lower[axis]);
        square += along * along;
      }
      const auto bin = static_cast<std::size_t>(std::sqrt(square) / range * static_cast<double>(bins));
      if (bin < bins) counts[bin] += 1.0;
    }
  const double pi = std::numbers::pi, width = range / static_cast<double>(bins);
  const auto n = static_cast<double>(points.size());
  for (std::size_t bin = 0; bin < bins; ++bin) {
    const double inner = static_cast<double>(bin) * width, outer = inner + width;
    const double shell = dimensions == 2 ? pi * (outer * outer - inner * inner)
                                         : 4 * pi / 3 * (outer * outer * outer - inner * inner * inner);
    const double content = dimensions == 2 ? 10.0 * 16.0 : 10.0 * 16.0 * 12.0;
    counts[bin] /= n * (n - 1) / 2 * shell / content;
  }
  return counts;
}

TEST(RadialDistribution, IsThatOfAllPairs) {
  for (const int dimensions : {2, 3})
    for (const double range : {0.5, 2.0, 5.0})
      for (const std::size_t count : {2u, 17u, 600u}) {
        const auto points = random_points(count, dimensions, count);
        const auto found = radial_distribution(points, box, range, 7, dimensions).value();
        const auto expected = by_all_pairs(points, range, 7, dimensions);
        ASSERT_EQ(found.size(), 7u);
        for (std::size_t bin = 0; bin < 7; ++bin)
          EXPECT_NEAR(found[bin], expected[bin], 1e-9 * expected[bin])
              << dimensions << " dimensions, range " << range << ", " << count << " points, bin " << bin;
      }
}

TEST(RadialDistribution, IsOneForRandomPoints) {
  for (const int dimensions : {2, 3})
    for (const double g :
         radial_distribution(random_points(4000, dimensions, 1), box, 4.0, 4, dimensions).value())
      EXPECT_NEAR(g, 1.0, 0.05) << dimensions << " dimensions";
}

TEST(RadialDistribution, NamesWhatIsWrong) {
  const auto points = random_points(3, 3, 1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [](const Result<std::vector<double>>& result, ErrorCode code, const char* argument,
                          BodyId point = no_body) {
    expect_error(result, code, argument, "radial_distribution: ", point);
  };
  refused(radial_distribution({}, box, 1.0, 5), ErrorCode::out_of_range, "centres");
  refused(radial_distribution({points.data(), 1}, box, 1.0, 5), ErrorCode::out_of_range, "centres");
  refused(radial_distribution(points, box, 5.1, 5), ErrorCode::out_of_range, "range");
  refused(radial_distribution(points, box, 0.0, 5), ErrorCode::out_of_range, "range");
  refused(radial_distribution(points, box, nan, 5), ErrorCode::not_finite, "range");
  refused(radial_distribution(points, box, 1.0, 0), ErrorCode::out_of_range, "bins");
  refused(radial_distribution(points, box, 1.0, 5, 4), ErrorCode::out_of_range, "dimensions");
  refused(radial_distribution(points, box, 1.0, 5, 2), ErrorCode::out_of_range, "centres", {0, 0});
  refused(radial_distribution(points, {{0, 0, 0}, {1, -1, 1}}, 0.1, 5), ErrorCode::out_of_range, "box");
  const std::vector<Vec3> bad{{0, 0, 0}, {0, nan, 0}};
  refused(radial_distribution(bad, box, 1.0, 5), ErrorCode::not_finite, "centres", {1, 0});
}

}  // namespace
}  // namespace kinesphere::radial_distribution_test
