// What the bodies of a scene do at an event.
#pragma once

#include "kinesphere/event.hpp"
#include "kinesphere/run.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere {

/// The velocities that the bodies of an event have from then on, as the scene's response says. Masses are
/// radius^3, and event.first.index is the number of a body of the scene. It depends on the event alone, so it
/// serves as a Respond.
Response scene_answer(const Scene& scene, const Event& event);

}  // namespace kinesphere
