// The detectors that are compared, by the names they have in the tables.
#include "bench/detectors.hpp"

#include "kinesphere/detector_table.hpp"
#include "program_error.hpp"

namespace kinesphere::program {
namespace {

NamedDetector named(const std::string& name, const DetectorSettings& settings = {}) {
  return {name, require(detector_maker(name, settings))};
}

}  // namespace

NamedDetector paper_engine(double cell_edge, bool trimming) {
  DetectorSettings settings;
  settings.paper.cell_edge = cell_edge;
  settings.paper.trimming = trimming;
  return named("paper", settings);
}

NamedDetector hubbard_engine(double interval, bool all_crossings) {
  DetectorSettings settings;
  settings.hubbard = {.interval = interval, .all_crossings = all_crossings};
  return named("hubbard", settings);
}

NamedDetector hayward_engine() { return named("hayward"); }

NamedDetector fixed_step_engine(double step) {
  DetectorSettings settings;
  settings.step = step;
  return named("fixed-step", settings);
}

NamedDetector world_engine() { return named("world"); }

}  // namespace kinesphere::program
