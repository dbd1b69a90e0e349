// Bodies in a box: all that are there, wherever changes have put them.
#include "processor/bodies_in.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "kinesphere/random.hpp"
#include "support/small_world.hpp"

namespace kinesphere::bodies_in_test {
namespace {

TEST(BodiesIn, AreAllThatAreInTheBoxInOrder) {
  constexpr std::uint64_t seed = 5206;
  SCOPED_TRACE(seed);
  Random random(seed);
  SmallWorld world;
  for (int k = 0; k < 60; ++k)
    world.add({.radius = 0.2 * random.uniform(),
               .acceleration_limit = 0.1,
               .position = 3.0 * random.point_in_ball(),
               .velocity = random.point_in_ball()});
  for (double time = 0.0; time < 2.0; time += 0.25) {
    (void)world.advance_all(time);
    ASSERT_TRUE(world.main.recertify());
    // One body is elsewhere at once, and not certified yet.
    const auto moved = static_cast<std::uint32_t>(random.bits() % 60);
    world.state.bodies[moved].bound = {.time = time, .position = 3.0 * random.point_in_ball(), .radius = 0.1};
    world.origins[moved] = {time, {world.state.bodies[moved].bound.position, {}}};
    world.main.invalidate(moved);
    const Vec3 corner = 3.0 * random.point_in_ball();
    const Box box{corner, corner + Vec3{1.0, 1.5, 2.0}};
    const auto found = bodies_in(box, world.state, world.main.dirty());
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
    EXPECT_EQ(std::adjacent_find(found.begin(), found.end()), found.end()) << "each once";
    EXPECT_LT(found.size(), 60u);
    for (std::uint32_t number = 0; number < 60; ++number) {
      const double distance = nearest_point(box, world.state_of(number, time).position).distance;
      if (distance < world.state.bodies[number].radius) {
        EXPECT_TRUE(std::binary_search(found.begin(), found.end(), number)) << number << " at " << time;
      }
    }
  }
}

}  // namespace
}  // namespace kinesphere::bodies_in_test
