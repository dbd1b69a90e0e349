// The boxes around swept spheres contain these all the time.
#include "broadphase/float_aabb.hpp"

#include <gtest/gtest.h>

#include "kinesphere/random.hpp"

namespace kinesphere::float_aabb_test {
namespace {

constexpr std::uint64_t seed = 4521;

SweptSphere random_sphere(Random& random) {
  SweptSphere sphere;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    sphere.centre[axis] = static_cast<float>(random.uniform(-2.0, 2.0));
    sphere.velocity[axis] = static_cast<float>(random.uniform(-2.0, 2.0));
  }
  sphere.radius = static_cast<float>(random.uniform());
  return sphere;
}

TEST(FloatAabb, ContainsTheSweptSphere) {
  SCOPED_TRACE(seed);
  Random random(seed);
  for (int k = 0; k < 2000; ++k) {
    const SweptSphere sphere = random_sphere(random);
    const auto from = static_cast<float>(random.uniform());
    const auto to = static_cast<float>(random.uniform(from, 1.0));
    const FloatAabb aabb = float_aabb_of(sphere, from, to);
    for (const double part : {0.0, 0.3, 1.0})
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double time = from + part * (double(to) - from);
        const double centre = double(sphere.centre[axis]) + double(sphere.velocity[axis]) * time;
        EXPECT_LE(aabb.lower[axis], centre - double(sphere.radius) + 1e-6);
        EXPECT_GE(aabb.upper[axis], centre + double(sphere.radius) - 1e-6);
        EXPECT_NEAR(aabb.middle(axis), 0.5 * (double(aabb.lower[axis]) + double(aabb.upper[axis])), 1e-6);
      }
    const float widest = std::max({aabb.width(0), aabb.width(1), aabb.width(2)});
    EXPECT_EQ(aabb.widest(), widest);
  }
}

TEST(FloatAabb, OfWhatIsEverywhereIsInfinitelyWide) {
  constexpr float infinite = std::numeric_limits<float>::infinity();
  EXPECT_EQ(float_aabb_of({.radius = infinite}, 0.0f, 1.0f).widest(), infinite);
  SweptSphere odd;
  odd.velocity[1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(float_aabb_of(odd, 0.0f, 1.0f).widest(), infinite) << "no number counts as the widest";
}

}  // namespace
}  // namespace kinesphere::float_aabb_test
