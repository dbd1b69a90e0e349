// The circulation of the paper's section 4.3, and bodies that follow a field.
#include "kinesphere/motion/velocity_field.hpp"

#include <gtest/gtest.h>

#include "kinesphere/random.hpp"

namespace kinesphere::velocity_field_test {
namespace {

const Box box{{0, -50, 10}, {200, 50, 90}};
const Circulation circulation{box, 30.0};
const Vec3 middle = 0.5 * (box.lower + box.upper);

TEST(Circulation, HasNoDivergence) {
  Random random(1);
  const double step = 1e-4;
  for (int k = 0; k < 1000; ++k) {
    Vec3 position;
    double divergence = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      position[axis] = random.uniform(box.lower[axis] + 1, box.upper[axis] - 1);
    }
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 ahead = position;
      Vec3 behind = position;
      ahead[axis] += step;
      behind[axis] -= step;
      divergence += (circulation(ahead)[axis] - circulation(behind)[axis]) / (2 * step);
    }
    ASSERT_NEAR(divergence, 0.0, 1e-7);  // single terms are around 1
  }
}

TEST(Circulation, GoesUpTheMiddleOutUnderTheTopDownTheSidesAndInAlongTheBottom) {
  EXPECT_EQ(circulation(middle), (Vec3{0, 0, 30}));
  for (int k = 1; k < 16; ++k) {
    const double z = box.lower.z + 5 * k;
    EXPECT_GT(circulation({middle.x, middle.y, z}).z, 0.0);
    EXPECT_LT(circulation({box.lower.x, middle.y, z}).z, 0.0);
    EXPECT_LT(circulation({middle.x, box.upper.y, z}).z, 0.0);
    EXPECT_LT(circulation({box.upper.x, box.upper.y, z}).z, 0.0);
  }
  for (const double side : {-1.0, 1.0}) {
    const double x = middle.x + 50 * side;
    const double y = middle.y + 25 * side;
    const Vec3 under_the_top = circulation({x, y, 88});
    EXPECT_GT(under_the_top.x * side, 0.0);
    EXPECT_GT(under_the_top.y * side, 0.0);
    const Vec3 at_the_bottom = circulation({x, y, 12});
    EXPECT_LT(at_the_bottom.x * side, 0.0);
    EXPECT_LT(at_the_bottom.y * side, 0.0);
  }
}

TEST(Circulation, DoesNotFlowThroughTheWalls) {
  Random random(2);
  for (int k = 0; k < 100; ++k) {
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 position;
      for (int other = 0; other < 3; ++other) {
        position[other] = random.uniform(box.lower[other], box.upper[other]);
      }
      for (const Vec3& wall : {box.lower, box.upper}) {
        position[axis] = wall[axis];
        EXPECT_NEAR(circulation(position)[axis], 0.0, 1e-13);
      }
    }
  }
}

TEST(Circulation, IsThatOfTheNearestPointOutside) {
  EXPECT_EQ(circulation({-5, 10, 40}), circulation({0, 10, 40}));
  EXPECT_EQ(circulation({250, 90, 95}), circulation({200, 50, 90}));
}

VelocityFieldDefinition still_body() {
  return {.field = circulation, .start = {{middle, {}}}, .acceleration_limits = {30.0}};
}

TEST(VelocityField, BodiesAreCarriedAlong) {
  const VelocityField motion = VelocityField::create(still_body()).value();
  EXPECT_GT(motion.state(0, 1.0).velocity.z, 10.0);
  EXPECT_EQ(motion.state(0, 1.0).position.x, middle.x);
}

TEST(VelocityField, AccelerationIsProportionalUntilTheLimit) {
  auto definition = still_body();
  definition.field = [](const Vec3&) { return Vec3{3, 4, 0}; };
  definition.response_time = 0.5;
  EXPECT_EQ(VelocityField::create(definition)->trajectory(0, 0, 0).front().acceleration, (Vec3{6, 8, 0}));
  definition.acceleration_limits = {5.0};
  const Vec3 limited = VelocityField::create(definition)->trajectory(0, 0, 0).front().acceleration;
  EXPECT_LE(norm(limited), 5.0);
  EXPECT_LT(norm(limited - Vec3{3, 4, 0}), 1e-12);
}

TEST(VelocityField, KickedBodiesLookAtTheFieldAtOnce) {
  VelocityField motion = VelocityField::create(still_body()).value();
  ASSERT_TRUE(motion.set_velocity(0, 0.05, {0, 0, 100}));
  const Segment segment = motion.trajectory(0, 0.05, 0.05).front();
  EXPECT_EQ(segment.begin, 0.05);
  EXPECT_LT(segment.acceleration.z, -29.0);
  EXPECT_EQ(motion.trajectory(0, 0.05, 1.0).front().end, 0.1);
}

TEST(VelocityField, IsTheSameEverywhere) {
  auto definition = still_body();
  definition.start[0].position += Vec3{20, 30, -10};
  const VelocityField motion = VelocityField::create(definition).value();
  EXPECT_EQ(motion.state(0, 20.1).position,
            (Vec3{0x1.90005a3affa77p+6, 0x1.954743cf89aa4p+5, -0x1.b3e65c03b736bp+0}));
}

TEST(VelocityField, NamesWhatIsWrong) {
  auto definition = still_body();
  definition.field = nullptr;
  EXPECT_EQ(VelocityField::create(definition).error().argument, "field");
  definition.field = Circulation{{{0, 0, 0}, {1, 1, 0}}, 1.0};
  const auto flat = VelocityField::create(definition);
  ASSERT_FALSE(flat);
  EXPECT_EQ(flat.error().code, ErrorCode::not_finite);
  EXPECT_EQ(flat.error().body, (BodyId{0, 0}));
  definition = still_body();
  definition.response_time = 0.0;
  EXPECT_EQ(VelocityField::create(definition).error().message,
            "VelocityField::create: response_time must be > 0, but is 0");
  definition = still_body();
  definition.interval = -1.0;
  EXPECT_EQ(VelocityField::create(definition).error().argument, "interval");
}

}  // namespace
}  // namespace kinesphere::velocity_field_test
