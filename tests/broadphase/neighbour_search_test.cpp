// Searches find all neighbours, in all grid levels and images, against a plain look at each pair.
#include "broadphase/neighbour_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "kinesphere/shape.hpp"
#include "number/infinity.hpp"
#include "parallel/thread_pool.hpp"
#include "support/bound_cases.hpp"
#include "support/true_balls.hpp"

namespace kinesphere::neighbour_search_test {
namespace {

constexpr std::uint64_t seed = 4524;

/// Balls of several sizes and speeds, each in a window that begins at 0.
class Crowd {
 public:
  Crowd(Random& random, const WorldDefinition& world, std::uint32_t count)
      : space(world), windows(space), bounds(count) {
    for (std::uint32_t number = 0; number < count; ++number) {
      bounds[number] = {.position = 2.0 * random.point_in_ball(),
                        .velocity = random.point_in_ball() * log_uniform(random, -3, 0),
                        .radius = 0.02 * log_uniform(random, 0, 3)};
      starters.push_back(starter_of(number));
    }
  }
  InflatedBound bound_of(std::uint32_t number) const { return {BoundAt(bounds[number], 0.0), 0.0}; }
  BroadPhase::Starter starter_of(std::uint32_t number) const {
    const Window window = Window::at(0.0, number % 3 == 0 ? -2 : 0);
    return {number, SizeClasses::size_class_of(bound_of(number), window), window};
  }
  /// True if the two truly meet before the window of either ends.
  bool meet(std::uint32_t a, std::uint32_t b) const {
    const double end = std::min(starter_of(a).window.end, starter_of(b).window.end);
    Extended least = infinity;
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        least = std::min(least, least_true_gap(bounds[a], bounds[b], 0.0, end,
                                               {x * space.period().x, y * space.period().y, 0.0}));
    return least < 0;
  }

  Space space;
  BroadPhase windows;
  std::vector<Bound> bounds;
  std::vector<BroadPhase::Starter> starters;
};

const WorldDefinition unbounded{};
const WorldDefinition repeating{.box = Box{{-2, -2, -2}, {2, 2, 2}}, .periodic = {.x = true, .y = true}};

TEST(NeighbourSearch, FindsAllThatMeetAStartedBodyAndEachPairOnce) {
  SCOPED_TRACE(seed);
  int met = 0;
  for (std::uint64_t k = 0; k < 24; ++k) {
    Random random = Random::at(seed, 0, k);
    Crowd crowd(random, k % 2 == 0 ? unbounded : repeating, 60);
    const auto bound_of = [&](std::uint32_t number) { return crowd.bound_of(number); };
    PoolLease alone;
    crowd.windows.start(crowd.starters, 0.0, bound_of, alone);
    NeighbourSearch search;
    std::set<std::pair<std::uint32_t, std::uint32_t>> found;
    for (std::size_t slot = 0; slot < crowd.windows.started_slots(); slot += 7) {
      const std::size_t last = std::min(slot + 7, crowd.windows.started_slots());
      for (const auto& [a, b] : search.near_started(crowd.windows, slot, last, 0.0, bound_of))
        EXPECT_TRUE(found.insert(std::minmax(a, b)).second || crowd.space.repeats()) << a << ' ' << b;
    }
    for (std::uint32_t a = 0; a < 60; ++a)
      for (std::uint32_t b = a + 1; b < 60; ++b) {
        if (!crowd.meet(a, b)) continue;
        ++met;
        EXPECT_TRUE(found.contains({a, b})) << a << ' ' << b;
      }
  }
  EXPECT_GT(met, 200);
}

TEST(NeighbourSearch, FindsAllThatMeetABodyThatEnters) {
  SCOPED_TRACE(seed);
  for (std::uint64_t k = 0; k < 12; ++k) {
    Random random = Random::at(seed, 1, k);
    Crowd crowd(random, k % 2 == 0 ? unbounded : repeating, 40);
    NeighbourSearch search;
    for (const BroadPhase::Starter& one : crowd.starters) {
      crowd.windows.enter(one.number, crowd.bound_of(one.number), 0.0, one.window);
      const auto entered = search.near_entered(crowd.windows, one.number, crowd.bound_of(one.number), 0.0);
      const std::set<std::uint32_t> found(entered.begin(), entered.end());
      const auto& again =
          search.near(crowd.windows, one.number, crowd.bound_of(one.number), 0.0, one.window.end);
      EXPECT_EQ(found, std::set<std::uint32_t>(again.begin(), again.end()));
      EXPECT_FALSE(found.contains(one.number));
      for (std::uint32_t other = 0; other < one.number; ++other)
        if (crowd.meet(one.number, other)) {
          EXPECT_TRUE(found.contains(other)) << one.number << ' ' << other;
        }
    }
  }
}

TEST(NeighbourSearch, FindsAllThatAreInABox) {
  SCOPED_TRACE(seed);
  Random random(seed);
  Crowd crowd(random, unbounded, 60);
  for (const BroadPhase::Starter& one : crowd.starters)
    crowd.windows.enter(one.number, crowd.bound_of(one.number), 0.0, one.window);
  NeighbourSearch search;
  for (int k = 0; k < 100; ++k) {
    const Vec3 corner = 2.0 * random.point_in_ball();
    const Box box{corner, corner + Vec3{random.uniform(), random.uniform(), random.uniform()}};
    const double now = 0.25 * random.uniform();
    const auto near = search.in_box(crowd.windows, box, now);
    const std::set<std::uint32_t> found(near.begin(), near.end());
    for (std::uint32_t number = 0; number < 60; ++number) {
      const bool is_inside = nearest_point(box, crowd.bounds[number].centre_at(now)).distance <
                             crowd.bounds[number].radius_at(now);
      if (is_inside) {
        EXPECT_TRUE(found.contains(number)) << k << ' ' << number;
      }
    }
  }
}

}  // namespace
}  // namespace kinesphere::neighbour_search_test
