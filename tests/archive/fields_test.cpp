// Public structs are read as they were written, each field in its place.
#include "archive/fields.hpp"

#include <gtest/gtest.h>

#include "kinesphere/kinesphere.hpp"
#include "support/read_back.hpp"

namespace kinesphere::fields_test {
namespace {

template <class T>
void expect_read_back(const T& value) {
  T back{};
  ASSERT_TRUE(read_back(value, back));
  EXPECT_EQ(back, value);
}

TEST(Fields, AreReadAsTheyWereWritten) {
  const Vec3 a{1, 2, 3}, b{4, 5, 6}, c{7, 8, 9};
  expect_read_back(a);
  expect_read_back(Box{a, b});
  expect_read_back(State{a, b});
  expect_read_back(MotionOrigin{1.5, {a, b}});
  expect_read_back(Filter{.category = 1, .mask = 2, .group = -3});
  expect_read_back(Sensor{.distances = {1.0, 2.0}, .mask = 9});
  expect_read_back(MotionLimits{1.0, a, 2.0, 3.0});
  expect_read_back(Bound{1.0, a, b, c, 2.0, 3.0, 4.0});
  expect_read_back(HalfSpace{a, 2.0});
  expect_read_back(Ball{a, 2.0});
  expect_read_back(Triangle{a, b, c});
  expect_read_back(Mesh{});
  const std::array vertices{a, b, Vec3{0, 0, 1}, Vec3{5, 5, 5}};
  const std::array<std::array<std::uint32_t, 3>, 2> corners{{{0, 1, 2}, {2, 1, 0}}};
  const Mesh mesh = Mesh::create(vertices, corners).value();
  expect_read_back(mesh);
  expect_read_back(Shape(mesh));
  expect_read_back(Rotation{{0.5, 0.5, 0.5, 0.5}, a});
  expect_read_back(RigidPart{a, b, 2.0, {c, a}});
  expect_read_back(Axes{.x = true, .z = true});
  const BodyDefinition body{.radius = 1.5,
                            .acceleration_limit = 2.5,
                            .planned_acceleration = a,
                            .position_error = 0.5,
                            .velocity_error = 0.25,
                            .position = b,
                            .velocity = c,
                            .filter = {.category = 4},
                            .solid = false,
                            .contacts = ContactEvents::impacts,
                            .sensor_class = 7,
                            .user_data = 8,
                            .mass = 9.5,
                            .radius_rate = 0.125};
  expect_read_back(body);
  expect_read_back(MovingShape{body, Box{a, b}});
  expect_read_back(StaticDefinition{.shape = Triangle{a, b, c}, .sensor_class = 3, .user_data = 4});
  expect_read_back(RigidBody{.body = body,
                             .parts = {{a, b, 1.0}},
                             .angular_acceleration_limit = 2.0,
                             .largest_angular_speed = 3.0,
                             .inertia = c});
  expect_read_back(WorldDefinition{.box = Box{a, b},
                                   .periodic = {.y = true},
                                   .wall_filter = Filter{.category = 8},
                                   .dimensions = 2,
                                   .contact_tolerance = 1e-3,
                                   .zeno_interval = 0.5,
                                   .start_time = 6.0,
                                   .spread_window_starts = true,
                                   .adopt_observed_limits = false});
}

TEST(Fields, LeaveOutTheWorldOfAnId) {
  BodyId back;
  ASSERT_TRUE(read_back(BodyId{4, 5, 6}, back));
  EXPECT_EQ(back.index, 4u);
  EXPECT_EQ(back.generation, 5u);
  EXPECT_EQ(back.world, 0u);
}

TEST(Fields, OfAnEventAreAllThere) {
  Event event{.kind = EventKind::sensor_leave, .time = 1.0, .first = {1, 2}, .second = {3, 4}};
  event.senses = Senses::both;
  event.second_state = {{1, 2, 3}, {4, 5, 6}};
  event.distance = 7.0;
  event.second_spin_gain = {8, 9, 10};
  Event back;
  ASSERT_TRUE(read_back(event, back));
  EXPECT_EQ(back.kind, event.kind);
  EXPECT_EQ(back.second, event.second);
  EXPECT_EQ(back.senses, event.senses);
  EXPECT_EQ(back.second_state, event.second_state);
  EXPECT_EQ(back.distance, event.distance);
  EXPECT_EQ(back.second_spin_gain, event.second_spin_gain);
}

}  // namespace
}  // namespace kinesphere::fields_test
