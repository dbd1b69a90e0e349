// The scenes of the command-line program, to the last bit.
#include <string>

#include "module.hpp"
#include "simulation/scene/make_scene.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere::browser {

KINESPHERE_EXPORT(scene_count) std::size_t scene_count() { return built_in_scenes().size(); }
KINESPHERE_EXPORT(scene_name) const char* scene_name(std::size_t place) {
  return built_in_scenes()[place].name.c_str();
}

/// `settings` are in the order of `sceneSettings` in package/src/scene.ts; NaN keeps the scene's own value.
KINESPHERE_EXPORT(scene_create)
ks_status scene_create(std::size_t place, const double* settings, Scene** made) {
  SceneParameters parameters = built_in_scenes()[place];
  const auto set = [&](std::size_t k, auto& parameter) {
    if (settings[k] == settings[k])
      parameter = static_cast<std::remove_reference_t<decltype(parameter)>>(settings[k]);
  };
  set(0, parameters.bodies);
  set(1, parameters.seed);
  set(2, parameters.seconds);
  set(3, parameters.packing);
  set(4, parameters.radius_min);
  set(5, parameters.radius_max);
  set(6, parameters.speed_min);
  set(7, parameters.speed_max);
  set(8, parameters.limit_min);
  set(9, parameters.limit_max);
  set(10, parameters.restitution);
  set(11, parameters.contact_tolerance);
  return c::guarded([&] { *made = new Scene(make_scene(parameters).value()); });
}

KINESPHERE_EXPORT(scene_free) void scene_free(Scene* scene) { delete scene; }
KINESPHERE_EXPORT(scene_definition)
void scene_definition(const Scene* scene, ks_world_definition* definition) {
  *definition = c::c_world(scene->world);
}
KINESPHERE_EXPORT(scene_motion) MotionHandle* scene_motion(const Scene* scene) {
  return new MotionHandle{scene->motion->clone()};
}
KINESPHERE_EXPORT(scene_end_time) double scene_end_time(const Scene* scene) { return scene->end_time; }
KINESPHERE_EXPORT(scene_radii) void scene_radii(const Scene* scene) {
  answer().clear();
  for (const SceneBody& body : scene->bodies) answer().push_back(body.radius);
}

}  // namespace kinesphere::browser
