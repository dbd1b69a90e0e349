#include "research/rivals/detector_table.hpp"
#include "simulation/oracle/oracle.hpp"

#include <algorithm>
#include <string>

namespace kinesphere {
namespace {

using Made = Result<std::unique_ptr<Detector>>;

Made make_world(const WorldDefinition& definition, const Motion& motion, const DetectorSettings&) {
  return make_world_detector(definition, motion);
}

Made make_paper(const WorldDefinition& definition, const Motion& motion, const DetectorSettings& settings) {
  return make_paper_detector(definition, motion, settings.paper);
}

Made make_ballistic(const WorldDefinition& definition, const Motion& motion, const DetectorSettings&) {
  return make_ballistic_detector(definition, motion);
}

Made make_hubbard(const WorldDefinition& definition, const Motion& motion, const DetectorSettings&) {
  return make_hubbard_detector(definition, motion);
}

Made make_hayward(const WorldDefinition& definition, const Motion& motion, const DetectorSettings&) {
  return make_hayward_detector(definition, motion);
}

Made make_fixed_step(const WorldDefinition& definition, const Motion& motion,
                     const DetectorSettings& settings) {
  return make_fixed_step_detector(definition, motion, *settings.step, FixedStepSearch::grid);
}

Made make_brute_force(const WorldDefinition& definition, const Motion& motion,
                      const DetectorSettings& settings) {
  return make_fixed_step_detector(definition, motion, *settings.step, FixedStepSearch::all_pairs);
}

Made make_truth(const WorldDefinition& definition, const Motion& motion, const DetectorSettings&) {
  return make_oracle(definition, motion);
}

Error wrong(const char* argument, const std::string& expectation) {
  return {ErrorCode::out_of_range, argument, no_body, "detector_maker: " + expectation};
}

}  // namespace

const std::vector<DetectorEntry>& detector_table() {
  static const std::vector<DetectorEntry> table{
      {"world", "the engine of this library", false, false, make_world},
      {"paper", "Kim, Guibas and Shin 2005: events on hierarchical grids", false, false, make_paper},
      {"ballistic", "Kim, Guibas and Shin 1998: its ancestor, for ballistic bodies", false, true,
       make_ballistic},
      {"hubbard", "Hubbard 1995: space-time bounds and a sweep", false, false, make_hubbard},
      {"hayward", "Hayward and others 1995: a safe interval for every pair", false, false, make_hayward},
      {"fixed-step", "a grid at every time step", true, false, make_fixed_step},
      {"brute-force", "every pair at every time step", true, false, make_brute_force},
      {"oracle", "exact, from the trajectories themselves", false, false, make_truth},
  };
  return table;
}

Result<DetectorMaker> detector_maker(std::string_view name, const DetectorSettings& settings) {
  const auto& table = detector_table();
  const auto entry = std::find_if(table.begin(), table.end(),
                                  [name](const DetectorEntry& candidate) { return candidate.name == name; });
  if (entry == table.end()) {
    std::string names;
    for (const DetectorEntry& known : table) names += (names.empty() ? "" : ", ") + std::string(known.name);
    return wrong("name", "name must be one of " + names + ", but is '" + std::string(name) + "'");
  }
  if (entry->takes_step && !settings.step)
    return wrong("settings", "settings.step must be given for " + std::string(name));
  if (!entry->takes_step && settings.step)
    return wrong("settings", "settings.step must not be given for " + std::string(name));
  return DetectorMaker(
      [make = entry->make, settings](const WorldDefinition& definition, const Motion& motion) {
        return make(definition, motion, settings);
      });
}

}  // namespace kinesphere
