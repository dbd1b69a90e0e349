// Filters: Box2D's rule, the predicate, and their changes in mid-contact and at one instant.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <set>
#include <stdexcept>
#include <thread>

#include "kinesphere/certificates.hpp"
#include "kinesphere/inspection.hpp"
#include "kinesphere/queries.hpp"
#include "kinesphere/random.hpp"
#include "support/playground.hpp"

namespace kinesphere::filter_test {
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
  p.world.change(p.a, {.filter = Filter{.mask = 0}}).value();
  auto events = p.run(2.0);
  ASSERT_EQ(events.size(), 1u) << events;
  EXPECT_EQ(events[0].kind, EventKind::contact_end);
  EXPECT_EQ(events[0].time, 1.0);
  EXPECT_TRUE(is_clean(p.world));
  p.world.change(p.a, {.filter = Filter{}}).value();
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
  p.world.change(c, {.filter = Filter{.mask = 0}}).value();
  EXPECT_TRUE(p.run(1.0).empty());
}

TEST(Filter, PredicateAndItsChange) {
  Pair p;
  std::set<BodyId> ghosts{p.a};
  p.world.set_pair_filter([&](BodyId a, BodyId b) { return !ghosts.contains(a) && !ghosts.contains(b); })
      .value();
  EXPECT_TRUE(p.run(1.0).empty());
  ghosts.clear();
  p.world.refresh_filter(p.a).value();
  EXPECT_EQ(p.run(2.0).size(), 1u);
  ghosts.insert(p.b);
  p.world.refresh_filter(p.b).value();
  EXPECT_EQ(of_kind(p.run(3.0), EventKind::contact_end).size(), 1u);
  p.world.set_pair_filter({}).value();
  EXPECT_EQ(of_kind(p.run(4.0), EventKind::contact_begin).size(), 1u);
  EXPECT_TRUE(is_clean(p.world));
}

