// Many bodies that are recertified together, with numbers unrelated to their places.
#include <gtest/gtest.h>

#include <array>
#include <set>
#include <utility>
#include <vector>

#include "kinesphere/inspection.hpp"
#include "kinesphere/random.hpp"
#include "kinesphere/world.hpp"

namespace kinesphere::large_round_test {
namespace {

TEST(LargeRound, finds_every_pair_that_touches_at_the_start) {
  constexpr std::uint32_t count = 2500;
  Random random(1);
  std::vector<BodyDefinition> bodies(count);
  for (BodyDefinition& body : bodies) {
    body.radius = 0.5;
    for (int axis = 0; axis < 3; ++axis) body.position[axis] = random.uniform(-9.0, 9.0);
  }
  auto world = World::create({}).value();
  ASSERT_TRUE(world.add_all(bodies));
  std::set<std::pair<std::uint32_t, std::uint32_t>> found;
  const auto at_rest = [&](std::span<const BodyId> ids, double, std::span<State> states) {
    for (std::size_t k = 0; k < ids.size(); ++k) states[k] = {bodies[ids[k].index].position, {}};
  };
  for (;;) {
    const auto event = world.advance(0.0, at_rest);
    ASSERT_TRUE(event);
    if (!*event) break;
    ASSERT_EQ((*event)->kind, EventKind::contact_begin);
    found.insert(std::minmax((*event)->first.index, (*event)->second.index));
  }
  EXPECT_FALSE(world.inspection().audit());
  std::set<std::pair<std::uint32_t, std::uint32_t>> touching;
  for (std::uint32_t a = 0; a < count; ++a)
    for (std::uint32_t b = a + 1; b < count; ++b)
      if (norm_squared(bodies[a].position - bodies[b].position) < 1.0) touching.insert({a, b});
  EXPECT_GT(touching.size(), 1000u);
  EXPECT_EQ(found, touching);
}

/// Enough bodies for memory to be prefetched.
TEST(LargeWorld, can_be_emptied_and_filled_again) {
  constexpr std::uint32_t count = 20000;
  World world = World::create({}).value();
  const auto place_of = [](BodyId id) {
    return Vec3{3.0 * (id.index % 27), 3.0 * (id.index / 27 % 27), 3.0 * (id.index / 729)};
  };
  const auto standing = [&](std::span<const BodyId> ids, double, std::span<State> states) {
    for (std::size_t k = 0; k < ids.size(); ++k) states[k] = {place_of(ids[k]), {}};
  };
  for (int pass = 0; pass < 2; ++pass) {
    // The ids of removed bodies return in another order.
    std::vector<BodyId> ids;
    for (std::uint32_t k = 0; k < count; ++k) ids.push_back(world.add({.acceleration_limit = 1.0}).value());
    for (const BodyId id : ids) ASSERT_TRUE(world.teleport(id, {place_of(id), {}}));
    while (world.size() > 1) {
      ASSERT_FALSE(world.advance(world.time() + 1.0, standing).value());
      const std::size_t checkpoint = world.size() / 2;
      while (world.size() > checkpoint) {
        ASSERT_TRUE(world.remove(ids.back()));
        ids.pop_back();
      }
    }
    ASSERT_FALSE(world.advance(world.time() + 10.0, standing).value());
    ASSERT_TRUE(world.remove(ids.back()));
    ASSERT_FALSE(world.advance(world.time() + 10.0, standing).value());
    EXPECT_FALSE(world.inspection().audit());
  }
}

TEST(Reserve, changes_nothing_but_memory) {
  constexpr std::uint32_t count = 5000;
  World plain = World::create({}).value();
  World roomy = World::create({}).value();
  ASSERT_TRUE(roomy.reserve(count));
  EXPECT_EQ(roomy.size(), 0u);
  EXPECT_GT(roomy.inspection().memory().total(), plain.inspection().memory().total());
  for (std::uint32_t k = 0; k < count; ++k) {
    const BodyDefinition body{.radius = 0.1, .position = {1.0 * k, 0, 0}, .velocity = {0, 1, 0}};
    ASSERT_EQ(plain.add(body).value(), roomy.add(body).value());
  }
  EXPECT_LE(roomy.inspection().memory().bodies, plain.inspection().memory().bodies);
  const auto flying = [](std::span<const BodyId> ids, double time, std::span<State> states) {
    for (std::size_t k = 0; k < ids.size(); ++k) states[k] = {{1.0 * ids[k].index, time, 0}, {0, 1, 0}};
  };
  for (World* world : {&plain, &roomy}) ASSERT_FALSE(world->advance(3.0, flying).value());
  ASSERT_TRUE(plain.reserve(2 * count));
  EXPECT_EQ(plain.save().value(), roomy.save().value());
}

/// Returns bodies with a spacing of 4, `numbers` of them along each axis, after their first searches.
World lattice(int dimensions, const std::array<std::uint32_t, 3>& numbers, double radius) {
  World world = World::create({.dimensions = dimensions}).value();
  std::vector<BodyDefinition> bodies;
  for (std::uint32_t i = 0; i < numbers[0]; ++i)
    for (std::uint32_t j = 0; j < numbers[1]; ++j)
      for (std::uint32_t k = 0; k < numbers[2]; ++k)
        bodies.push_back(
            {.radius = radius, .acceleration_limit = 1.0, .position = {4.0 * i, 4.0 * j, 4.0 * k}});
  EXPECT_TRUE(world.add_all(bodies));
  EXPECT_FALSE(world.advance(0.0, [](auto&&...) { FAIL() << "all reports are fresh"; }).value());
  EXPECT_EQ(world.counters().searches, bodies.size());
  return world;
}

TEST(FirstBoxes, hold_few_others_wherever_bodies_are) {
  const auto candidates = [](int dimensions, const std::array<std::uint32_t, 3>& numbers) {
    const Counters counters = lattice(dimensions, numbers, 1.0).counters();
    return static_cast<double>(counters.candidates) / static_cast<double>(counters.searches);
  };
  EXPECT_LT(candidates(3, {5000, 1, 1}), 3.0);
  EXPECT_LT(candidates(3, {70, 70, 1}), 9.0);
  EXPECT_LT(candidates(3, {17, 17, 17}), 27.0);
  EXPECT_LT(candidates(2, {5000, 1, 1}), 3.0);
  EXPECT_LT(candidates(2, {70, 70, 1}), 9.0);
}

/// The margin in each direction is about a quarter of the distance between bodies, which is 4, however small
/// they are.
TEST(FirstBoxes, leave_room_for_a_part_of_the_distance_between_bodies) {
  const auto margin = [](int dimensions, const std::array<std::uint32_t, 3>& numbers) {
    const World world = lattice(dimensions, numbers, 0.01);
    const BodyView body = world.body({7, 0}).value();
    return body.box.upper.x - body.definition.position.x;
  };
  const std::vector<std::pair<int, std::array<std::uint32_t, 3>>> lattices{
      {3, {5000, 1, 1}}, {3, {70, 70, 1}}, {3, {17, 17, 17}}, {2, {5000, 1, 1}}, {2, {70, 70, 1}}};
  for (const auto& [dimensions, numbers] : lattices) {
    EXPECT_GT(margin(dimensions, numbers), 0.5);
    EXPECT_LT(margin(dimensions, numbers), 2.0);
  }
}

}  // namespace
}  // namespace kinesphere::large_round_test
