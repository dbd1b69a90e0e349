// Replay of a recorded run of a scene.
#pragma once

#include <cstddef>
#include <span>

#include "kinesphere/result.hpp"
#include "simulation/run/run_scene.hpp"

namespace kinesphere {

/// Returns the result of run_scene() from its recording alone. Precondition: its detector was recorded from
/// SceneObserver::at_start to at_end. Errors: as Replay::open() and Replay::advance(); the replay stops
/// at the first.
Result<SceneResult> replay(std::span<const std::byte> recording);

}  // namespace kinesphere
