// Every detector that claims to miss nothing, against the oracle, on every differential scene.
#include <gtest/gtest.h>

#include <string>
#include <tuple>

#include "kinesphere/comparison.hpp"
#include "scene/differential_scenes.hpp"

namespace kinesphere::testing {
namespace {

constexpr std::uint64_t scenes_per_family = 30;

class Differential : public ::testing::TestWithParam<std::tuple<Family, std::uint64_t>> {};

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

TEST_P(Differential, world_agrees_with_oracle) {
  const auto [family, seed] = GetParam();
  const Scene scene = differential_scene(family, seed);
  const std::vector<Event> events = events_of(scene, make_world_detector);
  for (const Event& event : events) ASSERT_NE(event.kind, EventKind::bound_violation) << scene.name;
  const ContactComparison comparison = compare_with_oracle(scene, events).value();
  EXPECT_TRUE(comparison.agrees()) << scene.name << ": " << comparison.missed << " missed, "
                                   << comparison.invented << " invented; "
                                   << comparison.first_difference.value_or("");
  RecordProperty("matched", static_cast<int>(comparison.matched));
  RecordProperty("grazing", static_cast<int>(comparison.grazing));
}

std::string name_of_case(const ::testing::TestParamInfo<Differential::ParamType>& info) {
  return std::string(name_of(std::get<0>(info.param))) + "_" + std::to_string(std::get<1>(info.param));
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, Differential,
    ::testing::Combine(::testing::Values(Family::random_forces, Family::velocity_field, Family::ballistic,
                                         Family::mixed_radii, Family::pursuit, Family::bang_bang,
                                         Family::grazing, Family::at_rest, Family::bullets, Family::points,
                                         Family::tracks, Family::far_away),
                       ::testing::Range(std::uint64_t{0}, scenes_per_family)),
    name_of_case);

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
}  // namespace kinesphere::testing
