// The recording of a simulation, gone through again.
#pragma once

#include <cstddef>
#include <span>

#include "kinesphere/result.hpp"
#include "simulation/run/simulate.hpp"

namespace kinesphere {

/// What simulate() gave when its detector was recorded (SimulationObserver::at_start and at_end), from the
/// recording alone. Errors: as Replay::open() and Replay::advance(), which is where it stops.
Result<SimulationResult> replay(std::span<const std::byte> recording);

}  // namespace kinesphere
