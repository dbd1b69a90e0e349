// A grid level in the lengths and times of bodies: its boxes contain them, and its queries find them.
#include "broadphase/grid_level.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "number/infinity.hpp"
#include "support/bound_cases.hpp"

namespace kinesphere::grid_level_test {
namespace {

constexpr std::uint64_t seed = 4523;

/// A level of a window, with the size class of balls of this width.
GridLevel level_of(const Window& window, double width, const Vec3& base, double origin) {
  const InflatedBound ball{BoundAt(Bound{.radius = 0.5 * width}, origin), 0.0};
  GridLevel level{.window = window, .size_class = SizeClasses::size_class_of(ball, Window::endless())};
  level.open(base, origin, 1.0f);
  return level;
}

Bound random_bound(Random& random, double unit, const Vec3& base, double time) {
  return {.time = time,
          .position = base + unit * 4.0 * random.point_in_ball(),
          .velocity = unit * random.point_in_ball(),
          .planned_acceleration = 0.1 * unit * random.point_in_ball(),
          .radius = unit * random.uniform(),
          .acceleration_limit = 0.1 * unit * random.uniform()};
}

/// The gap of two bounds where they go straight on.
double least_gap_on_the_way(const InflatedBound& a, const InflatedBound& b, double duration) {
  double least = infinity;
  for (int look = 0; look <= 64; ++look) {
    const double d = duration * look / 64.0;
    const Vec3 way = a.moved.centre + a.moved.velocity * d - b.moved.centre - b.moved.velocity * d;
    least = std::min(least, norm(way) - a.moved.radius_after(d) - b.moved.radius_after(d));
  }
  return least;
}

TEST(GridLevel, BoxesContainBodiesUntilTheWindowEnds) {
  SCOPED_TRACE(seed);
  for (const double unit : {1e-6, 1.0, 1e9}) {
    Random random(seed);
    const Vec3 base = unit * Vec3{100.0, -50.0, 7.0};
    const Window window = Window::at(8.0, 1);
    GridLevel level = level_of(window, unit, base, 8.0);
    EXPECT_TRUE(level.is_empty());
    for (int k = 0; k < 200; ++k) {
      const double now = 8.0 + 1.9 * random.uniform();
      const Bound bound = random_bound(random, unit, base, now);
      const InflatedBound inflated{BoundAt(bound, now), 0.01 * unit};
      const std::uint32_t slot = level.spheres.add(0, level.swept_sphere(inflated, now), level.time(now));
      const Box box = level.box_at(slot, now);
      for (const double time : {now, 0.5 * (now + window.end), window.end})
        for (int axis = 0; axis < 3; ++axis) {
          EXPECT_LE(box.lower[axis], bound.centre_at(time)[axis] - bound.radius_at(time));
          EXPECT_GE(box.upper[axis], bound.centre_at(time)[axis] + bound.radius_at(time));
          EXPECT_LE(box.upper[axis] - box.lower[axis], level.widest() * (1.0 + 1e-5));
        }
    }
    EXPECT_TRUE(level.is_valid());
  }
}

TEST(GridLevel, QueriesTouchAllThatMayMeet) {
  SCOPED_TRACE(seed);
  int met = 0;
  for (std::uint64_t k = 0; k < 2000; ++k) {
    Random random = Random::at(seed, 1, k);
    const Window window = k % 4 == 0 ? Window::endless() : Window::at(8.0, 1);
    GridLevel level = level_of(window, 1.0, {1, 2, 3}, 8.0);
    Bound bound = random_bound(random, 1.0, {1, 2, 3}, 8.0);
    if (window.end == infinity) bound = {.time = 8.0, .position = bound.position, .radius = bound.radius};
    const InflatedBound own{BoundAt(bound, 8.0), 0.0};
    level.spheres.add(7, level.swept_sphere(own, 8.0), level.time(8.0));
    const double now = 8.0 + random.uniform();
    const double end = now + random.uniform(0.1, 0.9);
    const InflatedBound other{BoundAt(random_bound(random, 1.0, {1, 2, 3}, now), now), 0.0};
    SweptSphereSearches searches;
    level.spheres.add_search(level.query(other, now, end), searches);
    level.spheres.make(searches);
    bool is_found = false;
    searches.for_each_found([&](std::uint32_t, std::uint32_t) { is_found = true; });
    const double gap =
        least_gap_on_the_way({BoundAt(bound, now), 0.0}, other, std::min(end, window.end) - now);
    if (gap <= 0.0) ++met;
    if (gap <= 0.0) {
      EXPECT_TRUE(is_found) << k;
    }
    if (gap > 20.0) {
      EXPECT_FALSE(is_found) << k;
    }
  }
  EXPECT_GT(met, 20);
}

TEST(GridLevel, AreOrderedByWindowAndSize) {
  const GridLevel one{.window = Window::at(0.0, 1), .size_class = 2};
  const GridLevel shorter{.window = Window::at(0.0, 0), .size_class = 2};
  const GridLevel smaller{.window = Window::at(0.0, 1), .size_class = 1};
  EXPECT_TRUE(shorter.is_before(one) && !one.is_before(shorter));
  EXPECT_TRUE(smaller.is_before(one) && !one.is_before(smaller));
  EXPECT_FALSE(one.is_before(one));
  EXPECT_TRUE(one.is_of(one.window, 2));
  EXPECT_FALSE(one.is_of(one.window, 1));
}

TEST(GridLevel, HasNoTimeInTheEndlessWindow) {
  const GridLevel level = level_of(Window::endless(), 1.0, {}, 0.0);
  EXPECT_EQ(level.time(1e6), 0.0f);
  EXPECT_TRUE(level.is_valid());
}

}  // namespace
}  // namespace kinesphere::grid_level_test
