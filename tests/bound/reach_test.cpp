// Support functions and supporting planes of boxes and triangles against their points.
#include "bound/reach.hpp"

#include <gtest/gtest.h>

#include "bound/hull_distance.hpp"
#include "kinesphere/random.hpp"
#include "number/infinity.hpp"

namespace kinesphere::reach_test {
namespace {

constexpr std::uint64_t seed = 4108;

template <class Solid>
void expect_those_of_corners(const Solid& solid, Random& random) {
  // The corners nearest to points far out on all sides are all there are.
  const std::vector<Vec3> far_out{{-1e3, -1e3, -1e3}, {1e3, 1e3, 1e3}};
  const Corners corners = corners_near(far_out, solid);
  const Vec3 direction = random.unit_vector();
  const HalfSpace plane = supporting_plane(solid, direction);
  double most = -infinity;
  for (const Vec3& corner : corners.all()) {
    most = std::max(most, dot(direction, corner));
    EXPECT_LE(dot(direction, corner), plane.offset) << "the plane has the solid on its far side";
  }
  EXPECT_NEAR(reach(solid, direction), most, 1e-14);
  EXPECT_NEAR(plane.offset, most, 1e-12);
  EXPECT_EQ(plane.normal, direction);
}

TEST(Reach, IsThatOfTheFarthestCorner) {
  SCOPED_TRACE(seed);
  Random random(seed);
  for (int k = 0; k < 1000; ++k) {
    const Vec3 lower = 5.0 * random.point_in_ball();
    expect_those_of_corners(Box{lower, lower + Vec3{random.uniform(), random.uniform(), random.uniform()}},
                            random);
    expect_those_of_corners(Triangle{random.point_in_ball(), random.point_in_ball(), random.point_in_ball()},
                            random);
  }
}

TEST(SizeOf, PropagatesNan) {
  Box box{{-1, -1, -1}, {1, 1, 1}};
  EXPECT_EQ(size_of(box), 6.0);
  box.upper.y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(size_of(box)));
  EXPECT_TRUE(std::isnan(supporting_plane(box, {1, 0, 0}).offset)) << "nothing is certain then";
}

}  // namespace
}  // namespace kinesphere::reach_test
