// Spheres are placed inside their box, apart from each other, up to packings that leave little room.
#include "simulation/scene/placement.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "kinesphere/random.hpp"
#include "simulation/scene/make_scene.hpp"
#include "simulation/scene/relaxation.hpp"

namespace kinesphere::placement_test {
namespace {

constexpr Box box{{-50, -50, -50}, {50, 50, 50}};
constexpr double clearance = 1e-5;
constexpr double unit_ball = 4.1887902047863905;

/// Radii drawn from [least, 10] until the spheres fill that part of the box.
std::vector<double> radii_that_fill(double part, double least, std::uint64_t seed) {
  Random random(seed);
  const Vec3 size = box.upper - box.lower;
  std::vector<double> radii;
  for (double volume = 0.0; volume < part * size.x * size.y * size.z;) {
    radii.push_back(random.uniform(least, 10.0));
    volume += unit_ball * radii.back() * radii.back() * radii.back();
  }
  return radii;
}

void expect_placed(const std::vector<double>& radii, const std::optional<std::vector<Vec3>>& centres) {
  ASSERT_TRUE(centres);
  ASSERT_EQ(centres->size(), radii.size());
  for (std::size_t a = 0; a < radii.size(); ++a) {
    const Vec3& centre = (*centres)[a];
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_GE(centre[axis] - radii[a], box.lower[axis] + 0.999 * clearance) << "sphere " << a;
      ASSERT_LE(centre[axis] + radii[a], box.upper[axis] - 0.999 * clearance) << "sphere " << a;
    }
    for (std::size_t b = 0; b < a; ++b) {
      ASSERT_GE(norm(centre - (*centres)[b]) - radii[a] - radii[b], 0.999 * clearance)
          << "spheres " << a << " and " << b;
    }
  }
}

void expect_placed_in_periodic_box(const std::vector<double>& radii,
                                   const std::optional<std::vector<Vec3>>& centres) {
  ASSERT_TRUE(centres);
  const double size = box.upper.x - box.lower.x;
  for (std::size_t a = 0; a < radii.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      Vec3 offset = (*centres)[a] - (*centres)[b];
      for (int axis = 0; axis < 3; ++axis) offset[axis] -= size * std::round(offset[axis] / size);
      ASSERT_GE(norm(offset) - radii[a] - radii[b], 0.999 * clearance) << "spheres " << a << " and " << b;
    }
  }
}

class Seeds : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(Seeds, places_what_random_placement_can) {
  const auto radii = radii_that_fill(0.3, 0.1, GetParam());
  expect_placed(radii, place_spheres(radii, box, clearance, GetParam()));
}

TEST_P(Seeds, places_the_fullest_box_of_the_paper) {
  const auto radii = radii_that_fill(0.47, 0.1, GetParam());
  expect_placed(radii, place_spheres(radii, box, clearance, GetParam()));
}

TEST_P(Seeds, keeps_images_apart_in_a_periodic_box) {
  for (const double part : {0.3, 0.5}) {
    const auto radii = radii_that_fill(part, 0.1, GetParam());
    expect_placed_in_periodic_box(radii, place_spheres(radii, box, clearance, GetParam(), true));
    expect_placed_in_periodic_box(radii, relax_spheres(radii, box, clearance, GetParam(), true));
  }
}

TEST_P(Seeds, places_denser_packings) {
  const auto radii = radii_that_fill(0.55, 0.1, GetParam());
  expect_placed(radii, place_spheres(radii, box, clearance, GetParam()));
}

TEST_P(Seeds, relaxation_alone_places_every_density) {
  for (const double part : {0.0, 0.1, 0.3, 0.5}) {
    const auto radii = radii_that_fill(part, 0.1, GetParam());
    expect_placed(radii, relax_spheres(radii, box, clearance, GetParam()));
  }
}

// The same under every compiler and at every optimisation level.
TEST(Placement, relaxation_is_the_same_on_every_machine) {
  const auto centres = relax_spheres(radii_that_fill(0.5, 0.1, 1), box, clearance, 1);
  ASSERT_TRUE(centres);
  std::uint64_t hash = 0;
  for (const Vec3& centre : *centres) {
    for (int axis = 0; axis < 3; ++axis)
      hash = hash * 0x100000001b3u + std::bit_cast<std::uint64_t>(centre[axis]);
  }
  EXPECT_EQ(hash, 0x5839daa3bdfd4114u) << std::hex << hash;
}

INSTANTIATE_TEST_SUITE_P(Placement, Seeds, ::testing::Range<std::uint64_t>(1, 4));

TEST(Placement, says_no_where_there_is_no_room) {
  EXPECT_FALSE(place_spheres({60.0}, box, clearance, 1)) << "larger than the box";
  EXPECT_FALSE(place_spheres({40.0, 40.0}, box, clearance, 1)) << "one fits, two do not";
  EXPECT_FALSE(place_spheres(radii_that_fill(0.8, 5.0, 1), box, clearance, 1)) << "denser than can be packed";
  EXPECT_FALSE(place_spheres(radii_that_fill(1.1, 0.1, 1), box, clearance, 1)) << "more than the box";
}

TEST(Placement, points_and_a_sphere_that_just_fits) {
  const std::vector<double> points(100, 0.0);
  expect_placed(points, place_spheres(points, box, clearance, 1));
  expect_placed(points, relax_spheres(points, box, clearance, 1));
  const std::vector<double> snug{49.9};
  expect_placed(snug, place_spheres(snug, box, clearance, 1));
}

TEST(Placement, the_fullest_scene_of_the_paper_is_made) {
  for (const std::uint64_t seed : {1u, 2u}) {
    SceneParameters parameters = built_in_scenes().front();
    ASSERT_EQ(parameters.name, "paper1");
    parameters.bodies = 3500;
    parameters.seed = seed;
    const auto scene = make_scene(parameters);
    ASSERT_TRUE(scene) << "seed " << seed << ": " << scene.error().message;
    EXPECT_EQ(scene->bodies.size(), 3500u);
  }
}

}  // namespace
}  // namespace kinesphere::placement_test
