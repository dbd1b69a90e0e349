#include "scene_text.hpp"

#include <fmt/format.h>

#include "scene_file.hpp"

namespace kinesphere::program {
namespace {

std::string text_of(const Vec3& vector) { return fmt::format("[{}, {}, {}]", vector.x, vector.y, vector.z); }

}  // namespace

std::string scene_text(const SceneParameters& parameters) {
  // Names every field: one that is forgotten does not compile.
  const auto& [name, motion, bodies, radius_min, radius_max, speed_min, speed_max, limit_min, limit_max,
               gravity, box, packing, walls, periodic, redraw_interval, response, restitution, resting_speed,
               contact_tolerance, zeno_interval, seconds, seed] = parameters;
  static_cast<void>(seconds);
  return fmt::format(
      "{}: {}, {} bodies, radius {} to {}, speed {} to {}, limit {} to {}, gravity {}, box {} to {}, packing "
      "{}, walls {}, periodic {}, redraw_interval {}, response {}, restitution {}, resting_speed {}, "
      "contact_tolerance {}, zeno_interval {}, seed {}",
      name, name_of(motion), bodies, radius_min, radius_max, speed_min, speed_max, limit_min, limit_max,
      text_of(gravity), text_of(box.lower), text_of(box.upper), packing, walls, periodic, redraw_interval,
      name_of(response), restitution, resting_speed, contact_tolerance, zeno_interval, seed);
}

}  // namespace kinesphere::program
