// Overlaps that a change would cause, against a plain look at each pair.
#include "processor/overlaps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "kinesphere/random.hpp"
#include "support/small_world.hpp"

namespace kinesphere::overlaps_test {
namespace {

constexpr std::uint64_t seed = 5208;

std::vector<BodyDefinition> random_balls(Random& random, std::size_t count, double size) {
  std::vector<BodyDefinition> balls(count);
  for (BodyDefinition& ball : balls) {
    ball.radius = 0.2 * random.uniform();
    ball.position = size * random.point_in_ball();
  }
  return balls;
}

bool overlap(const BodyDefinition& a, const BodyDefinition& b) {
  return norm(a.position - b.position) < a.radius + b.radius - 1e-6;
}

TEST(Overlaps, OfNewBodiesAreTheFirstPairInOrder) {
  SCOPED_TRACE(seed);
  Random random(seed);
  const SmallWorld world;
  const Overlaps overlaps(world.state, 0.0);
  int found = 0;
  for (int k = 0; k < 200; ++k) {
    const std::vector<BodyDefinition> added = random_balls(random, 12, 1.0);
    std::optional<std::pair<std::size_t, std::size_t>> expected;
    for (std::size_t b = 0; b < added.size() && !expected; ++b)
      for (std::size_t a = 0; a < b && !expected; ++a)
        if (overlap(added[a], added[b])) expected = {a, b};
    EXPECT_EQ(overlaps.first_among(added), expected) << k;
    if (expected) ++found;
  }
  EXPECT_GT(found, 20);
  EXPECT_LT(found, 195);
}

/// Returns the first pair of these bodies that overlaps in any image, by a plain look at each pair.
std::optional<std::pair<std::size_t, std::size_t>> first_of(const std::vector<BodyDefinition>& added,
                                                            const Vec3& period) {
  for (std::size_t b = 0; b < added.size(); ++b)
    for (std::size_t a = 0; a < b; ++a) {
      Vec3 way = added[b].position - added[a].position;
      for (int axis = 0; axis < 3; ++axis)
        if (period[axis] > 0.0) way[axis] = std::remainder(way[axis], period[axis]);
      if (norm(way) < added[a].radius + added[b].radius - 1e-6) return {{a, b}};
    }
  return std::nullopt;
}

TEST(Overlaps, OfNewBodiesOfAllSizesAreFoundInAllImages) {
  SCOPED_TRACE(seed);
  int found = 0, across = 0;
  for (std::uint64_t k = 0; k < 300; ++k) {
    Random random = Random::at(seed, k, 7);
    const bool in_y = random.uniform() < 0.5, in_z = random.uniform() < 0.5;
    const SmallWorld world(
        {.box = Box{{-10, -10, -10}, {10, 20, 30}}, .periodic = {.x = true, .y = in_y, .z = in_z}});
    const Vec3 period{20, in_y ? 30.0 : 0.0, in_z ? 40.0 : 0.0};
    std::vector<BodyDefinition> added(40);
    for (BodyDefinition& ball : added) {
      ball.radius = 3.0 * std::exp2(-20.0 * random.uniform());
      // Near the corner where eight boxes meet, and some of them periods away.
      ball.position = Vec3{-10, -10, -10} + 6.0 * random.point_in_ball();
      for (int axis = 0; axis < 3; ++axis)
        if (period[axis] > 0.0) ball.position[axis] += period[axis] * std::floor(random.uniform(-2.0, 2.0));
    }
    const auto expected = first_of(added, period);
    EXPECT_EQ(Overlaps(world.state, 0.0).first_among(added), expected) << k;
    if (!expected) continue;
    ++found;
    if (first_of(added, {}) != expected) ++across;
  }
  EXPECT_GT(found, 100);
  EXPECT_GT(across, 50);
  EXPECT_LT(found, 300);
}

TEST(Overlaps, OfANewBodyAndItsImageAreNone) {
  // The world is so long that the grid cannot tell the image from the body.
  const SmallWorld world({.box = Box{{-10, -1e9, -10}, {10, 1e9, 10}}, .periodic = {.x = true}});
  std::vector<BodyDefinition> added(3, {.radius = 3});
  for (std::size_t k = 0; k < added.size(); ++k)
    added[k].position = {-9, -9e8 + 9e8 * static_cast<double>(k), 0};
  EXPECT_EQ(Overlaps(world.state, 0.0).first_among(added), std::nullopt);
}

TEST(Overlaps, OfNewBodiesInOnePlaceAreTheFirstTwo) {
  const SmallWorld world;
  const Overlaps overlaps(world.state, 0.0);
  // So many that a look at all pairs would take minutes.
  std::vector<BodyDefinition> added(400'000, {.radius = 0.5, .position = {1, 2, 3}});
  EXPECT_EQ(overlaps.first_among(added), std::pair(std::size_t{0}, std::size_t{1}));
  for (std::size_t k = 0; k < added.size() / 2; ++k) added[k].position = {3.0 * static_cast<double>(k), 0, 9};
  EXPECT_EQ(overlaps.first_among(added), std::pair(std::size_t{200'000}, std::size_t{200'001}));
  for (BodyDefinition& body : added) body.solid = false;
  EXPECT_EQ(overlaps.first_among(added), std::nullopt) << "they touch nothing";
}

TEST(Overlaps, OfNewBodiesAreThoseThatMayTouch) {
  const SmallWorld world;
  const Overlaps overlaps(world.state, 0.0);
  std::vector<BodyDefinition> added(4, {.radius = 0.5});
  added[0].filter = {.category = 2, .mask = 2};
  added[1].solid = false;
  added[2].filter = added[3].filter = {.category = 4, .mask = 4};
  EXPECT_EQ(overlaps.first_among(added), std::pair(std::size_t{2}, std::size_t{3}));
}

TEST(Overlaps, OfABodyAreThoseWithTheOthersThatAreThere) {
  SCOPED_TRACE(seed);
  Random random(seed + 1);
  SmallWorld world;
  const std::vector<BodyDefinition> others = random_balls(random, 40, 2.0);
  for (const BodyDefinition& ball : others) world.add(ball);
  ASSERT_TRUE(world.main.recertify());
  const Overlaps overlaps(world.state, 0.0);
  const BodyId id = world.state.bodies.table().next_id();
  for (const BodyDefinition& added : random_balls(random, 200, 2.0)) {
    const auto found = overlaps.of_body(id, {bound_now(added, 0.0)}, added);
    std::optional<BodyId> expected;
    for (std::uint32_t k = 0; k < others.size() && !expected; ++k)
      if (overlap(added, others[k])) expected = world.state.bodies.id_of(k);
    EXPECT_EQ(found, expected);
    BodyDefinition zone = added;
    zone.solid = false;
    EXPECT_EQ(overlaps.of_body(id, {bound_now(zone, 0.0)}, zone), std::nullopt) << "it touches nothing";
  }
}

TEST(Overlaps, OfWallsBeginBeyondTheTolerance) {
  const SmallWorld world({.box = Box{{0, 0, 0}, {9, 9, 9}}, .wall_filter = Filter{.category = 2}});
  const Overlaps overlaps(world.state, 0.0);
  const auto wall_at = [&](const Vec3& position, std::uint64_t mask = 2) {
    const Bound bound = bound_now({.radius = 1.0, .position = position}, 0.0);
    return overlaps.of_wall({bound}, {.mask = mask});
  };
  EXPECT_EQ(wall_at({5, 5, 5}), std::nullopt);
  EXPECT_EQ(wall_at({5, 1.0 - 0.5e-6, 5}), std::nullopt);
  EXPECT_EQ(wall_at({5, 0.9, 5}), Wall::y_lower);
  EXPECT_EQ(wall_at({5, 5, 8.5}), Wall::z_upper);
  EXPECT_EQ(wall_at({5, 5, 8.5}, 1), std::nullopt) << "filtered out";
}

}  // namespace
}  // namespace kinesphere::overlaps_test
