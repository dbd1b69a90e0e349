// Scenes are made as their parameters say: how full the box is, and space that repeats.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "simulation/detector/detector.hpp"
#include "simulation/run/run_scene.hpp"
#include "simulation/scene/make_scene.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere::make_scene_test {
namespace {

SceneParameters built_in(const std::string& name) {
  const auto& scenes = built_in_scenes();
  return *std::find_if(scenes.begin(), scenes.end(), [&](const auto& scene) { return scene.name == name; });
}

Vec3 momentum_of(const Scene& scene) {
  Vec3 momentum{};
  for (std::uint32_t body = 0; body < scene.bodies.size(); ++body)
    momentum += std::pow(scene.bodies[body].radius, 3) * scene.motion->state(body, 0.0).velocity;
  return momentum;
}

TEST(Packing, ScalesTheBoxToThatVolume) {
  for (const double packing : {1e-6, 0.05, 0.25, 0.49}) {
    const Scene scene = make_scene({.bodies = 200,
                                    .radius_min = 1.0,
                                    .radius_max = 1.0,
                                    .box = {{-1, 2, 3}, {0, 4, 6}},
                                    .packing = packing})
                            .value();
    const Box box = scene.world.box.value();
    const Vec3 size = box.upper - box.lower;
    EXPECT_EQ(box.lower, (Vec3{-1, 2, 3}));
    EXPECT_NEAR(size.y / size.x, 2.0, 1e-12);
    EXPECT_NEAR(size.z / size.x, 3.0, 1e-12);
    const double ball = 4.0 / 3.0 * std::acos(-1.0);
    EXPECT_NEAR(200 * ball / (size.x * size.y * size.z), packing, 1e-12 * packing);
  }
}

TEST(PeriodicScene, HasNoWallsAndNoMomentum) {
  const SceneParameters gas = built_in("periodic_gas");
  const Scene scene = make_scene(gas).value();
  EXPECT_EQ(scene.world.periodic, (Axes{true, true, true}));
  EXPECT_LT(norm(momentum_of(scene)), 1e-10);
  EXPECT_TRUE(make_scene({.bodies = 10, .walls = false, .periodic = true}).value().world.box);
  // Masses count: a mixture.
  EXPECT_LT(norm(momentum_of(make_scene({.bodies = 50, .periodic = true}).value())), 1e-6);
  EXPECT_GT(norm(momentum_of(make_scene({.bodies = 50}).value())), 1.0);
}

TEST(PeriodicScene, IsAsDenseAtTheFacesAsAnywhere) {
  for (const double packing : {0.25, 0.45}) {
    SceneParameters gas = built_in("periodic_gas");
    gas.packing = packing;
    const Scene scene = make_scene(gas).value();
    const Box box = *scene.world.box;
    const double size = box.upper.x - box.lower.x;
    int near_face = 0;
    for (std::uint32_t k = 0; k < gas.bodies; ++k) {
      const Vec3 centre = scene.motion->state(k, 0.0).position;
      const auto is_near = [&](int axis) {
        return centre[axis] < box.lower[axis] + 0.5 || centre[axis] > box.upper[axis] - 0.5;
      };
      near_face += is_near(0) || is_near(1) || is_near(2) ? 1 : 0;
      ASSERT_TRUE(box.lower.x <= centre.x && centre.x < box.upper.x);
    }
    const double inside = (size - 1.0) / size;
    const double uniform = gas.bodies * (1.0 - inside * inside * inside);
    EXPECT_NEAR(near_face, uniform, 4.0 * std::sqrt(uniform)) << "packing " << packing;
  }
}

TEST(PeriodicScene, IsRunWithoutEverMeetingAWall) {
  SceneParameters gas = built_in("periodic_gas");
  gas.bodies = 200;
  gas.seconds = 2.0;
  const SceneResult result = run_scene(make_scene(gas).value(), make_world_detector).value();
  EXPECT_EQ(result.counters.count(EventKind::wall_begin), 0u);
  EXPECT_GT(result.counters.count(EventKind::contact_begin), 500u);
}

}  // namespace
}  // namespace kinesphere::make_scene_test
