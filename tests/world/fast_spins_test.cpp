// Bodies that turn so fast that checks of each turn would never come to an end.
#include <gtest/gtest.h>

#include "support/expect_error.hpp"
#include "support/playground.hpp"

namespace kinesphere::fast_spins_test {
namespace {

RigidBody rod(const Vec3& position, double spin) {
  return {.body = {.position = position},
          .parts = {{{-1, 0, 0}, {1, 0, 0}, 0.1}},
          .rotation = {.angular_velocity = {0, 0, spin}}};
}

/// Each spin gives the same events.
TEST(FastSpins, AreCheckedNoMoreOftenThanSlowOnes) {
  for (const double spin : {1e4, 1e8, 1e12, 1e99}) {
    SCOPED_TRACE(spin);
    Playground p({.box = Box{{-5, -5, -0.2}, {5, 5, 9}}});
    p.add_rigid_body(rod({}, spin));
    p.add_rigid_body(rod({0.5, 0.5, 0.4}, -spin));
    const BodyId waits = p.add({.radius = 0.1, .position = {-0.9, 0, 0.25}});
    const BodyId falls = p.add({.radius = 0.1, .position = {0, 0, 3.6}, .velocity = {0, 0, -1}});
    const auto event = p.advance(4.0);
    ASSERT_TRUE(event);
    EXPECT_EQ(event->second, falls);
    EXPECT_NEAR(event->time, 3.0, 1e-3);
    EXPECT_LT(p.world.counters().pair_checks, 2000u);
    EXPECT_TRUE(p.world.touching(waits)->empty());
    EXPECT_TRUE(is_clean(p.world));
  }
}

TEST(FastSpins, StandOnWhatTheyTurnUpon) {
  Playground p({.box = Box{{-5, -5, 0}, {5, 5, 9}}});
  p.add_rigid_body({.body = {.position = {0, 0, 1.1}},
                    .parts = {{{0, 0, -1}, {0, 0, 1}, 0.1}},
                    .rotation = {.angular_velocity = {0, 0, 1e12}}});
  EXPECT_EQ(p.run(100.0).size(), 1u);
  EXPECT_LT(p.world.counters().wall_checks, 200u);
}

/// A ball between those of a dumbbell is within the hull of its turns, and yet never touched.
TEST(FastSpins, AreNamedWhereTheyKeepTimeFromGoingOn) {
  Playground p;
  const BodyId dumbbell =
      p.add_rigid_body({.parts = {{{-1, 0, 0}, {-1, 0, 0}, 0.1}, {{1, 0, 0}, {1, 0, 0}, 0.1}},
                        .rotation = {.angular_velocity = {0, 0, 1e12}}});
  p.add({.radius = 0.1});
  expect_error(p.world.advance(1e3, p.probe()), ErrorCode::out_of_range, "angular_velocity",
               "advance: angular_velocity of body 0 must let time reach 1e+03, but is 1e+12", dumbbell);
}

}  // namespace
}  // namespace kinesphere::fast_spins_test
