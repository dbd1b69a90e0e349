// A scene as Python has it.
#pragma once

#include <utility>

#include "simulation/scene/make_scene.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere::python {

/// A scene with the parameters that it was made from.
struct SceneHandle : Scene {
  SceneHandle(Scene made, SceneParameters given) : Scene(std::move(made)), parameters(std::move(given)) {}
  SceneParameters parameters;
};

}  // namespace kinesphere::python
