// Calls about sensors and static bodies with ids of removed bodies, and in spaces that have no room for them.
#include <gtest/gtest.h>

#include "kinesphere/recording.hpp"
#include "kinesphere/response.hpp"
#include "support/expect_error.hpp"
#include "support/playground.hpp"

namespace kinesphere::wrong_sensors_and_shapes_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(WrongIdOfAStaticBody, IsStaleEverywhere) {
  World world = World::create({}).value();
  const BodyId gone = world.add_static({.shape = Ball{}}).value();
  world.remove(gone).value();
  const auto stale = [&](const auto& result, const std::string& call) {
    expect_error(result, ErrorCode::stale_body, "body", call, gone);
  };
  stale(world.touching(gone), "touching");
  stale(world.sensor_overlaps(gone), "sensor_overlaps");
  stale(world.change(gone, {.solid = false}), "change");
  stale(world.change(gone, {.sensor_class = 1}), "change");
  stale(world.set_velocity(gone, {}), "set_velocity");
  stale(world.teleport(gone, {}), "teleport");
  stale(world.change(gone, {.radius = 1}), "change");
  stale(world.change(gone, {.motion_limits = MotionLimits{}}), "change");
  stale(world.disable(gone), "disable");
  stale(world.enable(gone, {}), "enable");
}

TEST(WrongStaticBody, HasToFitWhereSpaceRepeats) {
  World world = World::create({.box = Box{{0, 0, 0}, {10, 10, 10}}, .periodic = {true, true, true}}).value();
  for (const Shape& shape : {Shape(HalfSpace{{0, 0, 1}, 0}), Shape(Box{{1, 1, 1}, {2, 2, 2}}),
                             Shape(Triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})})
    expect_error(world.add_static({.shape = shape}), ErrorCode::unsupported, "shape", "add_static");
  expect_error(world.add_static({.shape = Ball{{1, 1, 1}, 1.9}}), ErrorCode::out_of_range, "shape",
               "add_static");
  EXPECT_EQ(world.size(), 0u);
}

TEST(WrongSensor, HasToFitWhereSpaceRepeats) {
  World world = World::create({.box = Box{{0, 0, 0}, {10, 10, 10}}, .periodic = {true, true, true}}).value();
  const BodyId ball = world.add({.radius = 1, .position = {5, 5, 5}, .sensor_class = 1}).value();
  const BodyId fixed = world.add_static({.shape = Ball{{1, 1, 1}, 1}, .sensor_class = 2}).value();
  expect_error(world.set_sensor(1, {.distances = {0.5, 1.0}}), ErrorCode::out_of_range, "sensor",
               "set_sensor", ball);
  expect_error(world.set_sensor(2, {.distances = {1.0}}), ErrorCode::out_of_range, "sensor", "set_sensor",
               fixed);
  EXPECT_TRUE(world.sensor(1).distances.empty());
  world.set_sensor(3, {.distances = {1.0}}).value();
  expect_error(world.change(ball, {.sensor_class = 3}), ErrorCode::out_of_range, "sensor_class", "change",
               ball);
  expect_error(world.change(fixed, {.sensor_class = 3}), ErrorCode::out_of_range, "sensor_class", "change",
               fixed);
  expect_error(world.add({.radius = 1, .position = {8, 5, 5}, .sensor_class = 3}), ErrorCode::out_of_range,
               "sensor_class", "add");
  world.disable(ball).value();
  expect_error(world.set_sensor(1, {.distances = {1.0}}), ErrorCode::out_of_range, "sensor", "set_sensor",
               ball);
  EXPECT_TRUE(is_clean(world));
}

TEST(WrongStaticBody, HasToLieInThePlane) {
  World world = World::create({.dimensions = 2}).value();
  expect_error(world.add_static({.shape = Triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}), ErrorCode::unsupported,
               "shape", "add_static");
  const std::array<Vec3, 3> vertices{Vec3{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::array<std::array<std::uint32_t, 3>, 1> corners{{{0, 1, 2}}};
  expect_error(world.add_static({.shape = Mesh::create(vertices, corners).value()}), ErrorCode::unsupported,
               "shape", "add_static");
  expect_error(world.add_static({.shape = Ball{{0, 0, 1}, 1}}), ErrorCode::out_of_range, "shape",
               "add_static");
  expect_error(world.add_static({.shape = HalfSpace{{0, 0, 1}, 0}}), ErrorCode::out_of_range, "shape",
               "add_static");
  EXPECT_EQ(world.size(), 0u);
}

/// bounce() and settle() cannot return errors: the call that sets the velocity has to refuse their results
/// for NaNs.
TEST(WrongBounce, IsRefusedWhereTheVelocityIsSet) {
  World world = World::create({}).value();
  const BodyId id = world.add({}).value();
  const Event contact{.second = {1, 0}, .normal = {1, 0, 0}, .approach_speed = 1};
  for (const Bounce& wrong :
       {bounce(contact, nan, 1, 1), bounce(contact, 1, 1, nan), settle(contact, 1, 1, nan, 1)})
    expect_error(world.set_velocity(id, wrong.first_velocity), ErrorCode::not_finite, "velocity",
                 "set_velocity", id);
  EXPECT_TRUE(std::isnan(least_resting_speed(-1, 1)));
}

}  // namespace
}  // namespace kinesphere::wrong_sensors_and_shapes_test
