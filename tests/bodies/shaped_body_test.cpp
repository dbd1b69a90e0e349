// Bodies with shapes as bodies of the table, and back.
#include "bodies/shaped_body.hpp"

#include <gtest/gtest.h>

#include "bodies/body_bounds.hpp"
#include "kinesphere/random.hpp"
#include "number/infinity.hpp"

namespace kinesphere::shaped_body_test {
namespace {

constexpr std::uint64_t seed = 5210;
const WorldDefinition space{};
const WorldDefinition plane{.dimensions = 2};

TEST(ShapedBody, AtRestStandsOnItsShapeWithInfiniteMass) {
  for (const Shape& shape :
       {Shape(Ball{{1, 2, 3}, 0.5}), Shape(HalfSpace{{0, 0, 1}, 2.0}), Shape(Box{{0, 0, 0}, {2, 4, 6}}),
        Shape(Triangle{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}})}) {
    const StaticDefinition definition{.shape = shape, .filter = {.category = 8}, .user_data = 5};
    const BodyDefinition body = body_of(definition);
    EXPECT_EQ(body.mass, infinity);
    EXPECT_EQ(body.acceleration_limit, 0.0);
    EXPECT_EQ(body.filter.category, 8u);
    EXPECT_EQ(body.user_data, 5u);
    EXPECT_EQ(body.radius, std::holds_alternative<Ball>(shape) ? 0.5 : 0.0);
    const double distance = std::visit(
        [&]<class Solid>(const Solid& solid) {
          if constexpr (std::is_same_v<Solid, Ball>)
            return norm(body.position - solid.centre) - solid.radius;
          else
            return nearest_point(solid, body.position).distance;
        },
        shape);
    EXPECT_LE(distance, 1e-15) << "its position is a point of the shape";
    Bodies bodies(space);
    bodies.add(body, 0.0);
    bodies.give_shape(0, shape, false);
    EXPECT_EQ(static_definition(bodies, bodies.id_of(0)), definition);
  }
}

TEST(ShapedBody, ThatCarriesAShapeHasTheRadiusAroundIt) {
  const Triangle triangle{{1, 2, 2}, {0, 0, 0}, {1, 0, 0}};
  EXPECT_NEAR(body_of({{}, triangle}, space).radius, 3.0, 1e-12);
  EXPECT_GE(body_of({{}, triangle}, space).radius, 3.0);
  const Box box{{-3, -1, -5}, {1, 4, 1}};
  EXPECT_NEAR(body_of({{}, box}, space).radius, std::sqrt(50.0), 1e-12);
  EXPECT_NEAR(body_of({{}, box}, plane).radius, 5.0, 1e-12) << "the disc around it";
}

TEST(ShapedBody, ThatIsRigidHasTheRadiusAroundAllParts) {
  SCOPED_TRACE(seed);
  Random random(seed);
  for (int k = 0; k < 200; ++k) {
    RigidBody rigid;
    for (int part = 0; part < 3; ++part)
      rigid.parts.push_back(
          {random.point_in_ball(), random.point_in_ball(), random.uniform(), {random.point_in_ball()}});
    rigid.rotation = {rotation_by(random.point_in_ball()), random.point_in_ball()};
    rigid.inertia = {1, 2, 3};
    const double radius = body_of(rigid).radius;
    for (const RigidPart& part : rigid.parts)
      for (const Vec3& point : {part.a, part.b, part.more[0]}) EXPECT_GE(radius, norm(point) + part.radius);
    Bodies bodies(space);
    const BodyDefinition body = body_of(rigid);
    bodies.add(body, 3.0);
    bodies[0].bound = bound_now(body, 3.0);
    bodies.make_rigid(0, record_of(rigid, 3.0));
    const RigidBody back = rigid_body(bodies, 0);
    EXPECT_EQ(back.parts, rigid.parts);
    EXPECT_NEAR(angle_between(back.rotation.orientation, rigid.rotation.orientation), 0.0, 1e-7);
    EXPECT_EQ(back.rotation.angular_velocity, rigid.rotation.angular_velocity);
    EXPECT_EQ(back.inertia, rigid.inertia);
  }
}

TEST(ShapedBody, HasItsShapeInNormalForm) {
  const Shape wall = normalized(HalfSpace{{0, 0, 1.0000005}, 2.0}, space);
  EXPECT_NEAR(norm(std::get<HalfSpace>(wall).normal), 1.0, 1e-15);
  EXPECT_EQ(normalized(wall, space), wall);
  const WorldDefinition repeating{.box = Box{{0, 0, 0}, {10, 10, 10}}, .periodic = {.x = true}};
  EXPECT_EQ(std::get<Ball>(normalized(Ball{{13, 4, 4}, 1.0}, repeating)).centre, (Vec3{3, 4, 4}));
  const auto flat = std::get<Box>(normalized(Box{{1, 1, 0}, {2, 2, 0}}, plane));
  EXPECT_LT(flat.lower.z, -1e3) << "without end in z";
  EXPECT_EQ(flat.upper.z, -flat.lower.z);
  const auto carried = std::get<Box>(normalized_carried(Box{{-3, -1, 0}, {1, 2, 0}}, plane));
  EXPECT_EQ(carried.upper.z, 3.0);
  EXPECT_EQ(carried.lower.z, -3.0);
}

}  // namespace
}  // namespace kinesphere::shaped_body_test
