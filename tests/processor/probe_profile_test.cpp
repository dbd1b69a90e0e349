// Which bodies are probed most, and why.
#include "processor/probe_profile.hpp"

#include <gtest/gtest.h>

#include "bodies/body_bounds.hpp"

namespace kinesphere::probe_profile_test {
namespace {

using Numbers = std::vector<std::uint32_t>;

class ProbeProfileTest : public testing::Test {
 protected:
  ProbeProfileTest() {
    for (int body = 0; body < 4; ++body) {
      bodies.add({}, 0.0);
      bodies[static_cast<std::uint32_t>(body)].bound.acceleration_limit = 8.0;
    }
  }
  void probe(std::uint32_t number, ProbeCause cause, int times) {
    for (int k = 0; k < times; ++k) profile.note_probes(bodies.table(), Numbers{number}, cause);
  }

  Bodies bodies{WorldDefinition{}};
  ProbeProfile profile;
};

TEST_F(ProbeProfileTest, PutsThoseWithMostProbesFirst) {
  probe(2, ProbeCause::region, 3);
  probe(0, ProbeCause::near, 9);
  probe(3, ProbeCause::query, 3);
  const std::vector<BusyBody> busiest = profile.busiest(bodies, 10);
  ASSERT_EQ(busiest.size(), 3u) << "a body without probes is not busy";
  EXPECT_EQ(busiest[0].body, bodies.id_of(0));
  EXPECT_EQ(busiest[0].probes, 9u);
  EXPECT_EQ(busiest[0].near, 9u);
  EXPECT_EQ(busiest[1].body, bodies.id_of(2)) << "of equally busy ones, the one with the smaller number";
  EXPECT_EQ(busiest[2].reason, ProbeReason::queries);
  EXPECT_EQ(profile.busiest(bodies, 1).size(), 1u);
}

TEST_F(ProbeProfileTest, ForgetsABodyWhoseNumberIsUsedAgain) {
  probe(1, ProbeCause::near, 5);
  bodies.remove(1);
  EXPECT_TRUE(profile.busiest(bodies, 10).empty());
  ASSERT_EQ(bodies.add({}, 0.0), 1u);
  EXPECT_TRUE(profile.busiest(bodies, 10).empty());
  probe(1, ProbeCause::near, 2);
  EXPECT_EQ(profile.busiest(bodies, 10).front().probes, 2u);
}

TEST_F(ProbeProfileTest, ShowsTheAccelerationThatReportsProve) {
  probe(0, ProbeCause::near, 9);
  profile.note_report(0, {.time = 0.0, .velocity = {1, 0, 0}}, {.time = 2.0, .velocity = {1, 3, 0}});
  profile.note_report(0, {.time = 2.0, .velocity = {1, 3, 0}, .growth_speed = 0.5},
                      {.time = 4.0, .velocity = {1, 5, 0}, .growth_speed = 0.5});
  const BusyBody busy = profile.busiest(bodies, 1).front();
  EXPECT_NEAR(busy.largest_acceleration, 1.5, 1e-6) << "errors of the second pair may explain half of it";
  EXPECT_LE(busy.largest_acceleration, 1.5);
  EXPECT_EQ(busy.acceleration_limit, 8.0);
  EXPECT_EQ(busy.reason, ProbeReason::loose_limit) << "8 is more than four times 1.5";
}

TEST_F(ProbeProfileTest, TellsWhatMostProbesAreFor) {
  for (std::uint32_t number = 0; number < 4; ++number) {
    probe(number, ProbeCause::near, 1);
    profile.note_report(number, {.time = 0.0}, {.time = 1.0, .velocity = {7, 0, 0}});  // no loose limit
  }
  const auto reason_of = [&](std::uint32_t number) {
    for (const BusyBody& busy : profile.busiest(bodies, 4))
      if (busy.body == bodies.id_of(number)) return busy.reason;
    return ProbeReason::queries;
  };
  EXPECT_EQ(reason_of(0), ProbeReason::narrow_misses);
  Event contact{.kind = EventKind::contact_begin, .first = bodies.id_of(0), .second = bodies.id_of(1)};
  profile.note_event(bodies.table(), contact);
  EXPECT_EQ(reason_of(0), ProbeReason::contacts) << "one contact explains some probes";
  probe(2, ProbeCause::touching, 20);
  EXPECT_EQ(reason_of(2), ProbeReason::touching);
  probe(3, ProbeCause::region, 20);
  EXPECT_EQ(reason_of(3), ProbeReason::travel);
  probe(3, ProbeCause::change, 30);
  EXPECT_EQ(reason_of(3), ProbeReason::changes);
  EXPECT_GT(profile.bytes(), sizeof profile);
}

}  // namespace
}  // namespace kinesphere::probe_profile_test
