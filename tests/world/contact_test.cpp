// Begins and ends: times, order, and pairing.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "support/playground.hpp"

namespace kinesphere::contact_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

struct Lengths {
  double tolerance;
  double separation;
};

class BeginsAndEnds : public testing::TestWithParam<Lengths> {};

TEST_P(BeginsAndEnds, ComeWithinTheTolerance) {
  const auto [eps, given] = GetParam();
  const double separation = std::isnan(given) ? 4 * eps : given;
  Random random(3);
  for (int k = 0; k < 300; ++k) {
    SCOPED_TRACE(k);
    Playground p({.contact_tolerance = eps, .separation_distance = given});
    const Vec3 direction = random.unit_vector();
    const double limit = k % 3 == 0 ? 0.0 : 2.0 * random.uniform();
    const BodyDefinition one{.radius = random.uniform(0.0, 1.0),
                             .acceleration_limit = limit,
                             .position = -5.0 * direction + random.point_in_ball(),
                             .velocity = random.uniform(0.5, 5.0) * direction};
    const BodyId a = p.add(one, 0.99 * limit * random.point_in_ball());
    const BodyDefinition other{.radius = random.uniform(0.5, 1.0),
                               .acceleration_limit = limit,
                               .position = 5.0 * direction + random.point_in_ball(),
                               .velocity = -random.uniform(0.5, 5.0) * direction};
    const BodyId b = p.add(other, 0.99 * limit * random.point_in_ball());
    bool touching = false;
    for (const Event& event : p.run(10.0)) {
      ASSERT_EQ(event.kind, touching ? EventKind::contact_end : EventKind::contact_begin) << event;
      EXPECT_EQ(event.first, a);
      EXPECT_EQ(event.second, b);
      EXPECT_EQ(event.wall, Wall::none);
      const double gap = p.gap(a, b, event.time);
      EXPECT_NEAR(event.gap, gap, 1e-12);
      const double margin = 1e-12;
      EXPECT_GE(gap, touching ? separation - margin : -eps) << event;
      EXPECT_LE(gap, touching ? separation + eps + margin : eps + margin) << event;
      EXPECT_NEAR(norm(event.first_state.position - p.state(a, event.time).position), 0.0, 1e-12);
      EXPECT_NEAR(norm(event.second_state.velocity - p.state(b, event.time).velocity), 0.0, 1e-12);
      EXPECT_NEAR(norm(event.normal), 1.0, 1e-12);
      EXPECT_GT(dot(event.normal, event.second_state.position - event.first_state.position), 0.0);
      // Two that pass each other within the tolerance may be seen only when they recede.
      if (!touching && event.gap <= 0.0) {
        EXPECT_GE(event.approach_speed, 0.0) << event;
      }
      const double to_first = norm(event.point - event.first_state.position) - p.radius(a);
      const double to_second = norm(event.point - event.second_state.position) - p.radius(b);
      EXPECT_NEAR(to_first, 0.5 * gap, 1e-12);
      EXPECT_NEAR(to_second, 0.5 * gap, 1e-12);
      touching = !touching;
    }
    // The events above were checked to be true; sampling shows whether one is missing.
    if (p.world.counters().count(EventKind::contact_begin) > 0) continue;
    double least = 1e9;
    for (int sample = 0; sample <= 10000; ++sample) least = std::min(least, p.gap(a, b, 1e-3 * sample));
    EXPECT_GT(least, -eps);
  }
}

INSTANTIATE_TEST_SUITE_P(Lengths, BeginsAndEnds,
                         testing::Values(Lengths{1e-6, nan}, Lengths{1e-9, nan}, Lengths{1e-3, nan},
                                         Lengths{1e-6, 1.0000001e-6}, Lengths{1e-6, 0.5},
                                         Lengths{0.1, 0.11}));

