#include "simulation/scene/scene_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "bodies/validation.hpp"
#include "input/input_check.hpp"

namespace kinesphere {

Result<void> check_times(const Scene& scene, std::string_view call) {
  InputCheck check(call);
  const double start = scene.world.start_time;
  check.finite({"end_time"}, scene.end_time)
      .require(!(scene.end_time < start), ErrorCode::time_backwards, {"end_time"},
               "must not lie before start_time,", start, scene.end_time)
      .require(scene.bodies.size() <= scene.motion->size(), ErrorCode::out_of_range, {"bodies"},
               "must be no more than the motion has,", std::size_t{scene.motion->size()},
               scene.bodies.size());
  for (std::uint32_t number = 0; number < scene.bodies.size(); ++number) {
    const BodyId id{number, 0};
    check
        .require(!std::isnan(scene.bodies[number].appears), ErrorCode::not_finite, {"appears", id},
                 "must be a time", scene.bodies[number].appears)
        .require(!std::isnan(scene.bodies[number].vanishes), ErrorCode::not_finite, {"vanishes", id},
                 "must be a time", scene.bodies[number].vanishes);
  }
  for (std::size_t k = 0; k < scene.turns.size(); ++k) {
    const SceneTurn& turn = scene.turns[k];
    const Subject subject{"turns", {turn.body, 0}, "turn", k};
    check.finite(subject, turn.time)
        .finite(subject, turn.velocity)
        .require(turn.body < scene.bodies.size(), ErrorCode::out_of_range, subject, "must be of one of",
                 scene.bodies.size(), std::size_t{turn.body});
  }
  return check.result();
}

Result<void> check_scene(const Scene& scene, std::string_view call) {
  if (auto valid = check_times(scene, call); !valid) return valid;
  if (auto valid = check_world(scene.world); !valid) return valid;
  for (std::uint32_t number = 0; number < scene.bodies.size(); ++number) {
    const SceneBody& body = scene.bodies[number];
    const double appears = std::max(body.appears, scene.world.start_time);
    if (appears > scene.end_time || body.vanishes <= scene.world.start_time) continue;
    BodyDefinition definition = scene.motion->definition(number, appears);
    definition.radius = body.radius;
    if (auto valid = check_body(definition, scene.world, call); !valid) return valid;
  }
  return {};
}

}  // namespace kinesphere
