// The frame of a triangle, also of a thin one, and the point on its sides that is nearest.
#include "bound/triangle.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kinesphere/random.hpp"

namespace kinesphere::triangle_test {
namespace {

constexpr std::uint64_t seed = 5202;

Triangle some_triangle(Random& random, double thickness) {
  const Vec3 a = random.point_in_ball();
  const Vec3 b = random.point_in_ball();
  const double part = random.uniform();
  return {a, b, a + (b - a) * part + thickness * random.point_in_ball()};
}

TEST(TriangleFrame, IsOrthonormalAlongTheLongestSide) {
  SCOPED_TRACE(seed);
  for (std::uint64_t part = 0; part < 2000; ++part) {
    SCOPED_TRACE(part);
    Random random = Random::at(seed, part, 0);
    const Triangle t = some_triangle(random, std::pow(10.0, -5.0 * random.uniform()));
    const TriangleFrame frame(t);
    const double sides[] = {norm(t.b - t.a), norm(t.c - t.b), norm(t.a - t.c)};
    const double longest = *std::max_element(std::begin(sides), std::end(sides));
    ASSERT_NEAR(frame.length(), longest, 1e-14 * longest);
    const double twice_area = norm(cross(t.b - t.a, t.c - t.a));
    ASSERT_NEAR(frame.height() * longest, twice_area, 1e-14);
    ASSERT_NEAR(norm(frame.normal()), 1.0, 1e-14);
    double around = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const TriangleSide& side = frame.sides()[k];
      around += side.length;
      ASSERT_NEAR(dot(side.direction, side.direction), 1.0, 1e-14);
      // The corner of each side, in the frame and in space.
      ASSERT_LT(norm(frame.origin() + frame.vector(side.start) - frame.corner(k)), 1e-14);
      ASSERT_LT(std::abs(frame.above_plane(frame.corner(k) - frame.origin())), 1e-14);
      const PlaneVector opposite = frame.in_plane(frame.corner(k + 2) - frame.origin());
      ASSERT_LE(side.beyond(opposite), 1e-14) << "the triangle is on the inner side of each side";
    }
    ASSERT_NEAR(around, sides[0] + sides[1] + sides[2], 1e-13);
    ASSERT_NEAR(thickness(t), frame.height() / frame.length(), 0.0);
  }
}

TEST(NearestOnSides, NoOtherPointOfTheSidesIsNearer) {
  SCOPED_TRACE(seed);
  for (std::uint64_t part = 0; part < 2000; ++part) {
    SCOPED_TRACE(part);
    Random random = Random::at(seed, part, 1);
    const TriangleFrame frame(some_triangle(random, std::pow(10.0, -4.0 * random.uniform())));
    const Vec3 point = 2.0 * random.point_in_ball();
    const PlaneVector place = frame.in_plane(point - frame.origin());
    const SidePoint nearest = nearest_on_sides(frame, place);
    ASSERT_TRUE(nearest.part >= 0.0 && nearest.part <= 1.0);
    const Vec3 foot = frame.origin() + frame.vector(place);
    const double found = norm(foot - nearest.place(frame));
    ASSERT_NEAR(found, std::sqrt(dot(nearest.away, nearest.away)), 1e-12);
    constexpr int looks = 100;
    for (std::size_t side = 0; side < 3; ++side)
      for (int k = 0; k <= looks; ++k)
        ASSERT_LE(found, norm(foot - SidePoint{side, double(k) / looks}.place(frame)) + 1e-12);
    if (frame.contains(place)) continue;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const PlaneVector to = frame.in_plane(frame.corner(corner) - nearest.place(frame));
      ASSERT_LE(dot(nearest.away, to), 1e-13) << "the triangle lies behind the plane normal to `away`";
    }
  }
}

TEST(TriangleFrame, KnowsTrianglesWithoutHeight) {
  EXPECT_EQ(thickness({{0, 0, 0}, {1, 0, 0}, {3, 0, 0}}), 0.0);
  EXPECT_LT(thickness({{0, 0, 0}, {1, 1, 1}, {3, 3, 3}}), 1e-15 * least_thickness);
  EXPECT_EQ(thickness({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}), 0.0);
  EXPECT_EQ(thickness({{0, 0, 0}, {4, 0, 0}, {1, 1, 0}}), 0.25);
}

}  // namespace
}  // namespace kinesphere::triangle_test
