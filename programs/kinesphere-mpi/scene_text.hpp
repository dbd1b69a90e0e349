// All parameters of a scene that decide what happens in it, as text: a line for each.
#pragma once

#include <string>

#include "simulation/scene/make_scene.hpp"

namespace kinesphere::program {

/// Two scenes with the same text go the same way for as long as both last: `seconds` is left out.
std::string scene_text(const SceneParameters& parameters);

}  // namespace kinesphere::program
