// Many bodies that are settled at once, with numbers that say nothing about where they are.
#include <gtest/gtest.h>

#include <set>
#include <utility>
#include <vector>

#include "kinesphere/random.hpp"
#include "kinesphere/world.hpp"

namespace kinesphere {
namespace {

TEST(LargeRound, finds_every_pair_that_touches_at_the_start) {
  constexpr std::uint32_t count = 6000;  // more than are settled in the order of their numbers
  Random random(1);
  std::vector<BodyDefinition> bodies(count);
  for (BodyDefinition& body : bodies) {
    body.radius = 0.5;
    for (int axis = 0; axis < 3; ++axis) body.position[axis] = random.uniform(-12.0, 12.0);
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
  EXPECT_FALSE(world.audit());
  std::set<std::pair<std::uint32_t, std::uint32_t>> touching;
  for (std::uint32_t a = 0; a < count; ++a)
    for (std::uint32_t b = a + 1; b < count; ++b)
      if (norm_squared(bodies[a].position - bodies[b].position) < 1.0) touching.insert({a, b});
  EXPECT_GT(touching.size(), 1000u);
  EXPECT_EQ(found, touching);
}

}  // namespace
}  // namespace kinesphere
