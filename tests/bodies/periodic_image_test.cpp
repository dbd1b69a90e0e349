// The image of a body that is stored in periodic space.
#include "bodies/periodic_image.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kinesphere/random.hpp"
#include "number/infinity.hpp"

namespace kinesphere::periodic_image_test {
namespace {

constexpr std::uint64_t seed = 5103;

TEST(PeriodicImages, MovesPathsToThePrimaryBoxAndCounts) {
  SCOPED_TRACE(seed);
  const Box box{{-1.0, 2.0, 0.0}, {3.0, 5.0, 1.0}};
  const Vec3 period{4.0, 3.0, 0.0};
  const Space space({.box = box, .periodic = {.x = true, .y = true}});
  Random random = Random::at(seed, 1, 0);
  for (int part = 0; part < 1000; ++part) {
    PeriodicImage image;
    Vec3 stored = 50.0 * random.point_in_ball();
    Vec3 on_path = stored;
    for (int step = 0; step < 4; ++step) {
      stored -= image.wrap(space, stored, 0.0);
      ASSERT_TRUE(image.is_valid(space));
      for (int axis = 0; axis < 3; ++axis) {
        ASSERT_NEAR(stored[axis], image.middle[axis], 1e-12);
        ASSERT_NEAR(stored[axis] + image.image[axis] * period[axis], on_path[axis], 1e-10);
        if (period[axis] == 0.0) continue;
        ASSERT_GE(image.middle[axis], box.lower[axis]);
        ASSERT_LT(image.middle[axis], box.upper[axis]);
      }
      const Vec3 move = 10.0 * random.point_in_ball();
      stored += move;
      on_path += move;
    }
  }
  PeriodicImage image;
  image.image.z = 1.0;
  EXPECT_FALSE(image.is_valid(space)) << "that axis does not repeat";
  image.image = {0.5, 0.0, 0.0};
  EXPECT_FALSE(image.is_valid(space)) << "half a period";
  image.image = {};
  image.middle.x = infinity;
  EXPECT_FALSE(image.is_valid(space));
}

}  // namespace
}  // namespace kinesphere::periodic_image_test
