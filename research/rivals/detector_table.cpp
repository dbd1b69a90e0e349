#include <algorithm>
#include <string>

#include "research/rivals/rivals.hpp"
#include "simulation/oracle/oracle.hpp"

namespace kinesphere {
namespace {

Error wrong(const char* argument, const std::string& expectation) {
  return {ErrorCode::out_of_range, argument, no_body, "detector_maker: " + expectation};
}

}  // namespace

const std::vector<DetectorEntry>& detector_table() {
  using Definition = const WorldDefinition&;
  using Moves = const Motion&;
  using Settings = const DetectorSettings&;
  static const std::vector<DetectorEntry> table{
      {"world", false, false,
       [](Definition world, Moves motion, Settings) { return make_world_detector(world, motion); }},
      {"paper", false, false,
       [](Definition world, Moves motion, Settings settings) {
         return make_paper_detector(world, motion, settings.paper);
       }},
      {"ballistic", false, true,
       [](Definition world, Moves motion, Settings) { return make_ballistic_detector(world, motion); }},
      {"hubbard", false, false,
       [](Definition world, Moves motion, Settings) { return make_hubbard_detector(world, motion); }},
      {"hayward", false, false,
       [](Definition world, Moves motion, Settings) { return make_hayward_detector(world, motion); }},
      {"fixed-step", true, false,
       [](Definition world, Moves motion, Settings settings) {
         return make_fixed_step_detector(world, motion, *settings.step, FixedStepSearch::grid);
       }},
      {"brute-force", true, false,
       [](Definition world, Moves motion, Settings settings) {
         return make_fixed_step_detector(world, motion, *settings.step, FixedStepSearch::all_pairs);
       }},
      {"oracle", false, false,
       [](Definition world, Moves motion, Settings) { return make_oracle(world, motion); }},
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
