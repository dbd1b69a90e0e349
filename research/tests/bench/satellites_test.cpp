// Approaches of satellites: the monitor against all pairs by brute force.
#include <gtest/gtest.h>

#include "program/support.hpp"
#include "research/bench/satellite_file.hpp"
#include "research/satellites/monitor_satellites.hpp"
#include "research/satellites/step_satellites.hpp"
#include "research/satellites/true_approaches.hpp"

namespace kinesphere::program::satellites_test {
namespace {

TEST(Satellites, TheMonitorTellsOfAllApproachesAndOfNothingElse) {
  const std::string file = recording("satellites/states_celestrak_2026-05-30.csv.gz");
  if (file.empty()) GTEST_SKIP() << "no satellites (see KINESPHERE_DATA)";
  const std::vector<State> states = read_satellites(file);
  ASSERT_EQ(states.size(), 11931u);
  const SatelliteMotion motion = SatelliteMotion::create(states).value();
  constexpr double until = 1500.0, distance = 5.0;
  const SatelliteWatch watch = monitor_satellites(motion, until, {.distance = distance}).value();
  const auto truth = true_approaches(motion, until, distance);
  EXPECT_GT(truth.size(), 500u);
  EXPECT_TRUE(not_inside(truth, watch.approaches).empty());
  EXPECT_TRUE(not_within(motion, watch.approaches, distance + 1e-3 + 1e-4).empty());
  EXPECT_EQ(watch.undecided_time, 0.0);
  EXPECT_EQ(watch.counters.contradictions, 0u);
  // Steps see little of what passes at 10 km/s, but nothing that the monitor does not see.
  const auto stepped = step_satellites(motion, until, distance, 10.0);
  EXPECT_TRUE(not_inside(stepped, watch.approaches, 10.0).empty());
  EXPECT_GT(not_met(truth, stepped).size(), truth.size() / 2);
}

class SatellitesProgram : public ProgramTest {};

TEST_F(SatellitesProgram, SatellitesThatAreNoneAreRefused) {
  const std::string file =
      write("states.csv", "# km, km/s\ni,x,y,z,vx,vy,vz\n0,7000,0,0,0,7.5,0\n1,7000,0,0,0,x,0\n");
  expect_wrong_input("satellites " + file, {"states.csv", "line 4", "vy"});
}

}  // namespace
}  // namespace kinesphere::program::satellites_test