TEST(Filter, AuditTellsOfAnAsymmetricPredicate) {
  Pair p;
  p.world.set_pair_filter([](BodyId a, BodyId b) { return a < b; }).value();
  const auto finding = p.world.inspection().audit();
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

TEST(Filter, DoesNotConcernWallsWithoutOne) {
  Playground p({.box = Box{{0, 0, 0}, {10, 10, 10}}});
  p.add({.radius = 1, .position = {0.5, 5, 5}, .filter = {.mask = 0}});
  EXPECT_EQ(p.run(1.0).size(), 1u);
}

constexpr std::uint64_t wall_category = 2;
const WorldDefinition with_filtered_walls{.box = Box{{0, 0, 0}, {10, 10, 10}},
                                          .wall_filter = Filter{.category = wall_category, .mask = 1 | 4}};
/// Filters of bodies that these walls do not meet, by the mask and by the category.
constexpr std::array let_through{Filter{.mask = ~wall_category}, Filter{.category = 8}};

RigidBody rod_of(const BodyDefinition& body) {
  return {.body = body, .parts = {{{-1, 0, 0}, {1, 0, 0}, 0.5}}};
}

TEST(FilterOfWalls, LetsBodiesPassAndCostsNoProbes) {
  for (const Filter& filter : let_through) {
    Playground p(with_filtered_walls);
    const BodyDefinition body{.radius = 1, .position = {5, 5, 5}, .velocity = {1, 0, 0}, .filter = filter};
    const BodyId ball = p.add(body);
    BodyDefinition beside = body;
    beside.position.y = 2;
    const BodyId rod = p.add_rigid_body(rod_of(beside));
    EXPECT_EQ(p.world.certificates().earliest_contact(ball).value().wall, Wall::none);
    EXPECT_EQ(p.world.certificates().earliest_approach(rod, 1.0).value().wall, Wall::none);
    EXPECT_TRUE(p.run(20.0).empty());
    EXPECT_TRUE(is_clean(p.world));
    EXPECT_EQ(p.world.counters().wall_checks, 0u);
  }
}

TEST(FilterOfWalls, StopsTheOthers) {
  for (const std::uint64_t category : {1u, 4u, 12u}) {
    Playground p(with_filtered_walls);
    const BodyDefinition body{
        .radius = 1, .position = {5, 5, 5}, .velocity = {1, 0, 0}, .filter = {.category = category}};
    p.add(body);
    p.add_rigid_body(rod_of(body));
    EXPECT_EQ(of_kind(p.run(20.0), EventKind::wall_begin).size(), 2u);
  }
}

TEST(FilterOfWalls, HoldsAtOnceWhenThatOfABodyChanges) {
  Playground p(with_filtered_walls);
  const BodyId id = p.add({.radius = 1, .position = {0.5, 5, 5}});
  EXPECT_EQ(p.run(1.0).size(), 1u);
  p.world.change(id, {.filter = let_through[0]}).value();
  auto events = p.run(2.0);
  ASSERT_EQ(events.size(), 1u) << events;
  EXPECT_EQ(events[0].kind, EventKind::wall_end);
  EXPECT_EQ(events[0].time, 1.0);
  EXPECT_TRUE(is_clean(p.world));
  p.world = World::restore(p.world.save().value()).value();
  EXPECT_EQ(p.world.definition(), with_filtered_walls);
  p.set_velocity(id, {-1, 0, 0});
  EXPECT_TRUE(p.run(5.0).empty());
  p.world.change(id, {.filter = Filter{}}).value();
  events = p.run(6.0);
  ASSERT_EQ(events.size(), 1u) << events;
  EXPECT_EQ(events[0].kind, EventKind::wall_begin);
  EXPECT_NEAR(events[0].gap, -3.5, 1e-9);
  EXPECT_TRUE(is_clean(p.world));
}

TEST(FilterOfWalls, AtAnotherEventOfTheInstantTakesABeginBack) {
  Playground p(with_filtered_walls);
  p.add({.radius = 1, .position = {0.5, 5, 5}});
  const BodyId next = p.add({.radius = 1, .position = {0.5, 8, 5}});
  ASSERT_TRUE(p.advance(1.0));
  p.world.change(next, {.filter = let_through[0]}).value();
  EXPECT_TRUE(p.run(1.0).empty());
}

TEST(FilterOfWalls, LetsBodiesBeOutsideWhereOverlapsAreNotAllowed) {
  WorldDefinition definition = with_filtered_walls;
  definition.allow_overlap = false;
  World world = World::create(definition).value();
  for (const Filter& filter : {Filter{}, let_through[0]}) {
    SCOPED_TRACE(filter.mask);
    const bool may = filter == let_through[0];
    const BodyDefinition ball{.radius = 1, .position = {5, 5, 12}, .filter = filter};
    const auto id = world.add(ball);
    EXPECT_EQ(id.has_value(), may);
    EXPECT_EQ(world.add_rigid_body(rod_of({.position = {0, 5, 5}, .filter = filter})).has_value(), may);
    BodyDefinition inside = ball;
    inside.position = {5, 5, may ? 5.0 : 2.0};
    const BodyId within = world.add(inside).value();
    EXPECT_EQ(world.teleport(within, {{5, 9.5, 5}, {}}).has_value(), may);
    EXPECT_EQ(world.change(within, {.radius = 2.5}).has_value(), may);
  }
}

TEST(Filter, EndsImpactsSilently) {
  Playground p({.contacts = ContactEvents::impacts});
  const BodyId a = p.add({.radius = 1, .velocity = {1, 0, 0}});
  p.add({.radius = 1, .position = {2, 0, 0}});
  EXPECT_EQ(p.run(0.5).size(), 1u);
  p.world.change(a, {.filter = Filter{.mask = 0}}).value();
  EXPECT_TRUE(p.run(2.0).empty());
  EXPECT_TRUE(is_clean(p.world));
}

/// Makes all calls that use the filter: adding a body if overlaps are forbidden, advance(), a query, a change
/// of filters, an audit.
void ask_the_filter(Playground& p, BodyId a) {
  p.world.refresh_filter(a).value();
  p.run(p.world.time() + 1.0);
  (void)p.world.add({.radius = 1, .position = {0.5, 0, 0}});
  (void)p.world.certificates().safe_until(a);
  (void)p.world.inspection().audit();
}

TEST(PairFilter, MayReadBodiesOfTheWorldThatAsksIt) {
  Playground p({.allow_overlap = false});
  const BodyId a = p.add({.radius = 1, .velocity = {0.5, 0, 0}, .user_data = 7});
  p.add({.radius = 1, .position = {3, 0, 0}, .user_data = 7});
  int asked = 0;
  p.world
      .set_pair_filter([&](BodyId first, BodyId second) {
        ++asked;
        for (const BodyId id : {first, second}) {
          if (!p.world.contains(id)) continue;  // the body is about to be added
          EXPECT_TRUE(p.world.body(id));
          EXPECT_TRUE(p.world.body(id));
          EXPECT_TRUE(p.world.touching(id));
          EXPECT_TRUE(p.world.sensor_overlaps(id));
          EXPECT_EQ(p.world.user_data(id).value(), 7u);
        }
        EXPECT_EQ(p.world.bodies().size(), p.world.size());
        EXPECT_GE(p.world.time(), p.world.definition().start_time);
        EXPECT_LE(p.world.counters().steps(), 1000u);
        return p.world.sensor(0).distances.empty();
      })
      .value();
  ask_the_filter(p, a);
  EXPECT_GE(asked, 5);
}

TEST(PairFilter, CannotMakeOtherCallsToTheWorldThatAsksIt) {
  Playground p({.allow_overlap = false});
  const BodyId a = p.add({.radius = 1, .velocity = {0.5, 0, 0}});
  p.add({.radius = 1, .position = {3, 0, 0}});
  int asked = 0;
  const auto refuses = [](const auto& result) {
    if (result) return false;
    return result.error().code == ErrorCode::filter_in_progress && result.error().argument == "pair_filter" &&
           result.error().message.ends_with(
               ": a pair filter may not make this call to the world that asked it");
  };
  p.world
      .set_pair_filter([&](BodyId first, BodyId second) {
        ++asked;
        World& w = p.world;
        EXPECT_TRUE(refuses(w.certificates().safe_until(first, second)));
        EXPECT_TRUE(refuses(w.certificates().safe_until(first)));
        EXPECT_TRUE(refuses(w.certificates().safe_until()));
        EXPECT_TRUE(refuses(w.certificates(p.probe()).safe_until(first, second)));
        EXPECT_TRUE(refuses(w.certificates().earliest_contact(first)));
        EXPECT_TRUE(refuses(w.certificates().distance_limits(first, second, w.time())));
        EXPECT_TRUE(refuses(w.queries().overlapping({}, 1)));
        EXPECT_TRUE(refuses(w.queries().nearest({}, 1)));
        EXPECT_TRUE(refuses(w.advance(w.time() + 1, p.probe())));
        EXPECT_TRUE(refuses(w.add({})));
        EXPECT_TRUE(refuses(w.add_all({})));
        EXPECT_TRUE(refuses(w.add_static({.shape = Ball{{}, 1}})));
        EXPECT_TRUE(refuses(w.remove(first)));
        EXPECT_TRUE(refuses(w.set_velocity(first, {})));
        EXPECT_TRUE(refuses(w.set_velocities({}, {})));
        EXPECT_TRUE(refuses(w.teleport(first, {})));
        EXPECT_TRUE(refuses(w.change(first, {.radius = 1})));
        EXPECT_TRUE(refuses(w.disable(first)));
        EXPECT_TRUE(refuses(w.change(first, {.filter = Filter{}})));
        EXPECT_TRUE(refuses(w.refresh_filter(first)));
        EXPECT_TRUE(refuses(w.set_pair_filter({})));
        EXPECT_TRUE(refuses(w.change(first, {.user_data = 1})));
        EXPECT_TRUE(refuses(w.save()));
        EXPECT_TRUE(refuses(w.clone()));
        EXPECT_TRUE(refuses(w.start_recording()));
        const auto finding = w.inspection().audit();
        EXPECT_TRUE(finding && finding->where == "call") << finding->what;
        return true;
      })
      .value();
  ask_the_filter(p, a);
  EXPECT_GE(asked, 5);
  EXPECT_TRUE(is_clean(p.world));
}

/// The filter of a world may query another world, also one with a filter that queries back.
TEST(PairFilterDeathTest, EndsTheProgramByWhatItThrows) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_DEATH(
      {
        Playground space;
        space.add({.radius = 1, .velocity = {1, 0, 0}});
        space.add({.radius = 1, .position = {5, 0, 0}});
        try {
          space.world.set_pair_filter([](BodyId, BodyId) -> bool { throw std::out_of_range("no such team"); })
              .value();
          space.advance(10.0);
        } catch (const std::exception&) {
          // A caller that goes on here would miss the contact at 3.
        }
      },
      "no such team");
}

