// Every detector that claims to miss nothing, against the oracle, on every differential scene.
#include <gtest/gtest.h>

#include <string>
#include <tuple>

#include "lab/detector_table.hpp"
#include "lab/truth/comparison.hpp"
#include "scene/differential_scenes.hpp"

namespace kinesphere::scene_tests::differential_test {
namespace {

constexpr std::uint64_t scenes_per_family = 30;
constexpr std::uint64_t ballistic_scenes = 100;
/// The engine's rivals are no promise to anyone: a dozen scenes each show that they are what they should be.
constexpr std::uint64_t rival_scenes = 1;
constexpr std::uint64_t scenes_of_the_ballistic_rival = 12;

std::uint64_t scenes_for(const DetectorEntry& entry, Family family) {
  if (entry.ballistic_only) return scenes_of_the_ballistic_rival;
  if (entry.name != "world") return rival_scenes;
  return family == Family::ballistic ? ballistic_scenes : scenes_per_family;
}

using Case = std::tuple<std::string, Family, std::uint64_t>;

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const DetectorEntry& entry : detector_table()) {
    if (entry.takes_step || entry.name == "oracle") continue;
    for (int index = 0; index < static_cast<int>(Family::count); ++index) {
      const Family family{index};
      if (entry.ballistic_only && family != Family::ballistic) continue;
      for (std::uint64_t seed = 0; seed < scenes_for(entry, family); ++seed)
        cases.emplace_back(entry.name, family, seed);
    }
  }
  return cases;
}

std::string name_of_case(const ::testing::TestParamInfo<Case>& info) {
  const auto& [detector, family, seed] = info.param;
  return detector + "_" + std::string(name_of(family)) + "_" + std::to_string(seed);
}

std::vector<Event> events_of(const Scene& scene, const DetectorMaker& make) {
  std::vector<Event> events;
  std::uint64_t stops = 0;
  SimulationObserver observer;
  observer.on_event = [&](const Event& event) { events.push_back(event); };
  observer.between_events = [&](const Detector& detector) {
    if (++stops % 7 != 0) return;
    const auto finding = detector.audit();
    ASSERT_FALSE(finding) << finding->where << ": " << finding->what << " at time " << detector.time();
  };
  EXPECT_TRUE(simulate(scene, make, observer));
  return events;
}

class Differential : public ::testing::TestWithParam<Case> {};

TEST_P(Differential, agrees_with_oracle) {
  const auto& [detector, family, seed] = GetParam();
  const Scene scene = differential_scene(family, seed);
  const std::vector<Event> events = events_of(scene, detector_maker(detector).value());
  for (const Event& event : events) ASSERT_NE(event.kind, EventKind::bound_violation) << scene.name;
  const ContactComparison comparison = compare_with_oracle(scene, events).value();
  EXPECT_TRUE(comparison.agrees()) << scene.name << ": " << comparison.late << " late, " << comparison.missed
                                   << " missed, " << comparison.invented << " invented; "
                                   << comparison.first_difference.value_or("");
  RecordProperty("matched", static_cast<int>(comparison.matched));
  RecordProperty("grazing", static_cast<int>(comparison.grazing));
}

INSTANTIATE_TEST_SUITE_P(Scenes, Differential, ::testing::ValuesIn(all_cases()), name_of_case);

/// Agreement means little where nothing happens.
TEST(DifferentialFamilies, have_contacts) {
  for (int index = 0; index < static_cast<int>(Family::count); ++index) {
    const Family family{index};
    std::uint64_t contacts = 0;
    for (std::uint64_t seed = 0; seed < scenes_per_family; ++seed)
      contacts += simulate(differential_scene(family, seed), make_world_detector)
                      .value()
                      .counters.count(EventKind::contact_begin);
    EXPECT_GE(contacts, 30u) << name_of(family);
  }
}

}  // namespace
}  // namespace kinesphere::scene_tests::differential_test
