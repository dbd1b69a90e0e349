// The gaps that audits use contain the exact ones, closely.
#include "query/plain_gap.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "bound/triangle.hpp"
#include "kinesphere/random.hpp"
#include "number/infinity.hpp"

#include "support/exact_shapes.hpp"

namespace kinesphere::plain_gap_test {
namespace {

Vec3 any_vector(Random& random, double size) { return size * random.point_in_ball(); }

Bound any_bound(Random& random, double size) {
  return {.time = random.uniform(-1.0, 1.0),
          .position = any_vector(random, size),
          .velocity = any_vector(random, 3.0),
          .planned_acceleration = any_vector(random, 2.0),
          .radius = random.bits() % 4 == 0 ? 0.0 : random.uniform(),
          .growth_speed = random.bits() % 2 == 0 ? 0.0 : random.uniform(),
          .acceleration_limit = random.uniform()};
}

exact::Wide distance_of_centres(const Bound& a, const Bound& b, double time) {
  const auto way = exact::operator-(exact::centre_at(a, time), exact::centre_at(b, time));
  return exact::sqrt(exact::dot(way, way));
}

void expect_held(const PlainGap& gap, double time, exact::Wide distance, exact::Wide radii,
                 exact::Wide growth, double margin) {
  const auto nearest = gap.of_bounds(time);
  const auto farthest = gap.at_farthest(time);
  EXPECT_LE(nearest.lower, distance - radii - growth);
  EXPECT_GE(nearest.upper, distance - radii - growth);
  EXPECT_LE(farthest.lower, distance - radii + growth);
  EXPECT_GE(farthest.upper, distance - radii + growth);
  EXPECT_LE(nearest.upper - nearest.lower, margin);
  EXPECT_LE(farthest.upper - farthest.lower, margin);
}

TEST(PlainGap, OfTwoBoundsHoldsTheExactOne) {
  Random random(2005);
  for (int k = 0; k < 20000; ++k) {
    const double size = std::exp2(random.uniform(-2.0, 20.0));
    const Bound a = any_bound(random, size);
    const Bound b = any_bound(random, size);
    const double time = 1.0 + 3.0 * random.uniform();
    const PlainGap gap({a}, {b}, {});
    expect_held(gap, time, distance_of_centres(a, b, time), exact::Wide(a.radius) + b.radius,
                exact::growth_at(a, time) + exact::growth_at(b, time), 1e-12 * (size + 100.0));
  }
}

TEST(PlainGap, WhereSpaceRepeatsIsThatOfTheNearestImages) {
  Random random(2006);
  for (int k = 0; k < 5000; ++k) {
    const Bound a = any_bound(random, 20.0);
    const Bound b = any_bound(random, 20.0);
    const Vec3 period{4.0, 0.0, 7.5};
    exact::Wide least = exact::Wide(infinity);
    for (int x = -20; x <= 20; ++x)
      for (int z = -20; z <= 20; ++z) {
        Bound image = b;
        image.position += Vec3{4.0 * x, 0.0, 7.5 * z};
        least = exact::min(least, distance_of_centres(a, image, 1.5));
      }
    expect_held(PlainGap({a}, {b}, period), 1.5, least, exact::Wide(a.radius) + b.radius,
                exact::growth_at(a, 1.5) + exact::growth_at(b, 1.5), 1e-10);
  }
}

/// Includes triangles a millionth as high as they are long.
TEST(PlainGap, OfAShapeHoldsTheExactOne) {
  Random random(2007);
  for (int k = 0; k < 20000; ++k) {
    const Bound bound = any_bound(random, 3.0);
    const Bound at_rest{};
    const double time = 1.0 + random.uniform();
    const Vec3 corner = any_vector(random, 2.0);
    const Vec3 side = any_vector(random, 3.0);
    const double height = std::exp2(random.uniform(-20.0, 1.0));
    const Vec3 margin = any_vector(random, 2.0);
    const Box box{corner, corner + Vec3{std::abs(margin.x), std::abs(margin.y), std::abs(margin.z)}};
    const Triangle triangle{corner, corner + side, corner + 0.3 * side + height * any_vector(random, 1.0)};
    const auto expect_held_by = [&](const auto& solid) {
      SCOPED_TRACE("case " + std::to_string(k));
      const Shape shape = solid;
      const PlainGap gap({bound}, {at_rest, true, &shape}, {});
      expect_held(gap, time, exact::distance(solid, exact::centre_at(bound, time)), bound.radius,
                  exact::growth_at(bound, time), 1e-9);
    };
    expect_held_by(box);
    expect_held_by(triangle);
    if (k % 8 == 0 && thickness(triangle) > 1e-5) {
      const std::array vertices{triangle.a, triangle.b, triangle.c, margin};
      const std::array<std::array<std::uint32_t, 3>, 2> corners{{{0, 1, 2}, {0, 1, 3}}};
      if (const auto mesh = Mesh::create(vertices, corners)) expect_held_by(mesh.value());
    }
    expect_held_by(HalfSpace{{0.6, 0.0, -0.8}, margin.x});
  }
}

}  // namespace
}  // namespace kinesphere::plain_gap_test
