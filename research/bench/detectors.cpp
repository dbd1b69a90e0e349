// The detectors that are compared, by their names in the tables.
#include "research/bench/detectors.hpp"

#include "base/program_error.hpp"
#include "research/rivals/detector_table.hpp"

namespace kinesphere::program {
namespace {

NamedDetector named(const std::string& name, const DetectorSettings& settings = {}) {
  return {name, require(detector_maker(name, settings))};
}

}  // namespace

NamedDetector paper_engine(const PaperOptions& options) { return named("paper", {.paper = options}); }

NamedDetector hubbard_engine() { return named("hubbard"); }

NamedDetector hayward_engine() { return named("hayward"); }

NamedDetector fixed_step_engine(double step) { return named("fixed-step", {.step = step}); }

NamedDetector world_engine() { return named("world"); }

NamedDetector alarm_engine(double distance) {
  return {"world", [distance](const WorldDefinition& definition, const Motion& motion) {
            return make_sensing_detector(definition, motion, {.distances = {distance}});
          }};
}

}  // namespace kinesphere::program
