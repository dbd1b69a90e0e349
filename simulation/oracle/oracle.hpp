// The oracle: the truth, as a detector.
#pragma once

#include <memory>

#include "kinesphere/motion/motion.hpp"
#include "kinesphere/result.hpp"
#include "kinesphere/world_definition.hpp"
#include "simulation/detector/detector.hpp"

namespace kinesphere {

/// Makes the oracle: brute force over exact trajectories, with each root of each pair's distance polynomial
/// isolated rigorously. It reads trajectories, not states. Cost and memory: O(n^2). Errors: unsupported for
/// periodic space and for two dimensions.
Result<std::unique_ptr<Detector>> make_oracle(const WorldDefinition& definition, const Motion& motion);

}  // namespace kinesphere
