// Witnesses keep the gap of two moving hulls below a distance for as long as they say.
#include "bound/witness.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "bound/hull_distance.hpp"
#include "kinesphere/random.hpp"

namespace kinesphere::witness_test {
namespace {

constexpr std::uint64_t seed = 4110;

/// Points that fly straight on, of a size. As each velocity is a linear function of the place, what is a mean
/// of points stays that mean.
struct Hull {
  Hull(Random& random, double size, double speed) {
    points.resize(1 + random.bits() % 7);
    place = random.point_in_ball();
    for (Vec3& point : points) point = place + size * random.point_in_ball();
    velocity = speed * random.point_in_ball();
    spin = random.point_in_ball();
  }
  Bound bound(std::size_t k) const { return {.position = points[k], .velocity = velocity_of(points[k])}; }
  std::vector<Vec3> at(double time) const {
    std::vector<Vec3> moved = points;
    for (Vec3& point : moved) point += velocity_of(point) * time;
    return moved;
  }

  Vec3 velocity_of(const Vec3& point) const { return velocity + cross(spin, point - place); }

  Vec3 place, velocity, spin;
  std::vector<Vec3> points;
};

Witness witness_of(const Hull& one, const Hull& other) {
  Witness witness(0.0);
  const NearestInHulls nearest = nearest_in_hulls(one.points, other.points);
  for (std::size_t k = 0; k < nearest.count; ++k) {
    const auto& [first, second, weight] = nearest.pairs[k];
    witness.add(one.bound(first), other.bound(second), 0.0, weight);
  }
  return witness;
}

TEST(Witness, BoundsTheGapUntilItsTime) {
  SCOPED_TRACE(seed);
  int followed = 0;
  for (std::uint64_t k = 0; k < 1500 && !testing::Test::HasFailure(); ++k) {
    SCOPED_TRACE(k);
    Random random = Random::at(seed, 0, k);
    const Hull one(random, 1.0, 2.0);
    const Hull other(random, 1.0, 2.0);
    const Witness witness = witness_of(one, other);
    const double gap = nearest_in_hulls(one.points, other.points).distance;
    EXPECT_NEAR(witness.largest_gap(), gap, 1e-9);
    EXPECT_GE(witness.largest_gap(), gap - 1e-15);
    const double distance = gap + 0.3 * random.uniform();
    const double until = witness.separation(2.0, distance);
    // Two points that are fixed in their hulls are farther apart by then.
    if (until * norm(one.velocity - other.velocity) > distance + gap) ++followed;
    for (int look = 0; look < 20; ++look) {
      const double time = std::min(until, 2.0) * look / 20.0;
      EXPECT_LE(nearest_in_hulls(one.at(time), other.at(time)).distance, distance + 1e-9) << time;
    }
  }
  EXPECT_GT(followed, 100) << "points that keep up with each other last longer than fixed ones";
}

TEST(Witness, SlidesAlongAFace) {
  // A point slides along a wall of length 10, a tenth above it.
  Witness witness(0.0);
  const Bound slider{.position = {0, 0.1, 0}, .velocity = {1, 0, 0}};
  for (const double end : {-5.0, 5.0}) witness.add({.position = {end, 0, 0}}, slider, 0.0, 0.5);
  EXPECT_NEAR(witness.separation(100.0, 0.2), 5.0, 0.2) << "until it leaves the end of the wall";
  EXPECT_EQ(witness.separation(4.0, 0.2), infinity);
}

}  // namespace
}  // namespace kinesphere::witness_test
