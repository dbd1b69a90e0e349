// The algorithms of other papers on differential scenes, one of each family: they are implemented correctly.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "research/rivals/rivals.hpp"
#include "support/differential_checks.hpp"

namespace kinesphere::scene_tests::rivals_differential_test {
namespace {

constexpr std::uint64_t scenes_of_ballistic = 12;

using Case = std::tuple<std::string, Family, std::uint64_t>;

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const DetectorEntry& entry : detector_table()) {
    if (entry.takes_step || entry.name == "oracle" || entry.name == "world") continue;
    for (int index = 0; index < static_cast<int>(Family::count); ++index) {
      const Family family{index};
      if (entry.ballistic_only && family != Family::ballistic) continue;
      const std::uint64_t scenes = entry.ballistic_only ? scenes_of_ballistic : 1;
      for (std::uint64_t seed = 0; seed < scenes; ++seed) cases.emplace_back(entry.name, family, seed);
    }
  }
  return cases;
}

std::vector<Case> bouncing_cases() {
  std::vector<Case> cases;
  for (const Case& each : all_cases()) {
    const auto& [detector, family, seed] = each;
    const bool bounces = std::find(std::begin(bouncing_families), std::end(bouncing_families), family) !=
                         std::end(bouncing_families);
    if (bounces && seed == 0) cases.push_back(each);
  }
  return cases;
}

std::string name_of_case(const ::testing::TestParamInfo<Case>& info) {
  const auto& [detector, family, seed] = info.param;
  return detector + "_" + std::string(name_of(family)) + "_" + std::to_string(seed);
}

class RivalsDifferential : public ::testing::TestWithParam<Case> {};

TEST_P(RivalsDifferential, agree_with_oracle) {
  const auto& [detector, family, seed] = GetParam();
  expect_agreement_with_oracle(differential_scene(family, seed), detector_maker(detector).value());
}

INSTANTIATE_TEST_SUITE_P(Scenes, RivalsDifferential, ::testing::ValuesIn(all_cases()), name_of_case);

class RivalsBouncing : public ::testing::TestWithParam<Case> {};

TEST_P(RivalsBouncing, nobody_overlaps) {
  const auto& [detector, family, seed] = GetParam();
  expect_no_overlaps(differential_scene(family, seed), detector_maker(detector).value());
}

INSTANTIATE_TEST_SUITE_P(Scenes, RivalsBouncing, ::testing::ValuesIn(bouncing_cases()), name_of_case);

}  // namespace
}  // namespace kinesphere::scene_tests::rivals_differential_test
