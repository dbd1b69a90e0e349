#include "scene_text.hpp"

#include <fmt/format.h>

#include "scenes/scene_file.hpp"

namespace kinesphere::program {
namespace {

std::string vector_text(const Vec3& vector) {
  return fmt::format("[{}, {}, {}]", vector.x, vector.y, vector.z);
}

}  // namespace

std::string scene_text(const SceneParameters& parameters) {
  // Names every field, so that a forgotten one does not compile.
  const auto& [name, motion, bodies, radius_min, radius_max, speed_min, speed_max, limit_min, limit_max,
               gravity, box, packing, walls, periodic, redraw_interval, response, restitution, resting_speed,
               contact_tolerance, zeno_interval, seconds, seed] = parameters;
  static_cast<void>(seconds);
  return fmt::format(
      "scene {}\nmotion {}\nbodies {}\nradius {} {}\nspeed {} {}\nlimit {} {}\ngravity {}\nbox {} {}\n"
      "packing {}\nwalls {}\nperiodic {}\nredraw_interval {}\nresponse {}\nrestitution {}\n"
      "resting_speed {}\ncontact_tolerance {}\nzeno_interval {}\nseed {}\n",
      name, name_of(motion), bodies, radius_min, radius_max, speed_min, speed_max, limit_min, limit_max,
      vector_text(gravity), vector_text(box.lower), vector_text(box.upper), packing, walls, periodic,
      redraw_interval, name_of(response), restitution, resting_speed, contact_tolerance, zeno_interval, seed);
}

}  // namespace kinesphere::program
