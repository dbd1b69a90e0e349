// The parameters of a scene that influence its course, as text: a line for each.
#pragma once

#include <string>

#include "simulation/scene/make_scene.hpp"

namespace kinesphere::program {

/// Scenes with equal texts have equal events while both last: `seconds` is left out.
std::string scene_text(const SceneParameters& parameters);

}  // namespace kinesphere::program
