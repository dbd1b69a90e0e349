// Which bodies are probed, and when: only if the existing reports are not sufficient.
#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "kinesphere/certificates.hpp"
#include "kinesphere/inspection.hpp"
#include "kinesphere/response.hpp"
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
  BodyId far = add({.radius = 1, .velocity_error = 1e-9, .position = {1000, 0, 0}});
};

TEST_P(TwoAtRest, AreProbedWhenTheirBoundsMeet) {
  run(2.12);
  EXPECT_EQ(probes(), 0u);
  run(2.13);
  EXPECT_EQ(probes(), 1u);
}

TEST_P(TwoAtRest, AreNotProbedAsLongAsALaterReportSuffices) {
  world.certificates(probe()).distance_limits(a, far, 2.0).value();
  const std::uint64_t before = probes();
  run(2.87);  // until s^2 + (s - 2)^2 = 9
  EXPECT_EQ(probes(), before);
  run(2.88);
  EXPECT_EQ(probes(), before + 1);
  EXPECT_FALSE(world.inspection().audit());
}

/// In the second case the two sense each other from the start.
INSTANTIATE_TEST_SUITE_P(Distances, TwoAtRest,
                         testing::Values(std::vector<double>{1.0}, std::vector<double>{1.0, 50.0}));

/// A response parts the two, so the pair need not be checked again.
TEST(ExactBodies, AreProbedTogetherOnceForTheirContact) {
  Playground p({.contacts = ContactEvents::impacts});
  const BodyId a = p.add({.radius = 0.5, .position = {-5, 0, 0}, .velocity = {1, 0, 0}});
  const BodyId b = p.add({.radius = 0.5, .position = {5, 0.3, 0}, .velocity = {-1, 0, 0}});
  // Spot checks come as well, but at other times.
  std::vector<std::pair<double, std::vector<BodyId>>> calls;
  const auto probe = [&](std::span<const BodyId> ids, double time, std::span<State> states) {
    calls.emplace_back(time, std::vector(ids.begin(), ids.end()));
    for (std::size_t k = 0; k < ids.size(); ++k) states[k] = p.state(ids[k], time);
  };
  std::vector<Event> events;
  for (const Event& event : p.world.events(20.0, probe)) {
    events.push_back(event);
    const Bounce after = bounce(event, 1.0);
    p.set_velocity(event.first, after.first_velocity);
    p.set_velocity(event.second, after.second_velocity);
  }
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, EventKind::contact_begin);
  const std::size_t all = calls.size();
  std::erase_if(calls, [&](const auto& call) { return call.first != events[0].time; });
  ASSERT_EQ(calls.size(), 1u);
  EXPECT_EQ(std::set(calls[0].second.begin(), calls[0].second.end()), (std::set{a, b}));
  const Counters& counters = p.world.counters();
  EXPECT_EQ(counters.pair_checks, 1u);
  // Each looks for the other when it arrives; then the two are due, and have bounced.
  EXPECT_EQ(counters.certificates, 4u);
  EXPECT_EQ(counters.probes, 2u * all);
}

}  // namespace
}  // namespace kinesphere::probes_test
