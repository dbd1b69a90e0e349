// Rigid bodies and rotations that may not be are refused by name.
#include <gtest/gtest.h>

#include "bodies/validation.hpp"
#include "number/infinity.hpp"
#include "support/expect_error.hpp"

namespace kinesphere::rigid_validation_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
const WorldDefinition space{};
const WorldDefinition plane{.dimensions = 2};

RigidBody rod() { return {.parts = {{{-1, 0, 0}, {1, 0, 0}, 0.5}}, .inertia = {1, 2, 2}}; }

TEST(RigidValidation, AcceptsARod) {
  EXPECT_TRUE(check_rigid_body(rod(), space, "add"));
  EXPECT_TRUE(check_rigid_body(rod(), plane, "add"));
}

TEST(RigidValidation, NamesWhatIsWrong) {
  const auto refuse = [](auto spoil, const std::string& argument, ErrorCode code = ErrorCode::out_of_range,
                         const WorldDefinition& world = space) {
    RigidBody body = rod();
    spoil(body);
    expect_error(check_rigid_body(body, world, "add"), code, argument, "add: ");
  };
  refuse([](RigidBody& b) { b.parts.clear(); }, "parts");
  refuse([](RigidBody& b) { b.parts[0].radius = -1.0; }, "parts");
  refuse([](RigidBody& b) { b.parts[0].b.x = nan; }, "parts", ErrorCode::not_finite);
  refuse([](RigidBody& b) { b.parts[0].more.assign(limits::most_hull_points - 1, Vec3{}); }, "parts");
  refuse([](RigidBody& b) { b.parts[0].a.z = 1.0; }, "parts", ErrorCode::out_of_range, plane);
  refuse([](RigidBody& b) { b.rotation.orientation.w = 1.1; }, "rotation");
  refuse([](RigidBody& b) { b.rotation.angular_velocity.x = infinity; }, "rotation", ErrorCode::not_finite);
  refuse([](RigidBody& b) { b.rotation.angular_velocity.x = 1.0; }, "rotation", ErrorCode::out_of_range,
         plane);
  refuse([](RigidBody& b) { b.angular_acceleration_limit = 1.0; }, "largest_angular_speed");
  refuse([](RigidBody& b) { b.largest_angular_speed = 1.0, b.rotation.angular_velocity.z = 2.0; },
         "rotation");
  refuse([](RigidBody& b) { b.inertia.y = -1.0; }, "inertia");
}

TEST(RigidValidation, NamesTheBodyOfARotation) {
  EXPECT_TRUE(check_rotation({rotation_by({1, 2, 3}), {4, 5, 6}}, {7, 0}, space, "advance"));
  expect_error(check_rotation(no_rotation, {7, 0}, space, "advance"), ErrorCode::not_finite, "rotation",
               "advance: ", {7, 0});
}

}  // namespace
}  // namespace kinesphere::rigid_validation_test
