// Meshes: which are accepted, their nearest points against brute force, normals at edges, and what searches
// cost.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "bound/mesh_tree.hpp"
#include "bound/nearest_parts.hpp"
#include "bound/reach.hpp"
#include "bound/rigid_part.hpp"
#include "kinesphere/random.hpp"
#include "kinesphere/rigid_body.hpp"
#include "support/expect_error.hpp"

namespace kinesphere::mesh_test {
namespace {

using Corners = std::vector<std::array<std::uint32_t, 3>>;

constexpr std::uint64_t seed = 8203;

/// A square of n x n cells of two triangles each, with edges of length 1; height(x, y) gives the surface.
template <class Height>
Mesh terrain(std::uint32_t n, Height height) {
  std::vector<Vec3> vertices;
  Corners corners;
  for (std::uint32_t y = 0; y <= n; ++y)
    for (std::uint32_t x = 0; x <= n; ++x) vertices.push_back({double(x), double(y), height(x, y)});
  for (std::uint32_t y = 0; y < n; ++y)
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t first = y * (n + 1) + x;
      corners.push_back({first, first + 1, first + n + 2});
      corners.push_back({first + n + 1, first + n + 2, first});  // wound the other way
    }
  return Mesh::create(vertices, corners).value();
}
Mesh hills(std::uint32_t n) {
  Random random(seed);
  return terrain(n, [&](std::uint32_t, std::uint32_t) { return 2.0 * random.uniform(); });
}

TEST(Mesh, RefusesWhatIsNoSurface) {
  const std::vector<Vec3> vertices{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {NAN, 0, 0}, {1, 1e-7, 0}};
  const auto refused = [&](const Corners& corners, ErrorCode code, const char* argument,
                           const char* message) {
    expect_error(Mesh::create(vertices, corners), code, argument, message);
  };
  refused({}, ErrorCode::out_of_range, "corners", "Mesh::create: corners must have at least one triangle");
  refused({{0, 1, 2}, {0, 1, 6}}, ErrorCode::out_of_range, "corners", "Mesh::create: triangle 1: corners");
  refused({{0, 1, 2}, {0, 1, 4}}, ErrorCode::not_finite, "vertices", "Mesh::create: triangle 1: vertices");
  refused({{0, 1, 1}}, ErrorCode::out_of_range, "vertices", "Mesh::create: triangle 0: vertices");
  refused({{0, 1, 3}}, ErrorCode::out_of_range, "vertices", "Mesh::create: triangle 0: vertices");
  refused({{0, 5, 3}}, ErrorCode::out_of_range, "vertices", "Mesh::create: triangle 0: vertices");
  EXPECT_TRUE(Mesh::create(vertices, Corners{{0, 1, 2}}));
}

TEST(Mesh, KeepsWhatItWasMadeOf) {
  const std::vector<Vec3> vertices{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const Corners corners{{0, 1, 2}, {3, 2, 1}};
  const Mesh mesh = Mesh::create(vertices, corners).value();
  EXPECT_EQ(mesh.size(), 2u);
  EXPECT_EQ(mesh.triangle(1), (Triangle{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}}));
  EXPECT_TRUE(std::ranges::equal(mesh.vertices(), vertices));
  EXPECT_TRUE(std::ranges::equal(mesh.corners(), corners));
  const Mesh copy = mesh;
  EXPECT_EQ(copy.vertices().data(), mesh.vertices().data()) << "copies share";
  EXPECT_EQ(copy, mesh);
  EXPECT_EQ(Mesh::create(vertices, corners).value(), mesh);
  EXPECT_NE(Mesh::create(vertices, Corners{{0, 1, 2}, {3, 1, 2}}).value(), mesh);
  EXPECT_NE(Mesh{}, mesh);
  EXPECT_EQ(Mesh{}, Mesh{});
  EXPECT_EQ(bounding_box(mesh, 1e9), (Box{{0, 0, 0}, {1, 1, 1}}));
}

TEST(Mesh, WithoutTrianglesIsNowhere) {
  const Bound ball{.radius = 1};
  EXPECT_EQ(earliest_meeting(ball, Mesh{}, 0, 1), infinity);
  EXPECT_EQ(gap_limits(ball, Mesh{}, 0).lower, infinity);
  EXPECT_EQ(nearest_point(Mesh{}, {}).distance, infinity);
}

TEST(Mesh, NearestPointsAreThoseOfAllTriangles) {
  const Mesh mesh = hills(12);
  Random random(seed + 1);
  for (int k = 0; k < 3000; ++k) {
    const Vec3 from{random.uniform(-4, 16), random.uniform(-4, 16), random.uniform(-3, 6)};
    const MeshPoint found = nearest_in(mesh, from);
    SurfacePoint best{.distance = infinity};
    std::size_t first = 0;
    for (std::size_t n = 0; n < mesh.size(); ++n) {
      const SurfacePoint own = nearest_point(mesh.triangle(n), from);
      if (!(own.distance < best.distance)) continue;
      best = own;
      first = n;
    }
    ASSERT_EQ(found.surface.distance, best.distance) << k;
    ASSERT_EQ(found.surface.point, best.point) << k;
    ASSERT_EQ(found.triangle, first) << k;
    ASSERT_LT(norm(found.surface.normal - best.normal), 1e-9) << k;
    ASSERT_NEAR(norm(found.surface.normal), 1.0, 1e-15);
    const Bound ball{.position = from, .radius = 0.25};
    const GapLimits limits = gap_limits(ball, mesh, 0.0);
    ASSERT_LE(limits.lower, best.distance - 0.25);
    ASSERT_GE(limits.upper, best.distance - 0.25);
    ASSERT_LT(limits.upper - limits.lower, 1e-11);
  }
}

TEST(Mesh, ReachesAsFarAsItsFarthestCorner) {
  const Mesh mesh = hills(12);
  Random random(seed + 2);
  for (int k = 0; k < 200; ++k) {
    const Vec3 way = random.unit_vector();
    double most = -infinity;
    for (const Vec3& vertex : mesh.vertices()) most = std::max(most, dot(way, vertex));
    EXPECT_EQ(reach(mesh, way), most);
  }
}

/// Above faces, edges and corners alike, also of coordinates that doubles do not have.
TEST(Mesh, AFlatFloorHasOneNormal) {
  const Mesh floor = terrain(8, [](std::uint32_t, std::uint32_t) { return 0.0; });
  Random random(seed + 3);
  for (int k = 0; k < 4000; ++k) {
    Vec3 from{random.uniform(0, 8), random.uniform(0, 8), random.uniform(-1, 1)};
    if (k % 4 == 1) from.x = std::floor(from.x);
    if (k % 4 == 2) from.y = from.x;
    if (k % 4 == 3) from = {std::floor(from.x) + 1e-15 * from.z, std::floor(from.y), from.z};
    const SurfacePoint found = nearest_point(floor, from);
    ASSERT_EQ(found.normal.x, 0.0) << k;
    ASSERT_EQ(found.normal.y, 0.0) << k;
    ASSERT_EQ(found.normal.z, from.z < 0.0 ? -1.0 : 1.0) << k;
    ASSERT_NEAR(found.distance, std::abs(from.z), 1e-15) << k;
  }
}

/// A roof, from above a ridge and from below a valley: of angle 2 atan(1/2).
TEST(Mesh, NormalsAtARidgeAreBetweenThoseOfTheFaces) {
  const Mesh roof = terrain(2, [](std::uint32_t x, std::uint32_t) { return x == 1 ? 0.5 : 0.0; });
  for (const double side : {-0.2, -0.05, 0.0, 0.1, 0.22}) {
    const Vec3 above = Vec3{1, 1.3, 0.5} + 0.3 * Vec3{side, 0, std::sqrt(1 - side * side)};
    const SurfacePoint found = nearest_point(roof, above);
    EXPECT_NEAR(norm(found.normal - Vec3{side, 0, std::sqrt(1 - side * side)}), 0.0, 1e-14) << side;
    EXPECT_NEAR(found.distance, 0.3, 1e-14);
    // In the valley below, the nearest point is on a face, however near the edge is.
    const SurfacePoint below = nearest_point(roof, {1 + side, 1.3, 0.2});
    const double lean = below.normal.x > 0 ? 1 : -1;
    EXPECT_NEAR(norm(below.normal - Vec3{lean, 0, -2} / std::sqrt(5)), 0.0, 1e-14) << side;
  }
}

/// What overlaps a floor of triangles is pushed up, and not off the side of the first triangle.
TEST(Mesh, PartsInAFlatFloorHaveItsNormal) {
  const Mesh floor = terrain(8, [](std::uint32_t, std::uint32_t) { return 0.0; });
  Random random(seed + 4);
  const RigidPart crate = box_part({{-0.5, -0.4, -0.3}, {0.5, 0.4, 0.3}}, 0.0);
  const RigidPart capsule{{-0.5, 0, 0}, {0.5, 0, 0}, 0.3};
  for (const RigidPart& part : {crate, capsule})
    for (int k = 0; k < 300; ++k) {
      const PartBall around = ball_around(part);
      const double height = 0.3 + (k % 3 == 0 ? 0.1 : -1e-4) * random.uniform();
      const Vec3 at{random.uniform(2, 6), k % 2 == 0 ? 4.4 : random.uniform(2, 6), height};
      const RigidPose pose{at, rotation_by({0, 0, k % 5 == 0 ? 0.0 : random.uniform(0, 3)}),
                           std::span(&part, 1), std::span(&around, 1)};
      const NearestParts found = nearest_parts(pose, floor);
      ASSERT_LT(norm(found.normal - Vec3{0, 0, -1}), 1e-12) << k << " at " << height;
      ASSERT_LT(found.second_part, floor.size());
    }
}

/// A search looks at a number of boxes that grows with the depth of the hierarchy.
TEST(Mesh, SearchesTakeLogarithmicTime) {
  for (const std::uint32_t n : {16u, 64u, 256u}) {
    const Mesh mesh = hills(n);
    Random random(seed + 5);
    double boxes = 0, triangles = 0;
    constexpr int rounds = 200;
    for (int k = 0; k < rounds; ++k) {
      const Vec3 from{random.uniform(0, n), random.uniform(0, n), 3.0};
      double nearest = infinity;
      tree_of(mesh).search(
          [&](const Box& box) {
            ++boxes;
            Vec3 away;
            for (int axis = 0; axis < 3; ++axis)
              away[axis] = std::max({box.lower[axis] - from[axis], from[axis] - box.upper[axis], 0.0});
            return norm(away);
          },
          [&] { return nearest; },
          [&](std::uint32_t, const Triangle& triangle) {
            ++triangles;
            nearest = std::min(nearest, nearest_point(triangle, from).distance);
            return true;
          });
    }
    // A quarter million times as many triangles as in the smallest take a few boxes more.
    EXPECT_LT(boxes / rounds, 12.0 * std::log2(2.0 * n * n)) << n;
    EXPECT_LT(triangles / rounds, 24.0) << n;
  }
}

TEST(Mesh, EachTriangleIsFoundOnce) {
  const Mesh mesh = hills(9);
  std::multiset<std::uint32_t> seen;
  tree_of(mesh).search([](const Box&) { return 0.0; }, [] { return 1.0; },
                       [&](std::uint32_t number, const Triangle& triangle) {
                         EXPECT_EQ(triangle, mesh.triangle(number));
                         seen.insert(number);
                         return true;
                       });
  EXPECT_EQ(seen.size(), mesh.size());
  EXPECT_EQ(std::set(seen.begin(), seen.end()).size(), mesh.size());
}

}  // namespace
}  // namespace kinesphere::mesh_test
