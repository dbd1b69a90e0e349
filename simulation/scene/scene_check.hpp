// Checks of scenes before they are run.
#pragma once

#include <string_view>

#include "kinesphere/result.hpp"
#include "simulation/scene/scene.hpp"

namespace kinesphere {

/// Checks what detector and motion do not check, or check too late: the scene's times, its turns, and that
/// the motion has all its bodies. `call` is the name of the caller in the message.
Result<void> check_times(const Scene& scene, std::string_view call);
/// Checks the times, the world and all bodies, for callers without a detector. `call` is the name of the
/// caller in the message.
Result<void> check_scene(const Scene& scene, std::string_view call);

}  // namespace kinesphere
