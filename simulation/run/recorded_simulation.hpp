// Replay of a recorded simulation.
#pragma once

#include <cstddef>
#include <span>

#include "kinesphere/result.hpp"
#include "simulation/run/simulate.hpp"

namespace kinesphere {

/// Returns the result of a simulation from its recording alone. Precondition: its detector was recorded from
/// SimulationObserver::at_start to at_end. Errors: as Replay::open() and Replay::advance(); the replay stops
/// at the first.
Result<SimulationResult> replay(std::span<const std::byte> recording);

}  // namespace kinesphere
