// Scenes by name or from JSON files.
//
//   { "name": "sparse", "motion": "random_forces", "bodies": 500, "radius": [0.1, 10], "speed": [4, 40],
//     "limit": [10, 20], "gravity": [0, 0, 0], "box": [[0, 0, 0], [200, 200, 200]], "walls": true,
//     "redraw_interval": 0.2, "response": "bounce", "restitution": 1, "contact_tolerance": 1e-6,
//     "seconds": 15, "seed": 1 }
//
// The fields are those of SceneParameters, with each pair of limits as [least, largest]; what is left
// out keeps its default.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "simulation/scene/make_scene.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere::program {

struct SceneSource {
  SceneParameters parameters;
  std::string file;                               ///< empty for a built-in scene
  std::map<std::string, int, std::less<>> lines;  ///< line of each field that the file sets
};

/// Parses the text of a scene. `file` appears in messages only. Throws ProgramError naming file, line and
/// expectation if the text is not JSON, or has a duplicate field, an unknown field or a field of the wrong
/// type.
SceneSource parse_scene(std::string_view text, const std::string& file);

/// Returns the built-in scene of that name, or else the scene in that file. Throws ProgramError.
SceneSource find_scene(const std::string& name_or_file);

/// Calls make_scene(); errors name the file and the line of the field that has the wrong value.
Scene make_scene(const SceneSource& source);

std::string_view name_of(SceneParameters::MotionKind motion);
std::string_view name_of(SceneResponse response);
/// Returns the motion of that name. Throws ProgramError naming `where`, the valid names and `text`.
SceneParameters::MotionKind motion_named(std::string_view text, std::string_view where);
SceneResponse response_named(std::string_view text, std::string_view where);

}  // namespace kinesphere::program