TEST(ContactPairs, WallsBeginAndEndToo) {
  const double eps = 1e-6;
  Playground p({.box = Box{{-10, -10, -10}, {10, 10, 10}}});
  const BodyId ball = p.add({.radius = 1, .acceleration_limit = 4, .velocity = {6, 0, 0}}, Vec3{-2, 0, 0});
  // x = 6 t - t^2 touches the wall (9) at t = 3, grazing it; a moment later it is steered into the wall.
  p.run(2.9);
  p.steer(ball, {0, 0, 0});
  const auto events = p.run(4.0, [&](const Event& event) {
    if (event.kind == EventKind::wall_begin) p.steer(ball, {-3, 0, 0});
  });
  ASSERT_EQ(events.size(), 2u) << events;
  EXPECT_EQ(events[0].kind, EventKind::wall_begin);
  EXPECT_EQ(events[0].wall, Wall::x_upper);
  EXPECT_EQ(events[0].first, ball);
  EXPECT_EQ(events[0].second, no_body);
  EXPECT_EQ(events[0].normal, (Vec3{1, 0, 0}));
  EXPECT_LE(events[0].gap, eps);
  EXPECT_NEAR(events[0].point.x, 10.0, 1e-9);
  EXPECT_EQ(events[1].kind, EventKind::wall_end);
  EXPECT_GE(events[1].gap, 4 * eps);
  EXPECT_LE(events[1].gap, 5 * eps);
}

TEST(ContactPairs, CornerTouchesThreeWallsInOrder) {
  Playground p({.box = Box{{-8, -8, -8}, {8, 8, 8}}});
  p.add({.radius = 1, .velocity = {1, -1, 1}});
  const auto events = p.run(7.5);
  ASSERT_EQ(events.size(), 3u) << events;
  EXPECT_EQ(events[0].wall, Wall::x_upper);
  EXPECT_EQ(events[1].wall, Wall::y_lower);
  EXPECT_EQ(events[2].wall, Wall::z_upper);
  EXPECT_EQ(events[0].time, events[2].time);
}

TEST(ContactPairs, SphereMayTouchOppositeWalls) {
  Playground p({.box = Box{{-1, -9, -9}, {1, 9, 9}}});
  const BodyId fat = p.add({.radius = 2});
  auto events = p.run(1.0);
  ASSERT_EQ(events.size(), 2u) << events;
  EXPECT_EQ(events[0].wall, Wall::x_lower);
  EXPECT_EQ(events[1].wall, Wall::x_upper);
  p.world.remove(fat).value();
  events = p.run(1.0);
  ASSERT_EQ(events.size(), 2u) << events;
  EXPECT_EQ(events[0].kind, EventKind::wall_end);
  EXPECT_EQ(events[0].wall, Wall::x_lower);
  EXPECT_EQ(events[1].wall, Wall::x_upper);
}

TEST(ContactPairs, RemovalEndsThemWithTheLastState) {
  Playground p({.box = Box{{-5, -5, -5}, {5, 5, 5}}});
  const BodyId a = p.add({.radius = 1, .velocity = {2, 0, 0}});
  const BodyId b = p.add({.radius = 1, .position = {2.5, 0, 0}});
  const BodyId c = p.add({.radius = 1, .position = {4.5, 2, 0}});
  auto events = p.run(0.5);
  ASSERT_EQ(events.size(), 2u) << events;  // c at the wall, a meets b
  p.world.remove(a).value();
  EXPECT_FALSE(p.world.contains(a));
  const BodyId successor = p.world.add({.radius = 0.1, .position = {-4, -4, -4}}).value();
  EXPECT_EQ(successor.index, a.index);
  p.world.remove(c).value();
  const auto probe = [&](std::span<const BodyId> ids, double, std::span<State> states) {
    for (std::size_t k = 0; k < ids.size(); ++k)
      states[k] = ids[k] == b ? State{{2.5, 0, 0}, {}} : State{{-4, -4, -4}, {}};
  };
  events.clear();
  while (const auto event = p.world.advance(1.0, probe).value()) events.push_back(*event);
  ASSERT_EQ(events.size(), 2u) << events;
  EXPECT_EQ(events[0].kind, EventKind::contact_end);
  EXPECT_EQ(events[0].first, a) << "not the body that has its index now";
  EXPECT_EQ(events[0].second, b);
  EXPECT_EQ(events[0].time, 0.5);
  EXPECT_NEAR(events[0].first_state.position.x, 1.0, 1e-9);
  EXPECT_EQ(events[0].first_state.velocity, (Vec3{2, 0, 0}));
  EXPECT_NEAR(events[0].gap, -0.5, 1e-9);
  EXPECT_EQ(events[1].kind, EventKind::wall_end);
  EXPECT_EQ(events[1].first, c);
}

