// Pairs of stretches that may touch are all that do, against a plain look at each pair, and few others.
#include "space/stretch_grid.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "kinesphere/random.hpp"

namespace kinesphere::stretch_grid_test {
namespace {

constexpr std::uint64_t seed = 8117;

using Pairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

/// Returns all pairs that are found, the lesser number first. `compared` becomes what that has cost.
Pairs found_among(const std::vector<Stretch>& stretches, std::size_t* compared = nullptr) {
  StretchGrid grid;
  grid.fill(stretches);
  EXPECT_EQ(grid.slots(), stretches.size());
  Pairs found;
  for (std::uint32_t slot = 0; slot < grid.slots(); ++slot)
    for (const std::uint32_t behind : grid.search_behind(slot)) {
      EXPECT_GT(behind, slot);
      const auto pair = std::minmax({grid.number_at(slot), grid.number_at(behind)});
      EXPECT_TRUE(found.insert(pair).second) << "each once: " << pair.first << ' ' << pair.second;
    }
  if (compared != nullptr) *compared = grid.compared();
  return found;
}

double least_distance(const Stretch& a, const Stretch& b) {
  const Vec3 from = b.middle - a.middle, way = b.half_way - a.half_way;
  const double square = norm_squared(way);
  return norm(from + way * (square > 0.0 ? std::clamp(-dot(from, way) / square, -1.0, 1.0) : 0.0));
}

/// All pairs that touch are found, and none whose gap is more than a part of all lengths. Returns the number
/// of pairs that touch.
std::size_t expect_all_that_touch(const std::vector<Stretch>& stretches, const std::string& kind) {
  SCOPED_TRACE(kind);
  const Pairs found = found_among(stretches);
  Vec3 base = stretches.front().middle;
  double extent = 0.0;
  for (const Stretch& one : stretches)
    extent = std::max(extent, norm_one(one.middle - base) + norm_one(one.half_way) + one.radius);
  std::size_t touching = 0;
  for (std::uint32_t a = 0; a < stretches.size(); ++a)
    for (std::uint32_t b = a + 1; b < stretches.size(); ++b) {
      const double radii = stretches[a].radius + stretches[b].radius;
      const double gap = least_distance(stretches[a], stretches[b]) - radii;
      const bool is_found = found.contains({a, b});
      if (gap <= 0.0) {
        ++touching;
        EXPECT_TRUE(is_found) << a << ' ' << b << ' ' << gap;
      } else if (gap > 0x1p-14 * extent) {
        EXPECT_FALSE(is_found) << a << ' ' << b << ' ' << gap;
      }
    }
  return touching;
}

/// What kind of stretches are drawn, in units of `scale` around `base`.
struct Kind {
  std::string name;
  double least_radius, largest_radius;  ///< with logarithms in between
  double way;                           ///< longest half way
  Vec3 axes{1, 1, 1};                   ///< how far they spread
  Vec3 base{};
  double scale = 1.0;
};

std::vector<Stretch> drawn(Random& random, const Kind& kind, std::uint32_t count) {
  std::vector<Stretch> all;
  const auto within = [&](double size) {
    const Vec3 point = size * random.point_in_ball();
    return Vec3{point.x * kind.axes.x, point.y * kind.axes.y, point.z * kind.axes.z};
  };
  const double octaves = std::log2(kind.largest_radius / kind.least_radius);
  for (std::uint32_t number = 0; number < count; ++number)
    all.push_back({.number = number,
                   .middle = kind.base + kind.scale * within(10.0),
                   .half_way = kind.scale * within(kind.way * random.uniform()),
                   .radius = kind.scale * kind.least_radius * std::exp2(octaves * random.uniform())});
  return all;
}

const std::vector<Kind> kinds{
    {"at rest", 0.1, 1.0, 0.0},
    {"fast", 0.1, 0.3, 20.0},
    {"very long ways", 0.5, 1.0, 1000.0},
    {"of very different sizes", 1e-6, 1.0, 0.5},
    {"at rest on a line", 1e-6, 0.05, 0.0, {1, 0, 0}},
    {"in a plane", 0.05, 0.3, 0.5, {1, 1, 0}},
    {"on a line along z", 0.001, 0.01, 0.05, {0, 0, 1}},
    {"in one place", 0.1, 1.0, 0.1, {0, 0, 0}},
    {"far away", 0.1, 0.3, 0.5, {1, 1, 1}, {1e9, -1e9, 1e8}},
    {"huge", 0.1, 0.3, 0.5, {1, 1, 1}, {1e100, 0, 0}, 1e100},
    {"tiny", 0.1, 0.3, 0.5, {1, 1, 1}, {}, 1e-100},
};

TEST(StretchGrid, FindsAllThatTouch) {
  SCOPED_TRACE(seed);
  for (const Kind& kind : kinds) {
    std::size_t touching = 0;
    for (std::uint64_t k = 0; k < 5; ++k) {
      Random random = Random::at(seed, k, 0);
      touching += expect_all_that_touch(drawn(random, kind, 250), kind.name);
    }
    EXPECT_GT(touching, 20u) << kind.name;
  }
}

// Pairs that only just touch, at a time within or at an end of their way, far from each other.
TEST(StretchGrid, FindsThoseThatHardlyTouch) {
  SCOPED_TRACE(seed);
  Random random(seed);
  for (const double way : {0.0, 1e-12, 1.0, 500.0}) {
    std::vector<Stretch> stretches;
    for (std::uint32_t number = 0; number < 2000; number += 2) {
      const Stretch a{.number = number,
                      .middle = 1000.0 * random.point_in_ball(),
                      .half_way = way * random.point_in_ball(),
                      .radius = random.uniform()};
      Stretch b{.number = number + 1, .half_way = way * random.point_in_ball(), .radius = random.uniform()};
      const Vec3 relative = b.half_way - a.half_way;
      // Nearest at this time: across the relative way, or along it at its end.
      const double s = std::clamp(random.uniform(-1.5, 1.5), -1.0, 1.0);
      const Vec3 across = cross(relative, random.point_in_ball());
      Vec3 apart = std::abs(s) < 1.0 ? across : -s * relative;
      if (!(norm(apart) > 0.0)) apart = random.point_in_ball();
      apart = apart * ((a.radius + b.radius) * (1.0 - 1e-9) / norm(apart));
      b.middle = a.middle + apart - relative * s;
      ASSERT_LE(least_distance(a, b), a.radius + b.radius);
      stretches.insert(stretches.end(), {a, b});
    }
    const Pairs found = found_among(stretches);
    for (std::uint32_t number = 0; number < 2000; number += 2)
      EXPECT_TRUE(found.contains({number, number + 1})) << way << ' ' << number;
  }
}

TEST(StretchGrid, FindsTheSameWithAllWidthsOfVectors) {
  SCOPED_TRACE(seed);
  for (const Kind& kind : kinds) {
    Random random(seed);
    const std::vector<Stretch> stretches = drawn(random, kind, 150);
    const Pairs expected = found_among(stretches);
    for (std::int64_t targets = hwy::SupportedTargets(); targets != 0; targets &= targets - 1) {
      hwy::SetSupportedTargetsForTest(targets & -targets);
      EXPECT_EQ(found_among(stretches), expected) << kind.name << ", " << hwy::TargetName(targets & -targets);
      hwy::SetSupportedTargetsForTest(0);
    }
  }
}

TEST(StretchGrid, MayHoldFewOrNone) {
  EXPECT_TRUE(found_among({}).empty());
  EXPECT_TRUE(found_among({{.number = 7, .middle = {1, 2, 3}}}).empty());
  EXPECT_EQ(found_among({{.number = 7, .middle = {1, 2, 3}}, {.number = 3, .middle = {1, 2, 3}}}),
            (Pairs{{3, 7}}))
      << "points in one place";
  EXPECT_TRUE(found_among({{.number = 0, .middle = {0, 0, 0}}, {.number = 1, .middle = {1, 0, 0}}}).empty());
}

TEST(StretchGrid, IsFilledAnew) {
  Random random(seed);
  StretchGrid grid;
  grid.fill(drawn(random, kinds[3], 300));
  for (std::uint32_t slot = 0; slot < grid.slots(); ++slot) grid.search_behind(slot);
  grid.fill(std::vector<Stretch>{{.number = 1, .middle = {}}, {.number = 2, .middle = {}}});
  EXPECT_EQ(grid.slots(), 2u);
  EXPECT_EQ(grid.compared(), 0u);
  EXPECT_EQ(grid.search_behind(0).size(), 1u);
}

/// How many slots are compared for each stretch.
double compared_for_each(const std::vector<Stretch>& stretches) {
  std::size_t compared = 0;
  found_among(stretches, &compared);
  return static_cast<double>(compared) / static_cast<double>(stretches.size());
}

/// Balls of radius 1 in a box of 50 x 50 x 50: each of 20,000 touches five others.
std::vector<Stretch> crowd(Random& random, std::uint32_t count, const Vec3& place = {}) {
  std::vector<Stretch> all;
  for (std::uint32_t number = 0; number < count; ++number)
    all.push_back({.number = number,
                   .middle = place + 50.0 * Vec3{random.uniform(), random.uniform(), random.uniform()},
                   .radius = 1.0});
  return all;
}

// What a search costs does not grow with the number of stretches that are far away or of other sizes.
TEST(StretchGrid, ComparesFewThatAreFarApart) {
  Random random(seed);
  std::vector<Stretch> stretches = crowd(random, 20'000);
  const double alone = compared_for_each(stretches);
  EXPECT_LT(alone, 60.0);
  for (const Stretch& one : crowd(random, 20'000, {30'000, 20'000, -10'000})) stretches.push_back(one);
  for (std::uint32_t number = 0; number < stretches.size(); ++number) stretches[number].number = number;
  EXPECT_LT(compared_for_each(stretches), 4.0 * alone) << "another crowd, far away";
}

TEST(StretchGrid, ComparesFewOfOtherSizes) {
  Random random(seed);
  std::vector<Stretch> stretches = crowd(random, 20'000);
  const double alone = compared_for_each(stretches);
  for (std::uint32_t k = 0; k < 20; ++k)
    stretches.push_back(
        {.number = 20'000 + k, .middle = {25, 25, 25}, .half_way = {100.0 * k, 0, 0}, .radius = 40});
  EXPECT_LT(compared_for_each(stretches), alone + 50.0) << "a few that are everywhere";
  stretches.resize(20'000);
  for (Stretch& one : stretches) one.radius = one.number % 2 == 0 ? 1.0 : 1e-6;
  EXPECT_LT(compared_for_each(stretches), 1.5 * alone) << "of two sizes";
  // Each size is as crowded as all others.
  for (Stretch& one : stretches) {
    one.radius = std::exp2(-20.0 * random.uniform());
    one.middle = 40.0 * one.radius * random.point_in_ball();
  }
  EXPECT_LT(compared_for_each(stretches), 1000.0) << "of all sizes";
}

}  // namespace
}  // namespace kinesphere::stretch_grid_test
