// One set of bodies on its way through time: what is due is found, delivered and certified again.
#include "processor/event_processor.hpp"

#include <gtest/gtest.h>

#include "kinesphere/random.hpp"
#include "support/small_world.hpp"

namespace kinesphere::event_processor_test {
namespace {

constexpr std::uint64_t seed = 5201;

TEST(EventProcessor, FindsContactsAtTheirTimes) {
  SCOPED_TRACE(seed);
  for (std::uint64_t k = 0; k < 200; ++k) {
    SCOPED_TRACE(k);
    Random random = Random::at(seed, 0, k);
    const double closing = random.uniform(0.5, 2.0);
    const double gap = random.uniform(0.5, 3.0);
    const Vec3 direction = random.unit_vector();
    const Vec3 both = random.point_in_ball();
    SmallWorld world;
    world.add({.acceleration_limit = random.uniform(), .velocity = both});
    world.add({.acceleration_limit = random.uniform(),
               .position = direction * (2.0 + gap),
               .velocity = both - direction * closing});
    const auto event = world.advance(100.0);
    ASSERT_TRUE(event);
    EXPECT_EQ(event->kind, EventKind::contact_begin);
    EXPECT_NEAR(event->time, gap / closing, 2e-6 / closing) << "within the tolerance";
    EXPECT_NEAR(event->approach_speed, closing, 1e-9);
    EXPECT_EQ(event->time, world.main.time());
    // The two swap their velocities along the normal, and part.
    world.set_velocity(0, both - direction * closing * 0.5);
    world.set_velocity(1, both + direction * closing * 0.5);
    const auto end = world.advance(100.0);
    ASSERT_TRUE(end);
    EXPECT_EQ(end->kind, EventKind::contact_end);
    EXPECT_GT(end->time, event->time);
    EXPECT_EQ(world.advance(200.0), std::nullopt);
    EXPECT_EQ(world.main.time(), 200.0);
    EXPECT_TRUE(world.main.is_certified());
  }
}

TEST(EventProcessor, CountsWhatItDoes) {
  SmallWorld world;
  world.add({.acceleration_limit = 0.1, .velocity = {1, 0, 0}});
  world.add({.acceleration_limit = 0.1, .position = {4, 0, 0}});
  ASSERT_TRUE(world.advance(10.0));
  const Counters& counters = world.main.counters();
  EXPECT_EQ(counters.count(EventKind::contact_begin), 1u);
  EXPECT_GT(counters.probes, 0u);
  EXPECT_GE(counters.restarts, 2u) << "both were added";
  EXPECT_GT(counters.pair_checks, 0u);
  EXPECT_GT(world.main.bytes(), 0u);
}

TEST(EventProcessor, ForgetsWhatIsKnownOfPairsWhereABodyChanges) {
  SmallWorld world;
  world.add({.velocity = {1, 0, 0}});
  world.add({.position = {8, 0, 0}});
  ASSERT_TRUE(world.main.recertify());
  EXPECT_TRUE(world.main.is_recertified());
  PairTimes& known = world.main.pair_times();
  known.keep(world.state.bodies, 0, 1, 6.0, 0.0);
  EXPECT_EQ(known.find(world.state.bodies, 1, 0), 6.0);
  world.set_velocity(0, {-1, 0, 0});
  EXPECT_EQ(known.find(world.state.bodies, 1, 0), -infinity);
  EXPECT_FALSE(world.main.is_recertified());
  EXPECT_EQ(world.main.dirty().numbers(), (std::vector<std::uint32_t>{0}));
  EXPECT_EQ(world.advance(100.0), std::nullopt) << "they fly apart now";
}

TEST(EventProcessor, DetachEndsContactsAndTheRegistration) {
  SmallWorld world;
  world.add({.velocity = {1, 0, 0}});
  world.add({.position = {3, 0, 0}});
  ASSERT_TRUE(world.advance(10.0));
  ASSERT_TRUE(world.state.contacts.touch(0, 1));
  world.main.detach(0);
  world.state.bodies[0].enabled = false;
  EXPECT_FALSE(world.state.contacts.touch(0, 1));
  EXPECT_FALSE(world.state.core.contains(0));
  const auto end = world.advance(10.0);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->kind, EventKind::contact_end);
  EXPECT_EQ(world.advance(10.0), std::nullopt);
}

TEST(EventProcessor, ReportsThatBreakTheirBoundsAreEvents) {
  SmallWorld world;
  world.add({.acceleration_limit = 0.1, .velocity = {1, 0, 0}});
  world.add({.acceleration_limit = 0.1, .position = {9, 0, 0}});
  ASSERT_EQ(world.advance(1.0), std::nullopt);
  world.origins[0] = {1.0, {{1.0, 0, 0}, {1.5, 0, 0}}};  // unseen by the engine
  const auto events = world.advance_all(6.0);
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events.front().kind, EventKind::bound_violation);
  EXPECT_EQ(events.front().first.index, 0u);
  EXPECT_GT(events.front().position_excess + events.front().velocity_excess, 0.0);
  EXPECT_EQ(events.back().kind, EventKind::contact_begin) << "it goes on from the new report";
  EXPECT_GE(events.back().time, 1.0 + 6.0 / 1.5) << "when they meet, or when the engine asks next";
  EXPECT_EQ(events.back().time, events.front().time);
}

TEST(EventProcessor, HasAPauseAtTheNextSpotCheck) {
  SmallWorld world;
  EXPECT_EQ(world.main.pause(), infinity);
  world.state.spot_checks.note_arrival(4.0);
  EXPECT_EQ(world.main.pause(), 4.0);
}

}  // namespace
}  // namespace kinesphere::event_processor_test
