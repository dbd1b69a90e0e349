// Events with numbers in place of ids: everything of the two bodies changes places with them.
#include "simulation/detector/numbered_event.hpp"

#include <gtest/gtest.h>

namespace kinesphere::numbered_event_test {
namespace {

Event sensed_by(Senses senses) {
  return {.kind = EventKind::sensor_enter,
          .first = {0, 4},
          .second = {1, 7},
          .senses = senses,
          .first_traits = {.is_zone = true},
          .first_state = {{1, 0, 0}, {}},
          .second_state = {{0, 2, 0}, {}},
          .normal = {0, 0, 1},
          .first_user_data = 11,
          .second_user_data = 22,
          .first_mass = 3,
          .second_mass = 5};
}

TEST(NumberedEvent, KeepsTheOrderOfNumbersThatIdsHave) {
  Event event = sensed_by(Senses::first);
  number_bodies(event, [](BodyId id) { return id.index + 10; });
  EXPECT_EQ(event.first, (BodyId{10, 0}));
  EXPECT_EQ(event.second, (BodyId{11, 0}));
  EXPECT_EQ(event.senses, Senses::first);
  EXPECT_EQ(event.first_mass, 3);
}

TEST(NumberedEvent, SwapsAllOfTheTwoBodies) {
  for (const auto& [senses, swapped] :
       {std::pair(Senses::first, Senses::second), std::pair(Senses::second, Senses::first),
        std::pair(Senses::both, Senses::both), std::pair(Senses::neither, Senses::neither)}) {
    Event event = sensed_by(senses);
    number_bodies(event, [](BodyId id) { return 10 - id.index; });
    EXPECT_EQ(event.first, (BodyId{9, 0}));
    EXPECT_EQ(event.second, (BodyId{10, 0}));
    EXPECT_EQ(event.senses, swapped);
    EXPECT_TRUE(event.second_traits.is_zone && !event.first_traits.is_zone);
    EXPECT_EQ(event.first_state.position, (Vec3{0, 2, 0}));
    EXPECT_EQ(event.second_state.position, (Vec3{1, 0, 0}));
    EXPECT_EQ(event.normal, (Vec3{0, 0, -1}));
    EXPECT_EQ(event.first_user_data, 22u);
    EXPECT_EQ(event.second_user_data, 11u);
    EXPECT_EQ(event.first_mass, 5);
    EXPECT_EQ(event.second_mass, 3);
  }
}

TEST(NumberedEvent, OfAWallHasOneBody) {
  Event event{.kind = EventKind::wall_begin, .first = {3, 1}, .wall = Wall::x_lower};
  number_bodies(event, [](BodyId id) { return id.index + 1; });
  EXPECT_EQ(event.first, (BodyId{4, 0}));
  EXPECT_EQ(event.second, no_body);
}

}  // namespace
}  // namespace kinesphere::numbered_event_test
