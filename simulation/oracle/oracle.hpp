// The truth, as a detector.
#pragma once

#include <memory>

#include "kinesphere/motion/motion.hpp"
#include "kinesphere/result.hpp"
#include "kinesphere/world_definition.hpp"
#include "simulation/detector/detector.hpp"

namespace kinesphere {

/// Brute force over exact trajectories: every root of every pair's distance polynomial, isolated
/// rigorously. O(n^2) memory and time. Reads trajectories, not states. Knows neither space that repeats nor
/// two dimensions: unsupported.
Result<std::unique_ptr<Detector>> make_oracle(const WorldDefinition& definition, const Motion& motion);

}  // namespace kinesphere
