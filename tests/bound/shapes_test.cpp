// Shapes at rest: nearest points, bounding boxes, and triangle meshes.
#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "number/infinity.hpp"
#include "support/bound_cases.hpp"
#include "support/exact_shapes.hpp"

namespace kinesphere::shapes_test {
namespace {

constexpr std::uint64_t seed = 1737;
const Box unit_box{{-1, -1, -1}, {1, 1, 1}};
const Triangle flat{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};

/// The point is where distance and normal say, and no nearer than the shape is.
template <class Solid>
void expect_nearest(const Solid& solid, const Vec3& from) {
  const SurfacePoint found = nearest_point(solid, from);
  EXPECT_NEAR(found.distance, static_cast<double>(exact::distance(solid, exact::wide(from))), 1e-14);
  EXPECT_NEAR(norm(found.normal), 1.0, 1e-14);
  EXPECT_NEAR(norm(from - found.point - found.normal * found.distance), 0.0, 1e-13);
  EXPECT_NEAR(std::abs(nearest_point(solid, found.point).distance), 0.0, 1e-13);
}

TEST(NearestPoint, IsAsFarAsTheExactDistance) {
  SCOPED_TRACE(seed);
  Random random(seed);
  for (int k = 0; k < 2000; ++k) {
    const Vec3 from = 3.0 * random.point_in_ball();
    expect_nearest(unit_box, from);
    expect_nearest(Triangle{random.unit_vector(), random.unit_vector(), random.unit_vector()}, from);
    if (HasFailure()) {
      FAIL() << k << " from " << from;
    }
  }
}

TEST(NearestPoint, IsTheOneOnFaceSideOrCorner) {
  const auto expect = [](const SurfacePoint& got, const Vec3& point, const Vec3& normal, double distance) {
    EXPECT_NEAR(norm(got.point - point), 0.0, 1e-15) << got.point;
    EXPECT_NEAR(norm(got.normal - normal), 0.0, 1e-15) << got.normal;
    EXPECT_NEAR(got.distance, distance, 1e-15);
  };
  expect(nearest_point(flat, {1, 1, 2}), {1, 1, 0}, {0, 0, 1}, 2);
  expect(nearest_point(flat, {1, 1, -2}), {1, 1, 0}, {0, 0, -1}, 2);
  expect(nearest_point(flat, {1, 1, 0}), {1, 1, 0}, {0, 0, 1}, 0);
  expect(nearest_point(flat, {2, -3, 4}), {2, 0, 0}, {0, -0.6, 0.8}, 5);
  expect(nearest_point(flat, {7, 0, 4}), {4, 0, 0}, {0.6, 0, 0.8}, 5);
  expect(nearest_point(flat, {-3, -4, 0}), {0, 0, 0}, {-0.6, -0.8, 0}, 5);
  expect(nearest_point(flat, {0, 2, 0}), {0, 2, 0}, {0, 0, 1}, 0);
  expect(nearest_point(unit_box, {0, 0, 3}), {0, 0, 1}, {0, 0, 1}, 2);
  expect(nearest_point(unit_box, {4, 5, 0}), {1, 1, 0}, {0.6, 0.8, 0}, 5);
  expect(nearest_point(unit_box, {0.5, 0, -0.75}), {0.5, 0, -1}, {0, 0, -1}, -0.25);
  expect(nearest_point(unit_box, {1, 0, 0}), {1, 0, 0}, {1, 0, 0}, 0);
  expect(nearest_point(HalfSpace{{0, 0, 1}, 2}, {1, 1, -1}), {1, 1, 2}, {0, 0, 1}, -3);
}

TEST(BoundingBox, HoldsTheShape) {
  const Box of_floor = bounding_box(HalfSpace{{0, 0, 1}, 2.0}, 100.0);
  EXPECT_EQ(of_floor.lower, (Vec3{-100, -100, -100}));
  EXPECT_EQ(of_floor.upper.x, 100.0);
  EXPECT_NEAR(of_floor.upper.z, 2.0, 1e-9);
  EXPECT_GE(of_floor.upper.z, 2.0);
  const Box of_slope = bounding_box(HalfSpace{{-0.6, 0, 0.8}, 0.0}, 100.0);
  EXPECT_NEAR(of_slope.upper.z, 75.0, 1e-9);
  EXPECT_EQ(of_slope.lower.x, -100.0);
  const Box of_ball = bounding_box(Ball{{1, 2, 3}, 2}, 100.0);
  EXPECT_LE(of_ball.lower.x, -1.0);
  EXPECT_NEAR(of_ball.upper.z, 5.0, 1e-12);
  EXPECT_EQ(bounding_box(flat, 100.0), (Box{{0, 0, 0}, {4, 4, 0}}));
}

TEST(Mesh, NamesTheTriangleThatIsWrong) {
  const std::vector<Vec3> vertices{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {infinity, 0, 0}};
  using Corners = std::vector<std::array<std::uint32_t, 3>>;
  const auto good = triangles(vertices, Corners{{0, 1, 2}, {1, 3, 2}}, {.category = 4}).value();
  ASSERT_EQ(good.size(), 2u);
  EXPECT_EQ(std::get<Triangle>(good[1].shape), (Triangle{vertices[1], vertices[3], vertices[2]}));
  EXPECT_EQ(good[1].user_data, 1u);
  EXPECT_EQ(good[1].filter.category, 4u);
  const auto refused = [&](const std::array<std::uint32_t, 3>& corners) {
    const auto result = triangles(vertices, Corners{{0, 1, 2}, corners});
    EXPECT_FALSE(result);
    EXPECT_EQ(result.error().message.rfind("triangles: triangle 1: ", 0), 0u) << result.error().message;
    return result.error();
  };
  EXPECT_EQ(refused({0, 1, 5}).argument, "corners");
  EXPECT_EQ(refused({0, 1, 5}).code, ErrorCode::out_of_range);
  EXPECT_EQ(refused({0, 1, 3}).code, ErrorCode::out_of_range);
  EXPECT_EQ(refused({0, 1, 1}).code, ErrorCode::out_of_range);
  EXPECT_EQ(refused({0, 1, 4}).code, ErrorCode::not_finite);
  EXPECT_TRUE(triangles({}, {}).value().empty());
  // As one body.
  const auto one = mesh(vertices, Corners{{0, 1, 2}, {1, 3, 2}}, {.category = 4}).value();
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(std::get<Mesh>(one[0].shape).size(), 2u);
  EXPECT_EQ(one[0].filter.category, 4u);
  EXPECT_TRUE(mesh({}, {}).value().empty());
  EXPECT_EQ(mesh(vertices, Corners{{0, 1, 5}}).error().argument, "corners");
}

}  // namespace
}  // namespace kinesphere::shapes_test
