// Filters: Box2D's rule, the predicate, and their changes in mid-contact and at one instant.
#include <gtest/gtest.h>

#include <set>

#include "support/playground.hpp"

namespace kinesphere {
namespace {

TEST(Filter, FollowsGroupsFirstAndThenMasks) {
  EXPECT_TRUE(passes({}, {}));
  EXPECT_FALSE(passes({.category = 2, .mask = 4}, {.category = 2, .mask = 4}));
  EXPECT_TRUE(passes({.category = 2, .mask = 4}, {.category = 4, .mask = 2}));
  EXPECT_FALSE(passes({.category = 2, .mask = 4}, {.category = 4, .mask = 4})) << "both ways";
  EXPECT_TRUE(passes({.mask = 0, .group = 3}, {.mask = 0, .group = 3}));
  EXPECT_FALSE(passes({.group = -3}, {.group = -3}));
  EXPECT_TRUE(passes({.group = -3}, {.group = -4}));
}

struct Pair : Playground {
  explicit Pair(const Filter& filter = {}, double second_at = 1.0)
      : a(add({.radius = 1, .filter = filter})),
        b(add({.radius = 1, .position = {second_at, 0, 0}, .filter = filter})) {}
  BodyId a;
  BodyId b;
};

TEST(Filter, InMidContactEndsAndBeginsAgain) {
  Pair p;
  EXPECT_EQ(p.run(1.0).size(), 1u);
  p.world.set_filter(p.a, {.mask = 0}).value();
  auto events = p.run(2.0);
  ASSERT_EQ(events.size(), 1u) << events;
  EXPECT_EQ(events[0].kind, EventKind::contact_end);
  EXPECT_EQ(events[0].time, 1.0);
  EXPECT_TRUE(is_clean(p.world));
  p.world.set_filter(p.a, {}).value();
  events = p.run(3.0);
  ASSERT_EQ(events.size(), 1u) << events;
  EXPECT_EQ(events[0].kind, EventKind::contact_begin);
  EXPECT_EQ(events[0].time, 2.0);
}

TEST(Filter, KeepsBodiesFromTouchingAndCostsNoProbes) {
  Pair p({.group = -1}, 10.0);
  p.set_velocity(p.a, {3, 0, 0});
  EXPECT_TRUE(p.run(10.0).empty());
  EXPECT_TRUE(is_clean(p.world));
  EXPECT_EQ(p.world.counters().certificates, 0u);
}

TEST(Filter, AtAnotherEventOfTheInstantTakesABeginBack) {
  Pair p;
  const BodyId c = p.add({.radius = 1, .position = {50, 0, 0}});
  p.add({.radius = 1, .position = {51, 0, 0}});
  ASSERT_TRUE(p.advance(1.0));
  p.world.set_filter(c, {.mask = 0}).value();
  EXPECT_TRUE(p.run(1.0).empty());
}

TEST(Filter, PredicateAndItsChange) {
  Pair p;
  std::set<BodyId> ghosts{p.a};
  p.world.set_pair_filter([&](BodyId a, BodyId b) { return !ghosts.contains(a) && !ghosts.contains(b); })
      .value();
  EXPECT_TRUE(p.run(1.0).empty());
  ghosts.clear();
  p.world.refilter(p.a).value();
  EXPECT_EQ(p.run(2.0).size(), 1u);
  ghosts.insert(p.b);
  p.world.refilter(p.b).value();
  EXPECT_EQ(of_kind(p.run(3.0), EventKind::contact_end).size(), 1u);
  p.world.set_pair_filter({}).value();
  EXPECT_EQ(of_kind(p.run(4.0), EventKind::contact_begin).size(), 1u);
  EXPECT_TRUE(is_clean(p.world));
}

TEST(Filter, AuditTellsOfAnAsymmetricPredicate) {
  Pair p;
  p.world.set_pair_filter([](BodyId a, BodyId b) { return a < b; }).value();
  const auto finding = p.world.audit();
  ASSERT_TRUE(finding);
  EXPECT_EQ(finding->where, "filter");
}

TEST(Filter, LetsBodiesOverlapWhereOverlapsAreNotAllowed) {
  World world = World::create({.allow_overlap = false}).value();
  world.add({.filter = {.group = -1}}).value();
  EXPECT_FALSE(world.add(BodyDefinition{}));
  EXPECT_TRUE(world.add({.filter = {.group = -1}}));
  const std::vector<BodyDefinition> crowd(3, {.position = {9, 0, 0}, .filter = {.group = -2}});
  EXPECT_TRUE(world.add_all(crowd));
}

TEST(Filter, DoesNotConcernWalls) {
  Playground p({.box = Box{{0, 0, 0}, {10, 10, 10}}});
  p.add({.radius = 1, .position = {0.5, 5, 5}, .filter = {.mask = 0}});
  EXPECT_EQ(p.run(1.0).size(), 1u);
}

TEST(Filter, EndsImpactsSilently) {
  Playground p({.contacts = ContactMode::impacts});
  const BodyId a = p.add({.radius = 1, .velocity = {1, 0, 0}});
  p.add({.radius = 1, .position = {2, 0, 0}});
  EXPECT_EQ(p.run(0.5).size(), 1u);
  p.world.set_filter(a, {.mask = 0}).value();
  EXPECT_TRUE(p.run(2.0).empty());
  EXPECT_TRUE(is_clean(p.world));
}

}  // namespace
}  // namespace kinesphere