TEST(PairFilter, IsCalledOnTheThreadThatRuns) {
  Playground p;
  Random random = Random::at(14, 0, 0);
  for (int k = 0; k < 3000; ++k)
    p.add({.radius = 0.3, .position = 15.0 * random.point_in_ball(), .velocity = random.point_in_ball()});
  std::atomic<int> elsewhere = 0;
  std::atomic<int> here = 0;
  p.world
      .set_pair_filter([&, own = std::this_thread::get_id()](BodyId, BodyId) {
        ++(std::this_thread::get_id() == own ? here : elsewhere);
        return true;
      })
      .value();
  Workers workers = Workers::create(4).value();
  p.world
      .run(
          0.5, p.probe(), [](const Event&) {}, &workers)
      .value();
  EXPECT_GT(here, 1000);
  EXPECT_EQ(elsewhere, 0);
}

TEST(PairFilter, OfOneWorldMayAskAnother) {
  Playground p;
  const BodyId a = p.add({.radius = 1, .velocity = {0.5, 0, 0}});
  const BodyId b = p.add({.radius = 1, .position = {3, 0, 0}});
  p.run(0.0);
  World other = p.world.clone().value();
  int refused = 0;
  other
      .set_pair_filter([&](BodyId first, BodyId second) {
        refused += !p.world.certificates().safe_until(first, second);
        return true;
      })
      .value();
  p.world
      .set_pair_filter(
          [&](BodyId, BodyId) { return static_cast<bool>(other.certificates().safe_until(a, b)); })
      .value();
  EXPECT_TRUE(p.world.certificates().safe_until(a, b));
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace kinesphere::filter_test
