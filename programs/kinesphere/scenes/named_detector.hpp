// The detector that a command runs: always the world in `kinesphere`; research/bench compares others.
#pragma once

#include <string>

#include "simulation/detector/detector.hpp"

namespace kinesphere::program {

struct NamedDetector {
  std::string name = "world";  ///< in tables and summaries
  DetectorMaker make = make_world_detector;
};

}  // namespace kinesphere::program
