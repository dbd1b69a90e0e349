// Which bodies are probed, and when: only if the existing reports are not sufficient.
#include <gtest/gtest.h>

#include <vector>

#include "support/playground.hpp"

namespace kinesphere::probes_test {
namespace {

/// Two bodies at rest that could be within 1 of each other when both bounds have grown by 4.5; their reports
/// are of time 0. A third body, far away, gives them swept spheres that last much longer.
struct TwoAtRest : Playground, testing::WithParamInterface<std::vector<double>>, testing::Test {
  TwoAtRest() {
    world.set_sensor(0, {.distances = GetParam()}).value();
    run(2.0);
  }
  std::uint64_t probes() const { return world.counters().probes; }

  BodyId a = add({.radius = 1, .acceleration_limit = 2}, Vec3{});
  BodyId b = add({.radius = 1, .acceleration_limit = 2, .position = {12, 0, 0}}, Vec3{});
  BodyId far = add({.radius = 1, .position = {1000, 0, 0}});
};

TEST_P(TwoAtRest, AreProbedWhenTheirBoundsMeet) {
  run(2.12);
  EXPECT_EQ(probes(), 0u);
  run(2.13);
  EXPECT_EQ(probes(), 1u);
}

TEST_P(TwoAtRest, AreNotProbedAsLongAsALaterReportSuffices) {
  world.distance_limits(a, far, 2.0, probe()).value();
  const std::uint64_t before = probes();
  run(2.87);  // until s^2 + (s - 2)^2 = 9
  EXPECT_EQ(probes(), before);
  run(2.88);
  EXPECT_EQ(probes(), before + 1);
  EXPECT_FALSE(world.audit());
}

/// In the second case the two sense each other from the start.
INSTANTIATE_TEST_SUITE_P(Distances, TwoAtRest,
                         testing::Values(std::vector<double>{1.0}, std::vector<double>{1.0, 50.0}));

}  // namespace
}  // namespace kinesphere::probes_test
