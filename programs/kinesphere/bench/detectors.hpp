// The detectors that are compared, by the names they have in the tables.
#pragma once

#include <string>

#include "kinesphere/scene.hpp"

namespace kinesphere::program {

struct NamedDetector {
  std::string name;
  DetectorMaker make;
};

/// `cell_edge` of its finest grid (length), 0: as its cost model chooses; `trimming` as in section 3.3.
NamedDetector paper_engine(double cell_edge = 0.0, bool trimming = true);
/// Options as HubbardOptions.
NamedDetector hubbard_engine(double interval = 0.0, bool all_crossings = false);
NamedDetector hayward_engine();
NamedDetector fixed_step_engine(double step);
NamedDetector world_engine();

}  // namespace kinesphere::program
