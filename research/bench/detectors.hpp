// The detectors that are compared, by their names in the tables.
#pragma once

#include "research/rivals/rivals.hpp"
#include "scenes/named_detector.hpp"

namespace kinesphere::program {

NamedDetector paper_engine(const PaperOptions& options = {});
NamedDetector hubbard_engine();
NamedDetector hayward_engine();
NamedDetector fixed_step_engine(double step);
NamedDetector world_engine();
/// Returns the default engine with a sensor of this distance (length) on every body.
NamedDetector alarm_engine(double distance);

}  // namespace kinesphere::program
