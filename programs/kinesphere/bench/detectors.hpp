// The detectors that are compared, by the names they have in the tables.
#pragma once

#include <string>

#include "lab/detector/detector.hpp"
#include "lab/rivals/rivals.hpp"
#include "lab/scene/scene.hpp"

namespace kinesphere::program {

struct NamedDetector {
  std::string name;
  DetectorMaker make;
};

NamedDetector paper_engine(const PaperOptions& options = {});
NamedDetector hubbard_engine();
NamedDetector hayward_engine();
NamedDetector fixed_step_engine(double step);
NamedDetector world_engine();
/// The default engine with a sensor of this distance on every body.
NamedDetector alarm_engine(double distance);

}  // namespace kinesphere::program
