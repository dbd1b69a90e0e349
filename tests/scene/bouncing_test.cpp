// With bounces two correct detectors drift apart, so each is held against its own run: the exact paths that
// its bodies took, bounces included. No gap may ever have fallen below the tolerance.
#include <gtest/gtest.h>

#include <string>
#include <tuple>

#include "contact/contact_event.hpp"
#include "lab/detector_table.hpp"
#include "lab/simulation/flight.hpp"
#include "lab/truth/gap_course.hpp"
#include "scene/differential_scenes.hpp"

namespace kinesphere::scene_tests::bouncing_test {
namespace {

constexpr std::uint64_t scenes_per_family = 25;
/// For the engine's rivals.
constexpr std::uint64_t rival_scenes = 1;

/// The first time at which the gap is deeper than the tolerance, from when it is first not negative.
std::optional<double> first_overlap(const GapCourse& gap, const Scene& scene) {
  const double from = scene.world.start_time;
  const auto apart = gap.first_time(LevelCrossing::rises_to, 0.0, from, scene.end_time);
  if (!apart) return std::nullopt;
  const double tolerance = scene.world.contact_tolerance;
  return gap.first_time(LevelCrossing::falls_to, -tolerance * (1.0 + 1.0 / 16.0), *apart, scene.end_time);
}

using Case = std::tuple<std::string, Family, std::uint64_t>;
class Bouncing : public ::testing::TestWithParam<Case> {};

TEST_P(Bouncing, nobody_overlaps) {
  const auto& [detector, family, seed] = GetParam();
  Scene scene = differential_scene(family, seed);
  scene.response = SceneResponse::bounce;
  scene.world.contacts = ContactMode::impacts;
  const Flight flight = record_flight(scene, detector_maker(detector).value()).value();
  ASSERT_EQ(flight.result.counters.count(EventKind::zeno_guard), 0u);
  for (std::uint32_t a = 0; a < scene.bodies.size(); ++a) {
    for (std::uint32_t b = 0; b < a; ++b) {
      const GapCourse gap(flight.paths[a], flight.paths[b], scene.bodies[a].radius + scene.bodies[b].radius);
      const auto overlap = first_overlap(gap, scene);
      ASSERT_FALSE(overlap) << "bodies " << a << " and " << b << " at time " << *overlap;
    }
    if (!scene.world.box) continue;
    for (const Wall wall : walls) {
      const HalfSpace inside = half_space(*scene.world.box, wall);
      const auto overlap = first_overlap({flight.paths[a], inside, scene.bodies[a].radius}, scene);
      ASSERT_FALSE(overlap) << "body " << a << " and wall " << name_of(wall) << " at time " << *overlap;
    }
  }
}

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const DetectorEntry& entry : detector_table()) {
    if (entry.takes_step || entry.name == "oracle") continue;
    for (const Family family :
         {Family::random_forces, Family::velocity_field, Family::ballistic, Family::points})
      for (std::uint64_t seed = 0; seed < (entry.name == "world" ? scenes_per_family : rival_scenes); ++seed)
        if (!entry.ballistic_only || family == Family::ballistic)
          cases.emplace_back(entry.name, family, seed);
  }
  return cases;
}

std::string name_of_case(const ::testing::TestParamInfo<Case>& info) {
  const auto& [detector, family, seed] = info.param;
  return detector + "_" + std::string(name_of(family)) + "_" + std::to_string(seed);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Bouncing, ::testing::ValuesIn(all_cases()), name_of_case);

}  // namespace
}  // namespace kinesphere::scene_tests::bouncing_test
