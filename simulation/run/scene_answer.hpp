// The response of a scene to an event.
#pragma once

#include "kinesphere/event.hpp"
#include "kinesphere/run.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere {

/// Returns the velocities that the scene's response gives the bodies of an event. Masses are radius^3.
/// event.first.index is the number of a body of the scene. The result depends on the event alone, so the
/// function serves as a ResponseFn.
Response scene_answer(const Scene& scene, const Event& event);

}  // namespace kinesphere
