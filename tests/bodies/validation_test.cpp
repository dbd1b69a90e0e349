// Each check accepts what may be, and names the argument that may not.
#include "bodies/validation.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "number/infinity.hpp"
#include "support/expect_error.hpp"

namespace kinesphere::validation_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
const WorldDefinition space{};
const WorldDefinition plane{.dimensions = 2};
const WorldDefinition boxed{.box = Box{{0, 0, 0}, {10, 10, 10}}, .allow_overlap = false};
const WorldDefinition repeating{.box = Box{{0, 0, 0}, {10, 10, 10}}, .periodic = {.x = true}};

TEST(Validation, OfWorldsNamesTheField) {
  EXPECT_TRUE(check_world(space) && check_world(plane) && check_world(boxed) && check_world(repeating));
  const auto refuse = [](const WorldDefinition& world, const std::string& argument,
                         ErrorCode code = ErrorCode::out_of_range) {
    expect_error(check_world(world), code, argument, "World::create: ");
  };
  refuse({.contact_tolerance = 0.0}, "contact_tolerance");
  refuse({.contact_tolerance = nan}, "contact_tolerance", ErrorCode::not_finite);
  refuse({.separation_distance = 1e-6}, "separation_distance");
  refuse({.dimensions = 4}, "dimensions");
  refuse({.zeno_interval = -1.0}, "zeno_interval");
  refuse({.start_time = infinity}, "start_time", ErrorCode::not_finite);
  refuse({.box = Box{{0, 0, 0}, {1, -1, 1}}}, "box");
  refuse({.periodic = {.x = true}}, "periodic");
  refuse({.box = Box{{0, 0, 0}, {1, 1, 1}}, .periodic = {.z = true}, .dimensions = 2}, "periodic");
  refuse({.box = Box{{0, 0, 0}, {1e9, 1, 1}}, .contact_tolerance = 1e-9}, "contact_tolerance");
  refuse({.box = Box{{0, 0, 0}, {1e-5, 1, 1}}, .periodic = {.x = true}}, "box");
}

TEST(Validation, OfBodiesNamesTheField) {
  struct Wrong {
    std::function<void(BodyDefinition&)> spoil;
    std::string argument;
    WorldDefinition world = space;
    ErrorCode code = ErrorCode::out_of_range;
  };
  const Wrong all[] = {
      {[](BodyDefinition& b) { b.radius = -1.0; }, "radius"},
      {[](BodyDefinition& b) { b.radius = 1e30; }, "radius"},
      {[](BodyDefinition& b) { b.acceleration_limit = -1.0; }, "acceleration_limit"},
      {[](BodyDefinition& b) { b.position_error = nan; }, "position_error", space, ErrorCode::not_finite},
      {[](BodyDefinition& b) { b.velocity_error = 1e101; }, "velocity_error"},
      {[](BodyDefinition& b) { b.planned_acceleration.y = nan; }, "planned_acceleration", space,
       ErrorCode::not_finite},
      {[](BodyDefinition& b) { b.position.x = 1e30; }, "position"},
      {[](BodyDefinition& b) { b.velocity.z = 1.0; }, "velocity", plane},
      {[](BodyDefinition& b) { b.position.x = 9.5; }, "position", boxed, ErrorCode::outside_domain},
      {[](BodyDefinition& b) { b.radius = 2.0; }, "radius", repeating},
      {[](BodyDefinition& b) { b.mass = -1.0; }, "mass"},
      {[](BodyDefinition& b) { b.radius_rate = infinity; }, "radius_rate", space, ErrorCode::not_finite},
      {[](BodyDefinition& b) { b.contacts = static_cast<ContactEvents>(9); }, "contacts"},
  };
  for (const Wrong& wrong : all) {
    BodyDefinition body{.position = {5, 5, 0}};
    if (wrong.world.dimensions == 3) body.position.z = 5;
    ASSERT_TRUE(check_body(body, wrong.world, "add")) << wrong.argument;
    wrong.spoil(body);
    expect_error(check_body(body, wrong.world, "add"), wrong.code, wrong.argument, "add: ");
  }
}

TEST(Validation, OfShapesKnowsWhereTheyMayBe) {
  const Shape box = Box{{1, 1, 1}, {2, 2, 2}}, ball = Ball{{1, 1, 1}, 0.5};
  const Shape triangle = Triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_TRUE(check_shape(box, space, "add") && check_shape(triangle, space, "add"));
  EXPECT_TRUE(check_shape(HalfSpace{{0, 0, 1}, 2.0}, space, "add") && check_shape(ball, repeating, "add"));
  expect_error(check_shape(box, repeating, "add"), ErrorCode::unsupported, "shape", "add: ");
  expect_error(check_shape(triangle, plane, "add"), ErrorCode::unsupported, "shape", "add: ");
  expect_error(check_shape(HalfSpace{{0, 0, 2}, 0.0}, space, "add"), ErrorCode::out_of_range, "shape",
               "add: ");
  expect_error(check_shape(Box{{1, 1, 1}, {0, 2, 2}}, space, "add"), ErrorCode::out_of_range, "shape",
               "add: ");
  expect_error(check_shape(Triangle{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, space, "add"), ErrorCode::out_of_range,
               "shape", "add: ");
  EXPECT_TRUE(check_carried_shape(box, space, "add"));
  expect_error(check_carried_shape(ball, space, "add"), ErrorCode::unsupported, "shape", "add: ");
  expect_error(check_carried_shape(box, repeating, "add"), ErrorCode::unsupported, "shape", "add: ");
}

TEST(Validation, OfReportsAgreesWithItsQuickForm) {
  const BodyId body{3, 0};
  for (const double x : {0.0, 1e6, 3e6, nan, infinity})
    for (const double z : {0.0, 1.0})
      for (const WorldDefinition& world : {space, plane}) {
        const State state{{x, 0, z}, {0, 0, z}};
        EXPECT_EQ(static_cast<bool>(check_report(state, body, 2.0, world)), is_valid_report(state, world));
      }
  EXPECT_FALSE(is_valid_report(no_answer, space)) << "an answer that was not given";
  expect_error(check_velocity({nan, 0, 0}, body, space, "set"), ErrorCode::not_finite, "velocity",
               "set: ", body);
}

TEST(Validation, OfTimesAndLengths) {
  EXPECT_TRUE(check_time(3.0, 3.0, {}));
  expect_error(check_time(2.0, 3.0, {}), ErrorCode::time_backwards, "until", "advance: ");
  expect_error(check_time(1e31, 3.0, {}), ErrorCode::out_of_range, "until", "advance: ");
  expect_error(check_time(nan, 3.0, {}), ErrorCode::not_finite, "until", "advance: ");
  InputCheck check("near");
  EXPECT_TRUE(require_length(check, "distance", 1.0, space).result());
  EXPECT_FALSE(require_length(check, "distance", -1.0, space).result());
}

TEST(Validation, TakesTheFirstError) {
  const Result<void> one = Error{ErrorCode::moved_from, "one"}, two = Error{ErrorCode::moved_from, "two"};
  EXPECT_TRUE(first_error(Result<void>(), Result<void>()));
  EXPECT_EQ(first_error(Result<void>(), one, two).error().argument, "one");
}

}  // namespace
}  // namespace kinesphere::validation_test
