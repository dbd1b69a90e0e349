// Is this a scene that can be run?
#pragma once

#include <string_view>

#include "kinesphere/result.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere {

/// What neither a detector nor a motion will look at, or only too late: the scene's times, and that the
/// motion has all its bodies. `call` is who asks.
Result<void> check_times(const Scene& scene, std::string_view call);
/// That, the world and all bodies, for those who have no detector.
Result<void> check_scene(const Scene& scene, std::string_view call);

}  // namespace kinesphere