TEST(ContactPairs, BothMayBeRemovedAtOnceAndTheEndComesOnce) {
  for (const bool second_first : {false, true}) {
    Playground p;
    const BodyId a = p.add({.radius = 1});
    const BodyId b = p.add({.radius = 1, .position = {1, 0, 0}});
    EXPECT_EQ(p.run(0.5).size(), 1u);
    p.world.remove(second_first ? b : a).value();
    p.world.remove(second_first ? a : b).value();
    const auto events = p.run(2.0);
    ASSERT_EQ(events.size(), 1u) << events;
    EXPECT_EQ(events[0].kind, EventKind::contact_end);
    EXPECT_EQ(events[0].first, a);
    EXPECT_EQ(events[0].second, b);
    EXPECT_EQ(events[0].time, 0.5);
  }
}

TEST(ContactPairs, RemovalBeforeTheBeginIsToldMeansNoContact) {
  Playground p;
  p.add({.radius = 1, .position = {0, 0, 0}});
  const BodyId middle = p.add({.radius = 1, .position = {1.5, 0, 0}});
  p.add({.radius = 1, .position = {3, 0, 0}});
  const auto first = p.advance(1.0);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->second, middle);
  p.world.remove(middle).value();  // the end of its contact with the third is pending
  const auto events = p.run(1.0);
  ASSERT_EQ(events.size(), 1u) << events;
  EXPECT_EQ(events[0].kind, EventKind::contact_end);
  EXPECT_EQ(events[0].first, first->first);
}

TEST(ContactPairs, OverlapAtTheStartBeginsAtOnceInOrder) {
  Playground p({.start_time = -7.25});
  for (int k = 0; k < 5; ++k) p.add({.radius = 10.0 + k, .position = {0.1 * k, 0, 0}});
  const auto events = p.run(0.0);
  ASSERT_EQ(events.size(), 10u);
  std::size_t n = 0;
  for (std::uint32_t a = 0; a < 5; ++a)
    for (std::uint32_t b = a + 1; b < 5; ++b, ++n) {
      EXPECT_EQ(events[n].time, -7.25);
      EXPECT_EQ(events[n].kind, EventKind::contact_begin);
      EXPECT_EQ(events[n].first.index, a);
      EXPECT_EQ(events[n].second.index, b);
    }
}

TEST(ContactPairs, CoincidentCentresHaveANormal) {
  Playground p;
  p.add({.radius = 1});
  p.add({.radius = 2});
  const auto event = p.advance(1.0);
  ASSERT_TRUE(event);
  EXPECT_EQ(norm(event->normal), 1.0);
  EXPECT_EQ(event->gap, -3.0);
}

/// Adds bodies that fly in from all sides at equal distance and speed, towards a target in the middle.
void add_star(Playground& p, int arms, bool with_target) {
  if (with_target) p.add({.radius = 1});
  for (int k = 0; k < arms; ++k) {
    Vec3 direction;
    direction[k % 3] = k % 2 == 0 ? 1.0 : -1.0;
    p.add({.radius = 0.25, .position = 8.0 * direction, .velocity = -2.0 * direction});
  }
}

