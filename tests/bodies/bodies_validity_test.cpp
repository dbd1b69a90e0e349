// Bodies that no sequence of calls could have produced are found, and named by their part.
#include <gtest/gtest.h>

#include <functional>

#include "bodies/shaped_body.hpp"
#include "number/infinity.hpp"
#include "support/small_world.hpp"

namespace kinesphere::bodies_validity_test {
namespace {

constexpr double now = 2.0;

/// A ball, a static box, a rigid body and a removed body.
Bodies some_bodies() {
  Bodies bodies{WorldDefinition{}};
  const auto add = [&](const BodyDefinition& body) {
    const std::uint32_t number = bodies.add(body, now);
    bodies[number].bound = bound_now(body, now);
    return number;
  };
  add({.radius = 0.5, .acceleration_limit = 1.0, .velocity = {1, 0, 0}});
  const StaticDefinition wall{.shape = Box{{5, 5, 5}, {6, 6, 6}}};
  bodies.give_shape(add(body_of(wall)), wall.shape, false);
  const RigidBody rod{.parts = {{{-1, 0, 0}, {1, 0, 0}, 0.5}}};
  bodies.make_rigid(add(body_of(rod)), record_of(rod, now));
  bodies.remove(add({}));
  return bodies;
}

TEST(BodiesValidity, AcceptsWhatCallsProduce) {
  const Bodies bodies = some_bodies();
  EXPECT_EQ(bodies.first_invalid_part(now, {}), nullptr);
  EXPECT_NE(bodies.first_invalid_part(now - 1.0, {}), nullptr) << "reports from the future";
}

TEST(BodiesValidity, FindsEachContradiction) {
  struct Damage {
    const char* what;
    std::function<void(Bodies&)> damage;
    const char* part = "bodies";
  };
  const Damage damages[] = {
      {"NaN", [](Bodies& b) { b[0].bound.position.x = std::numeric_limits<double>::quiet_NaN(); }},
      {"negative limit", [](Bodies& b) { b[0].bound.acceleration_limit = -1.0; }},
      {"bound smaller than the body", [](Bodies& b) { b[0].bound.radius = 0.25; }},
      {"dirty, but not listed", [](Bodies& b) { b[0].dirty = true; }},
      {"dirty though disabled", [](Bodies& b) { b[0].enabled = false, b[0].dirty = true; }},
      {"a change without a report to come", [](Bodies& b) { b.change_of(0); }},
      {"a free number that lives", [](Bodies& b) { b[3].alive = true; }},
      {"a static body that moves", [](Bodies& b) { b[1].bound.velocity.x = 1.0; }},
      {"a shape of another body", [](Bodies& b) { b[0].shape_number = 0; }, "shapes"},
      {"a record of nobody", [](Bodies& b) { b[2].is_rigid = false, b[2].shape_number = Body::none; },
       "shapes"},
      {"a rigid body of another size", [](Bodies& b) { b[2].radius = 9.0, b[2].bound.radius = 9.0; }},
      {"a rotation that is none",
       [](Bodies& b) {
         b.rigid[b[2]].rotation.orientation = {2, 0, 0, 0};
       }},
      {"a sensor without end", [](Bodies& b) { b.sensors.set(0, {.distances = {infinity}}); }, "sensors"},
  };
  for (const Damage& one : damages) {
    Bodies bodies = some_bodies();
    one.damage(bodies);
    const char* const found = bodies.first_invalid_part(now, {});
    ASSERT_NE(found, nullptr) << one.what;
    EXPECT_STREQ(found, one.part) << one.what;
  }
}

TEST(BodiesValidity, AcceptsDirtyBodiesThatAreListed) {
  Bodies bodies = some_bodies();
  bodies[0].dirty = true;
  EXPECT_EQ(bodies.first_invalid_part(now, {0}), nullptr);
  EXPECT_NE(bodies.first_invalid_part(now, {0, 99}), nullptr) << "a number of nobody";
}

}  // namespace
}  // namespace kinesphere::bodies_validity_test
