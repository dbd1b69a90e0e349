// Pairs that may come near in a step are all that do, against dense samples.
#include "paths/near_pairs.hpp"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "kinesphere/random.hpp"

namespace kinesphere::near_pairs_test {
namespace {

using Pairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

Vec3 place_of(const StepPath& path, double x) {
  return path.begin + (path.end - path.begin) * x + path.bend * (4.0 * x * (1.0 - x));
}

bool come_near(const StepPath& a, const StepPath& b, double distance) {
  if (!a.exists() || !b.exists()) return false;
  for (int look = 0; look <= 40; ++look)
    if (norm(place_of(a, look / 40.0) - place_of(b, look / 40.0)) <= distance + a.radius + b.radius)
      return true;
  return false;
}

Pairs found_in(NearPairs& pairs, std::span<const StepPath> paths) {
  Pairs found;
  pairs.find(paths, [&](std::uint32_t a, std::uint32_t b) {
    EXPECT_LT(a, b);
    EXPECT_TRUE(found.emplace(a, b).second) << "each once";
  });
  return found;
}

TEST(NearPairs, AreAllThatComeNear) {
  constexpr std::uint64_t seed = 6109;
  SCOPED_TRACE(seed);
  std::size_t near = 0, visited = 0;
  for (std::uint64_t k = 0; k < 20; ++k) {
    Random random = Random::at(seed, k, 0);
    std::vector<StepPath> paths(120);
    for (StepPath& path : paths) {
      path.begin = 5.0 * random.point_in_ball();
      // A few are far faster than most.
      path.end = path.begin + (random.uniform() < 0.05 ? 10.0 : 0.5) * random.point_in_ball();
      path.bend = 0.2 * random.point_in_ball();
      path.radius = random.uniform() < 0.1 ? -1.0 : 0.1 * random.uniform();
    }
    const double distance = 0.5;
    NearPairs all(distance, std::nullopt);
    const Pairs found = found_in(all, paths);
    EXPECT_GT(all.work(), 0.0);
    NearPairs of_one(distance, 7);
    const Pairs of_seven = found_in(of_one, paths);
    for (std::uint32_t a = 0; a < 120; ++a)
      for (std::uint32_t b = a + 1; b < 120; ++b) {
        const bool is_near = come_near(paths[a], paths[b], distance);
        near += is_near ? 1 : 0;
        if (is_near) {
          EXPECT_TRUE(found.contains({a, b})) << a << ' ' << b;
        }
        EXPECT_EQ(of_seven.contains({a, b}), found.contains({a, b}) && (a == 7 || b == 7));
      }
    visited += found.size();
  }
  EXPECT_GT(near, 200u);
  EXPECT_LT(visited, 10 * near) << "and not many others";
}

}  // namespace
}  // namespace kinesphere::near_pairs_test
