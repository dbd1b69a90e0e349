// What stands for two bodies in a certificate, by what each of them is.
#include "bodies/collision_shape.hpp"

#include <gtest/gtest.h>

#include <array>

#include <string>

#include "bodies/body_bounds.hpp"
#include "bodies/shaped_body.hpp"

namespace kinesphere::collision_shape_test {
namespace {

/// Says which kind of partner certificates see, and whether the bound is that of the first body.
struct Kind {
  std::string operator()(const Bound& seen, const Bound&) const { return name("bound", seen); }
  std::string operator()(const Bound& seen, const HalfSpace&) const { return name("half-space", seen); }
  template <class Solid>
  std::string operator()(const Bound& seen, const Placed<Solid>& placed) const {
    return name(kind_of(placed), seen);
  }
  template <class Other>
  std::string operator()(const Bound& seen, const RigidPair<Other>& pair) const {
    std::string partner = "solid";
    if constexpr (std::is_same_v<Other, RigidExtent>) partner = std::to_string(pair.other.parts.size());
    if constexpr (requires { pair.other.carrier; }) partner = kind_of(pair.other);
    return name("rigid with " + partner, seen);
  }
  template <class Solid>
  static std::string kind_of(const Placed<Solid>& placed) {
    const char* const kind = std::is_same_v<Solid, Convex> ? "convex"
                             : std::is_same_v<Solid, Mesh> ? "mesh"
                                                           : "difference";
    return (placed.carrier ? "carried " : "") + std::string(kind);
  }
  std::string name(const std::string& kind, const Bound& seen) const {
    return (&seen == first ? "" : "second to ") + kind;
  }
  const Bound* first;
};

TEST(CollisionShape, DecidesWhatCertificatesSee) {
  const Bound one{.radius = 1.0}, other{.position = {9, 0, 0}, .radius = 1.0};
  const Shape box = Box{{-1, -1, -1}, {1, 1, 1}}, floor = HalfSpace{{0, 0, 1}, 0.0}, ball = Ball{};
  const Shape triangle = Triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const RigidBody body{.parts = {{{-1, 0, 0}, {1, 0, 0}, 0.5}, {}}};
  const RigidRecord record = record_of(body, 0.0);
  const CollisionShape plain{one}, plain_too{other};
  const CollisionShape rigid{one, false, nullptr, 1.5, &record},
      rigid_too{other, false, nullptr, 1.5, &record};
  const auto kind = [&](const CollisionShape& a, const CollisionShape& b) {
    return visit_shapes(a, b, Kind{&a.bound});
  };
  EXPECT_EQ(kind(plain, plain_too), "bound");
  EXPECT_EQ(kind(plain, collision_shape_of(other, box)), "convex");
  EXPECT_EQ(kind(collision_shape_of(one, box), plain_too), "second to convex");
  EXPECT_EQ(kind(plain, collision_shape_of(other, floor)), "half-space");
  EXPECT_EQ(kind(plain, collision_shape_of(other, triangle)), "convex");
  const std::array vertices{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}};
  const std::array<std::array<std::uint32_t, 3>, 1> corners{{{0, 1, 2}}};
  const Shape mesh = Mesh::create(vertices, corners).value();
  EXPECT_EQ(kind(plain, collision_shape_of(other, mesh)), "mesh");
  EXPECT_EQ(kind(plain, carried_shape_of(other, mesh, 2.0)), "carried mesh");
  EXPECT_EQ(kind(plain, collision_shape_of(other, ball)), "bound") << "a ball at rest";
  EXPECT_EQ(kind(plain, carried_shape_of(other, box, 2.0)), "carried convex");
  EXPECT_EQ(kind(rigid, rigid_too), "rigid with 2");
  EXPECT_EQ(kind(rigid, plain_too), "rigid with 1") << "a ball is a body of one part";
  EXPECT_EQ(kind(plain, rigid_too), "second to rigid with 1");
  EXPECT_EQ(kind(rigid, collision_shape_of(other, floor)), "rigid with solid");
  EXPECT_EQ(kind(collision_shape_of(one, triangle), rigid_too), "second to rigid with convex");
  EXPECT_EQ(kind(rigid, carried_shape_of(other, box, 2.0)), "rigid with carried convex");
}

/// Of two shapes, one of which is carried, certificates see a point with the motion of the carried one, and
/// the difference of both.
TEST(CollisionShape, OfTwoShapesIsTheirDifference) {
  const Bound one{.position = {1, 2, 3}, .radius = 2.5}, other{.position = {9, 0, 0}, .radius = 2.0};
  const Shape box = Box{{-1, -1, -1}, {1, 1, 1}}, floor = HalfSpace{{0, 0, 1}, 0.0};
  const Shape triangle = Triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const CollisionShape carried = carried_shape_of(one, box, 2.0);
  EXPECT_TRUE(carried.is_carried());
  const auto kind = [](const CollisionShape& a, const CollisionShape& b) {
    std::string seen;
    visit_shapes(a, b, [&](const Bound& point, const auto& partner) {
      seen = Kind{&point}(point, partner);
      EXPECT_EQ(point.position, (Vec3{1, 2, 3}));
      EXPECT_NEAR(point.radius, 0.5, 1e-12);
    });
    return seen;
  };
  EXPECT_EQ(kind(carried, collision_shape_of(other, box)), "convex");
  EXPECT_EQ(kind(collision_shape_of(other, box), carried), "convex");
  EXPECT_EQ(kind(carried, collision_shape_of(other, floor)), "half-space");
  EXPECT_EQ(kind(carried, collision_shape_of(other, triangle)), "difference");
  EXPECT_EQ(kind(carried, carried_shape_of(other, box, 2.0)), "carried convex");
  EXPECT_EQ(kind(carried, carried_shape_of(other, triangle, 1.0)), "carried difference");
}

}  // namespace
}  // namespace kinesphere::collision_shape_test
