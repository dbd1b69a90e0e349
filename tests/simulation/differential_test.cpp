// The world on every differential scene: the oracle's contacts, and no overlap where bodies bounce.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "simulation/run/run_scene.hpp"
#include "support/differential_checks.hpp"

namespace kinesphere::scene_tests::differential_test {
namespace {

constexpr std::uint64_t scenes_per_family = 30;
constexpr std::uint64_t ballistic_scenes = 100;
constexpr std::uint64_t bouncing_scenes = 25;

using Case = std::tuple<Family, std::uint64_t>;

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (int index = 0; index < static_cast<int>(Family::count); ++index) {
    const Family family{index};
    const std::uint64_t scenes = family == Family::ballistic ? ballistic_scenes : scenes_per_family;
    for (std::uint64_t seed = 0; seed < scenes; ++seed) cases.emplace_back(family, seed);
  }
  return cases;
}

std::vector<Case> bouncing_cases() {
  std::vector<Case> cases;
  for (const Family family : bouncing_families)
    for (std::uint64_t seed = 0; seed < bouncing_scenes; ++seed) cases.emplace_back(family, seed);
  return cases;
}

std::string name_of_case(const ::testing::TestParamInfo<Case>& info) {
  const auto& [family, seed] = info.param;
  return std::string(name_of(family)) + "_" + std::to_string(seed);
}

class Differential : public ::testing::TestWithParam<Case> {};

TEST_P(Differential, agrees_with_oracle) {
  const auto& [family, seed] = GetParam();
  expect_agreement_with_oracle(differential_scene(family, seed), make_world_detector);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Differential, ::testing::ValuesIn(all_cases()), name_of_case);

class Bouncing : public ::testing::TestWithParam<Case> {};

TEST_P(Bouncing, nobody_overlaps) {
  const auto& [family, seed] = GetParam();
  expect_no_overlaps(differential_scene(family, seed), make_world_detector);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Bouncing, ::testing::ValuesIn(bouncing_cases()), name_of_case);

/// Agreement means little where nothing happens.
TEST(DifferentialFamilies, have_contacts) {
  for (int index = 0; index < static_cast<int>(Family::count); ++index) {
    const Family family{index};
    std::uint64_t contacts = 0;
    for (std::uint64_t seed = 0; seed < scenes_per_family; ++seed)
      contacts += run_scene(differential_scene(family, seed), make_world_detector)
                      .value()
                      .counters.count(EventKind::contact_begin);
    EXPECT_GE(contacts, 30u) << name_of(family);
  }
}

}  // namespace
}  // namespace kinesphere::scene_tests::differential_test
