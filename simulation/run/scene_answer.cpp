#include "simulation/run/scene_answer.hpp"

#include <limits>

#include "kinesphere/response.hpp"

namespace kinesphere {
namespace {

double mass(const Scene& scene, BodyId body) {
  const double radius = scene.bodies[body.index].radius;
  return radius > 0.0 ? radius * radius * radius : std::numeric_limits<double>::min();
}

}  // namespace

Response scene_answer(const Scene& scene, const Event& event) {
  const bool begins = event.kind == EventKind::contact_begin || event.kind == EventKind::wall_begin;
  if (scene.response != SceneResponse::bounce || !begins || event.approach_speed <= 0.0) return {};
  const bool pair = event.second != no_body;
  const double first_mass = mass(scene, event.first);
  const double second_mass = pair ? mass(scene, event.second) : first_mass;
  const double restitution = scene.restitution;
  const Bounce after = scene.resting_speed > 0.0
                           ? settle(event, first_mass, second_mass, restitution, scene.resting_speed)
                           : bounce(event, first_mass, second_mass, restitution);
  if (!pair) return {.first_velocity = after.first_velocity};
  return {after.first_velocity, after.second_velocity};
}

}  // namespace kinesphere
