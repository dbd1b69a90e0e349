// Scenes that cannot be made, run or compared: an error says why.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "kinesphere/motion/ballistic.hpp"
#include "kinesphere/motion/recorded_tracks.hpp"
#include "number/infinity.hpp"
#include "simulation/detector/detector.hpp"
#include "simulation/oracle/comparison.hpp"
#include "simulation/run/run_scene.hpp"
#include "simulation/scene/make_scene.hpp"
#include "simulation/scene/scene.hpp"
#include "support/expect_error.hpp"

namespace kinesphere::wrong_calls_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(WrongScene, IsNotMade) {
  const auto refused = [](ErrorCode code, const std::string& argument, const SceneParameters& parameters) {
    expect_error(make_scene(parameters), code, argument, "make_scene:");
  };
  for (const double bad : {nan, infinity, -infinity}) {
    refused(ErrorCode::not_finite, "radius", {.radius_max = bad});
    refused(ErrorCode::not_finite, "speed", {.speed_min = bad});
    refused(ErrorCode::not_finite, "limit", {.limit_max = bad});
    refused(ErrorCode::not_finite, "gravity", {.gravity = {0, bad, 0}});
    refused(ErrorCode::not_finite, "box", {.box = {{0, 0, 0}, {1, 1, bad}}});
    refused(ErrorCode::not_finite, "redraw_interval", {.redraw_interval = bad});
    refused(ErrorCode::not_finite, "contact_tolerance", {.contact_tolerance = bad});
    refused(ErrorCode::not_finite, "seconds", {.seconds = bad});
  }
  refused(ErrorCode::out_of_range, "radius", {.radius_min = -1.0});
  refused(ErrorCode::out_of_range, "radius", {.radius_min = 3.0, .radius_max = 2.0});
  refused(ErrorCode::out_of_range, "speed", {.speed_min = -1.0});
  refused(ErrorCode::out_of_range, "limit", {.limit_min = 50.0});
  refused(ErrorCode::out_of_range, "box", {.box = {{0, 0, 0}, {0, 1, 1}}});
  refused(ErrorCode::out_of_range, "redraw_interval", {.redraw_interval = 0.0});
  for (const double bad : {-0.1, 1.1, nan})
    refused(ErrorCode::out_of_range, "restitution", {.restitution = bad});
  for (const double bad : {-0.1, 1.0, nan}) refused(ErrorCode::out_of_range, "packing", {.packing = bad});
  refused(ErrorCode::out_of_range, "bodies",
          {.bodies = 100, .radius_min = 1.0, .radius_max = 1.0, .packing = 0.9});
  refused(ErrorCode::out_of_range, "contact_tolerance", {.contact_tolerance = 0.0});
  refused(ErrorCode::out_of_range, "seconds", {.seconds = -1.0});
  refused(ErrorCode::out_of_range, "bodies", {.bodies = 9, .radius_min = 100.0, .radius_max = 100.0});
}

/// Two bodies that meet.
Scene meeting() {
  Scene scene;
  scene.bodies = {{}, {}};
  scene.motion = std::make_unique<Ballistic>(
      Ballistic::create({.start = {{{-3, 0, 0}, {1, 0, 0}}, {{3, 0, 0}, {-1, 0, 0}}}}).value());
  scene.end_time = 10.0;
  return scene;
}

TEST(WrongScene, IsNotRun) {
  const auto refused = [](const Scene& scene, ErrorCode code, const std::string& argument) {
    const auto result = run_scene(scene, make_world_detector);
    ASSERT_FALSE(result) << argument;
    EXPECT_EQ(result.error().code, code) << result.error().message;
    EXPECT_EQ(result.error().argument, argument) << result.error().message;
    EXPECT_EQ(verify(scene, make_world_detector).error().message, result.error().message);
  };
  ASSERT_TRUE(run_scene(meeting(), make_world_detector));
  Scene scene = meeting();
  scene.world.contact_tolerance = 0.0;
  refused(scene, ErrorCode::out_of_range, "contact_tolerance");
  scene = meeting();
  scene.bodies[1].radius = -1.0;
  refused(scene, ErrorCode::out_of_range, "radius");
  scene = meeting();
  scene.bodies.emplace_back();
  refused(scene, ErrorCode::out_of_range, "bodies");
  scene = meeting();
  scene.end_time = nan;
  refused(scene, ErrorCode::not_finite, "end_time");
  scene = meeting();
  scene.end_time = -1.0;
  refused(scene, ErrorCode::time_backwards, "end_time");
  scene = meeting();
  scene.bodies[0].appears = nan;
  refused(scene, ErrorCode::not_finite, "appears");
  scene = meeting();
  scene.bodies[1].vanishes = nan;
  refused(scene, ErrorCode::not_finite, "vanishes");
  scene = meeting();
  scene.world.box = Box{{-1, -1, -1}, {1, 1, 1}};
  refused(scene, ErrorCode::outside_domain, "position");
}

TEST(WrongScene, IsNotShownWithoutEnd) {
  for (const double bad : {0.0, -1.0, nan}) {
    const auto result = run_scene(meeting(), make_world_detector, {.frame_interval = bad});
    expect_error(result, ErrorCode::out_of_range, "frame_interval", "simulate:");
  }
}

TEST(WrongScene, OfARecordingDoesNotBounce) {
  Scene scene = meeting();
  scene.motion = std::make_unique<RecordedTracks>(
      RecordedTracks::create({{{0.0, {-3, 0, 0}}, {10.0, {7, 0, 0}}}, {{0.0, {3, 0, 0}}, {10.0, {-7, 0, 0}}}})
          .value());
  ASSERT_TRUE(run_scene(scene, make_world_detector));
  scene.response = SceneResponse::bounce;
  const auto result = run_scene(scene, make_world_detector);
  expect_error(result, ErrorCode::unsupported, "response", "simulate:", {0, 0});
}

TEST(WrongScene, ThatBouncesIsNotCompared) {
  Scene scene = meeting();
  EXPECT_TRUE(compare_with_oracle(scene, {}));
  scene.response = SceneResponse::bounce;
  expect_error(compare_with_oracle(scene, {}), ErrorCode::unsupported, "scene", "compare_with_oracle:");
  scene = meeting();
  scene.world.contacts = ContactEvents::impacts;
  expect_error(compare_with_oracle(scene, {}), ErrorCode::unsupported, "scene", "compare_with_oracle:");
  expect_error(verify(scene, make_world_detector), ErrorCode::unsupported, "scene", "compare_with_oracle:");
}

}  // namespace
}  // namespace kinesphere::wrong_calls_test
