// Centres in a box with walls and periodic axes.
#include "placement/sphere_room.hpp"

#include <gtest/gtest.h>

namespace kinesphere::sphere_room_test {
namespace {

constexpr std::uint64_t seed = 6104;

SphereRoom some_room() {
  return {.box = {{-1, 0, 2}, {3, 5, 9}},
          .periodic = {.x = true, .z = true},
          .dimensions = 3,
          .gap = 0.125,
          .radii = {0.25, 0.5}};
}

TEST(SphereRoom, DrawsCentresThatWallsAllow) {
  SCOPED_TRACE(seed);
  Random random(seed);
  const SphereRoom room = some_room();
  for (int k = 0; k < 1000; ++k) {
    const Vec3 centre = room.random_centre(1, random);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_GE(centre[axis], room.lowest(1, axis));
      EXPECT_LE(centre[axis], room.highest(1, axis));
    }
    EXPECT_GE(centre.y, 0.625) << "radius and gap away from the wall";
    EXPECT_EQ(room.inside_walls(1, centre), centre);
  }
  EXPECT_EQ(room.inside_walls(1, {50, 50, 50}), (Vec3{50, 4.375, 50}));
}

TEST(SphereRoom, WrapsPointsIntoTheBox) {
  SCOPED_TRACE(seed);
  Random random(seed);
  const SphereRoom room = some_room();
  for (int k = 0; k < 1000; ++k) {
    const Vec3 point = 100.0 * random.point_in_ball();
    const Vec3 wrapped = room.wrapped(point);
    EXPECT_EQ(wrapped.y, point.y) << "no period there";
    for (const int axis : {0, 2}) {
      EXPECT_GE(wrapped[axis], room.box.lower[axis]);
      EXPECT_LT(wrapped[axis], room.box.upper[axis]);
      const double periods = (point[axis] - wrapped[axis]) / room.size(axis);
      EXPECT_NEAR(periods, std::round(periods), 1e-12);
    }
  }
  EXPECT_EQ(room.wrapped({3, 0, 9}), (Vec3{-1, 0, 2}));
}

TEST(SphereRoom, MeasuresToTheNearestImage) {
  SCOPED_TRACE(seed);
  Random random(seed);
  const SphereRoom room = some_room();
  for (int k = 0; k < 1000; ++k) {
    const Vec3 a = room.random_centre(0, random), b = room.random_centre(1, random);
    double least = infinity;
    for (int x = -1; x <= 1; ++x)
      for (int z = -1; z <= 1; ++z) least = std::min(least, norm(b + Vec3{4.0 * x, 0, 7.0 * z} - a));
    EXPECT_NEAR(norm(room.offset(a, b)), least, 1e-12);
    EXPECT_EQ(room.overlap(0, a, 1, b), norm(room.offset(a, b)) <= 0.875) << k;
  }
}

}  // namespace
}  // namespace kinesphere::sphere_room_test