TEST(Order, SimultaneousEventsComeByKindAndIds) {
  for (const bool with_target : {true, false}) {
    Playground p;
    add_star(p, 6, with_target);
    // A second star elsewhere, at equal times.
    for (std::uint32_t k = 0; k < 6; ++k) {
      const State twin = p.state({with_target ? 6u - k : 5u - k, 0});
      p.add({.radius = 0.25, .position = twin.position + Vec3{64, 0, 0}, .velocity = twin.velocity});
    }
    if (with_target) p.add({.radius = 1, .position = {64, 0, 0}});
    const auto events = p.run(10.0);
    EXPECT_EQ(events.size(), with_target ? 84u : 60u);
    std::size_t simultaneous = 0;
    const auto key = [](const Event& e) { return std::tie(e.kind, e.first, e.second, e.wall); };
    // An event may follow from the answer to one of its bodies at the same time.
    std::set<BodyId> answered;
    for (std::size_t k = 1; k < events.size(); ++k) {
      ASSERT_GE(events[k].time, events[k - 1].time);
      if (events[k].time != events[k - 1].time) {
        answered.clear();
        continue;
      }
      answered.insert({events[k - 1].first, events[k - 1].second});
      if (answered.contains(events[k].first) || answered.contains(events[k].second)) continue;
      ++simultaneous;
      EXPECT_LT(key(events[k - 1]), key(events[k])) << events[k - 1] << "\n" << events[k];
    }
    EXPECT_GT(simultaneous, 5u);
    EXPECT_TRUE(is_clean(p.world));
  }
}

TEST(Order, FirstIsTheSmallerIdAlsoAfterReuse) {
  Playground p;
  const BodyId old = p.add({.position = {50, 0, 0}});
  const BodyId b = p.add({.radius = 1, .position = {5, 0, 0}});
  p.world.remove(old).value();
  const BodyId a = p.add({.radius = 1, .velocity = {1, 0, 0}});
  EXPECT_EQ(a.index, old.index);
  const auto event = p.advance(10.0);
  ASSERT_TRUE(event);
  EXPECT_EQ(event->first, std::min(a, b));
  EXPECT_EQ(event->second, std::max(a, b));
  EXPECT_GT(event->approach_speed, 0.0);
}

TEST(ContactPairs, NestedSpheresTouchWhileOneIsInside) {
  // A small body crosses a huge one: one contact, however long it is inside.
  Playground p;
  p.add({.radius = 1000});
  p.add({.radius = 1, .acceleration_limit = 1, .position = {-1100, 5, 0}, .velocity = {50, 0, 0}}, Vec3{});
  const auto events = p.run(100.0);
  ASSERT_EQ(events.size(), 2u) << events;
  EXPECT_NEAR(events[1].time - events[0].time, 2002.0 / 50.0, 0.1);
  EXPECT_LT(p.world.counters().probes, 5000u);
}

TEST(ContactPairs, GrazingWithinTheToleranceMayOrMayNotCountButNeverStalls) {
  for (const double miss : {-1e-6, -1e-7, 0.0, 1e-12, 0.5e-6, 1e-6, 2e-6, 1e-5}) {
    Playground p;
    p.add({.radius = 1, .position = {-100, 0, 0}, .velocity = {10, 0, 0}});
    p.add({.radius = 1, .acceleration_limit = 1, .position = {100, 2.0 + miss, 0}, .velocity = {-10, 0, 0}},
          Vec3{});
    const auto events = p.run(20.0);
    EXPECT_EQ(events.size() % 2, 0u) << events;
    if (miss <= -1e-6) {
      EXPECT_EQ(events.size(), 2u) << miss;
    }
    if (miss > 1e-6) {
      EXPECT_EQ(events.size(), 0u) << miss << events;
    }
    EXPECT_LT(p.world.counters().probes, 3000u) << miss;
  }
}

}  // namespace
}  // namespace kinesphere::contact_test
