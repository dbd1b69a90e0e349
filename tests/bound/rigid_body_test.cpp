// Rotations as quaternions against rotations as matrices, and what impulses do to rigid bodies.
#include "kinesphere/rigid_body.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "bound/rigid_part.hpp"
#include "bound/rigid_record.hpp"
#include "kinesphere/random.hpp"
#include "number/infinity.hpp"

namespace kinesphere::rigid_body_test {
namespace {

constexpr std::uint64_t seed = 4104;

/// Turns a vector by the formula of Rodrigues.
Vec3 turned(const Vec3& turn, const Vec3& vector) {
  const double angle = norm(turn);
  if (angle == 0.0) return vector;
  const Vec3 axis = turn / angle;
  return vector * std::cos(angle) + cross(axis, vector) * std::sin(angle) +
         axis * (dot(axis, vector) * (1.0 - std::cos(angle)));
}

TEST(Rotations, AreThoseOfRodrigues) {
  SCOPED_TRACE(seed);
  Random random(seed);
  for (int k = 0; k < 2000; ++k) {
    const Vec3 first = 4.0 * random.point_in_ball();
    const Vec3 second = 4.0 * random.point_in_ball();
    const Vec3 vector = random.point_in_ball();
    const Quaternion one = rotation_by(first);
    const Quaternion both = after(rotation_by(second), one);
    EXPECT_NEAR(norm(rotated(one, vector) - turned(first, vector)), 0.0, 1e-14);
    EXPECT_NEAR(norm(rotated(both, vector) - turned(second, turned(first, vector))), 0.0, 1e-14);
    EXPECT_NEAR(norm(rotated_back(both, rotated(both, vector)) - vector), 0.0, 1e-14);
    const double length = both.w * both.w + both.x * both.x + both.y * both.y + both.z * both.z;
    EXPECT_NEAR(length, 1.0, 1e-15);
    const double angle = std::remainder(norm(second), 2.0 * std::numbers::pi);
    EXPECT_NEAR(angle_between(one, both), std::abs(angle), 1e-13);
  }
  EXPECT_EQ(rotation_by({}), Quaternion{});
}

TEST(RigidParts, OfABoxAreItsCorners) {
  EXPECT_EQ(point_count(box_part({{-1, -2, -3}, {1, 2, 3}}, 0.0)), 8u);
  EXPECT_EQ(point_count(box_part({{-1, -2, 0}, {1, 2, 0}}, 0.0)), 4u) << "flat";
  const RigidPart rod = box_part({{-1, 0, 0}, {1, 0, 0}}, 0.5);
  EXPECT_EQ(rod, (RigidPart{{-1, 0, 0}, {1, 0, 0}, 0.5}));
  EXPECT_TRUE(std::isnan(hull_part({}, 1.0).a.x)) << "no hull: refused wherever it is used";
}

TEST(SpinGain, IsTheTorqueOfAUnitImpulseOverTheInertia) {
  SCOPED_TRACE(seed);
  Random random(seed);
  for (int k = 0; k < 500; ++k) {
    RigidRecord record;
    const Vec3 turn = 3.0 * random.point_in_ball();
    record.rotation.orientation = rotation_by(turn);
    record.inertia = {1.0 + random.uniform(), 2.0 + random.uniform(), 3.0 + random.uniform()};
    const Vec3 arm = random.point_in_ball();
    const Vec3 direction = random.unit_vector();
    Vec3 expected;
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 principal;
      principal[axis] = 1.0;
      principal = turned(turn, principal);
      expected += principal * (dot(principal, cross(arm, direction)) / record.inertia[axis]);
    }
    EXPECT_NEAR(norm(record.spin_gain(record.rotation.orientation, arm, direction) - expected), 0.0, 1e-14);
  }
  RigidRecord stiff;
  stiff.inertia = {0.0, infinity, 2.0};
  EXPECT_EQ(stiff.spin_gain({}, {1, 1, 1}, {1, 0, 0}).x, 0.0) << "no inertia: does not turn about x";
  EXPECT_EQ(stiff.spin_gain({}, {1, 1, 1}, {1, 0, 0}).y, 0.0);
  EXPECT_EQ(stiff.spin_gain({}, {1, 1, 1}, {1, 0, 0}).z, -0.5);
}

}  // namespace
}  // namespace kinesphere::rigid_body_test
