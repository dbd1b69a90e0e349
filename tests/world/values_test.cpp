// Public values: equality, and text for people.
#include <gtest/gtest.h>

#include <limits>

#include "kinesphere/kinesphere.hpp"

namespace kinesphere::values_test {
namespace {

TEST(Values, AreEqualIfAllFieldsAre) {
  const Event event{.time = 1.0, .first = {3, 0}, .second = {7, 0}};
  Event other = event;
  EXPECT_EQ(event, other);
  other.second_mass = 2.0;
  EXPECT_NE(event, other);
  EXPECT_EQ(WorldDefinition{}, WorldDefinition{}) << "also with a default, which is NaN";
  EXPECT_NE(WorldDefinition{}, WorldDefinition{.separation_distance = 1.0});
  EXPECT_NE(WorldDefinition{}, WorldDefinition{.dimensions = 2});
  EXPECT_EQ((StaticDefinition{.shape = Ball{{1, 2, 3}, 4}}), (StaticDefinition{.shape = Ball{{1, 2, 3}, 4}}));
  EXPECT_NE((StaticDefinition{.shape = Ball{}}), (StaticDefinition{.shape = Box{}}));
  EXPECT_EQ(BodyDefinition{}, BodyDefinition{});
  EXPECT_NE(BodyDefinition{}, BodyDefinition{.mass = 2});
}

TEST(Text, SaysWhatAValueIs) {
  EXPECT_EQ(to_string(Vec3{0.1, -2, 1e300}), "(0.1, -2, 1e+300)");
  EXPECT_EQ(to_string(State{{1, 2, 3}, {4, 5, 6}}), "(1, 2, 3) moving (4, 5, 6)");
  EXPECT_EQ(to_string(Event{.time = 1.25, .first = {3, 0}, .second = {7, 2}}),
            "contact_begin of 3 and 7 (generation 2) at time 1.25");
  EXPECT_EQ(
      to_string(Event{.kind = EventKind::wall_end, .time = 0.1, .first = {3, 0}, .wall = Wall::z_lower}),
      "wall_end of 3 at z_lower at time 0.1");
  EXPECT_EQ(
      to_string(Event{.kind = EventKind::sensor_enter, .first = {3, 0}, .second = {4, 0}, .distance = 5}),
      "sensor_enter of 3 and 4 at distance 5 at time 0");
  EXPECT_EQ(to_string(OverlapHit{{7, 0}, Certainty::possibly}), "body 7, certainty possibly");
  EXPECT_EQ(to_string(SafeTime{std::numeric_limits<double>::infinity(), false, true}),
            "time inf, touching false, probed true");
  EXPECT_EQ(to_string(Shape(Ball{{1, 2, 3}, 4})), "ball: centre (1, 2, 3), radius 4");
  EXPECT_EQ(to_string(Response{.first_velocity = Vec3{1, 0, 0}, .second_action = BodyAction::remove}),
            "first_velocity (1, 0, 0), second_velocity none, first_action none, second_action remove, "
            "stop false");
  EXPECT_EQ(to_string(MonitorEvent{.time = 2, .first = 5, .second = 6, .verdict = Verdict::within}),
            "verdict of 5 and 6 at level 0: within at time 2");
}

}  // namespace
}  // namespace kinesphere::values_test
