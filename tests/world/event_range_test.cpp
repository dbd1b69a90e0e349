// A range-for over a world's events.
#include <gtest/gtest.h>

#include <iterator>
#include <ranges>

#include "kinesphere/motion/ballistic.hpp"
#include "support/playground.hpp"

namespace kinesphere::event_range_test {
namespace {

static_assert(std::input_iterator<EventRange::Iterator>);
static_assert(std::sentinel_for<std::default_sentinel_t, EventRange::Iterator>);
static_assert(std::ranges::input_range<EventRange>);

/// A ball that passes three others, at 4, 8 and 12 time units.
struct Passage {
  Ballistic motion =
      Ballistic::create(
          {.start = {{{0, 0, 0}, {1, 0, 0}}, {{6, 0, 0}, {}}, {{10, 0, 0}, {}}, {{14, 0, 0}, {}}}})
          .value();
  World world = World::create({}).value();

  Passage() {
    for (std::uint32_t k = 0; k < motion.size(); ++k) world.add(motion.definition(k, 0.0)).value();
  }
};

TEST(EventRange, GivesTheEventsThatAdvanceGives) {
  Passage ranged, advanced;
  std::vector<double> found, expected;
  for (const Event& event : ranged.world.events(100.0, ranged.motion.probe())) {
    EXPECT_EQ(ranged.world.time(), event.time);
    found.push_back(event.time);
  }
  while (const auto event = advanced.world.advance(100.0, advanced.motion.probe()).value())
    expected.push_back(event->time);
  EXPECT_EQ(found, expected);
  EXPECT_EQ(found.size(), 6u) << "three begins and three ends";
  EXPECT_EQ(ranged.world.time(), 100.0);
}

TEST(EventRange, ThatIsLeftEarlyStopsAtItsEventAndAnotherGoesOn) {
  Passage passage;
  World& world = passage.world;
  for (const Event& event : world.events(100.0, passage.motion.probe())) {
    EXPECT_NEAR(event.time, 4.0, 1e-5);
    break;
  }
  EXPECT_NEAR(world.time(), 4.0, 1e-5);
  std::size_t later = 0;
  for (const Event& event : world.events(100.0, passage.motion.probe())) later += event.time > 4.0 ? 1u : 0u;
  EXPECT_EQ(later, 5u);
}

TEST(EventRange, OwnsAProbeThatIsWrittenInPlace) {
  Passage passage;
  const std::array<double, 40> ballast{1.0};
  std::size_t count = 0;
  for (const Event& event :
       passage.world.events(100.0, [&motion = passage.motion, ballast](std::span<const BodyId> ids,
                                                                       double time, std::span<State> states) {
         for (std::size_t k = 0; k < ids.size(); ++k)
           states[k] = motion.state(ids[k].index, ballast[0] * time);
       }))
    count += event.second == no_body ? 0u : 1u;
  EXPECT_EQ(count, 6u);
}

TEST(EventRange, AllowsChangesBetweenEvents) {
  Passage passage;
  std::vector<EventKind> kinds;
  for (const Event& event : passage.world.events(100.0, passage.motion.probe())) {
    kinds.push_back(event.kind);
    if (event.kind == EventKind::contact_begin) passage.world.remove(event.second).value();
  }
  EXPECT_EQ(kinds.size(), 6u) << "an event of a removed body is reported as well";
  EXPECT_EQ(passage.world.size(), 1u);
}

TEST(EventRange, ThrowsWhatAdvanceRefuses) {
  Passage passage;
  World& world = passage.world;
  const auto go_through = [&](double until, const Probe& probe) {
    for (const Event& event : world.events(until, probe)) (void)event;
  };
  EXPECT_THROW(go_through(-1.0, passage.motion.probe()), BadResult);
  const auto broken = [](std::span<const BodyId>, double, std::span<State>) {};
  try {
    go_through(100.0, broken);
    FAIL() << "the probe does not answer";
  } catch (const BadResult& bad) {
    EXPECT_EQ(bad.error().code, ErrorCode::not_finite);
    EXPECT_EQ(bad.error().argument, "position");
  }
  go_through(100.0, passage.motion.probe());
  EXPECT_EQ(world.counters().count(EventKind::contact_begin), 3u) << "nothing is lost";
}

}  // namespace
}  // namespace kinesphere::event_range_test
