// World::Inspection::busiest: the bodies that cost most probes are named with the true reason, and no probe
// is lost.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "kinesphere/kinesphere.hpp"
#include "support/expect_error.hpp"
#include "support/playground.hpp"
#include "world/bouncing_world.hpp"

namespace kinesphere::busiest_test {
namespace {

constexpr std::size_t all = std::numeric_limits<std::size_t>::max();

std::uint64_t sum(const std::vector<BusyBody>& bodies) {
  std::uint64_t probes = 0;
  for (const BusyBody& busy : bodies) {
    EXPECT_EQ(busy.probes, busy.touching + busy.near + busy.windows + busy.changes + busy.queries);
    probes += busy.probes;
  }
  return probes;
}

/// Bodies of radius 1 that go round in circles, with an acceleration of 1 and a speed of 5.
class Carousels {
 public:
  static constexpr double speed = 5.0;
  static constexpr double radius = 25.0;

  World world = World::create({}).value();

  /// Adds `count` bodies on one circle, each `gap` before the next.
  std::vector<BodyId> ring(int count, double gap, const Vec3& centre, double limit) {
    const double step = 2.0 * std::asin((2.0 + gap) / (2.0 * radius));
    std::vector<BodyId> ids;
    for (int k = 0; k < count; ++k) ids.push_back(add({centre, step * k}, limit));
    return ids;
  }
  /// Adds a body that stays in touch with a static one.
  BodyId lying(const Vec3& position, double limit) {
    world.add_static({.shape = Ball{position - Vec3{0, 0, 2}, 1}}).value();
    return at_rest(position, limit);
  }
  BodyId at_rest(const Vec3& position, double limit) { return add({position, 0.0, 0.0}, limit); }
  Result<std::vector<BusyBody>> busiest(std::size_t count = all) const {
    return world.inspection().busiest(count);
  }
  BusyBody of(BodyId body) const {
    for (const BusyBody& busy : busiest().value())
      if (busy.body == body) return busy;
    ADD_FAILURE() << "body " << body << " was not probed";
    return {};
  }
  void run(double until) {
    const Probe probe = [this](std::span<const BodyId> ids, double time, std::span<State> states) {
      for (std::size_t k = 0; k < ids.size(); ++k) states[k] = courses_[ids[k].index].at(time);
    };
    while (world.advance(until, probe).value()) continue;
  }

 private:
  struct Circle {
    Vec3 centre{};
    double phase = 0.0;
    double moves = 1.0;  ///< 0 for a body at rest in `centre`

    State at(double time) const {
      const double angle = phase + speed / radius * time;
      const Vec3 outward{std::cos(angle), std::sin(angle), 0};
      return {centre + moves * radius * outward, moves * speed * Vec3{-outward.y, outward.x, 0}};
    }
  };

  BodyId add(const Circle& circle, double limit) {
    const State state = circle.at(world.time());
    const BodyId id = world
                          .add({.radius = 1,
                                .acceleration_limit = limit,
                                .position = state.position,
                                .velocity = state.velocity})
                          .value();
    if (id.index >= courses_.size()) courses_.resize(id.index + 1);
    courses_[id.index] = circle;
    return id;
  }

  std::vector<Circle> courses_;
};

TEST(Busiest, NamesEachReason) {
  Carousels p;
  const BodyId lying = p.lying({500, 0, 0}, 1.0);
  const std::vector<BodyId> narrow = p.ring(5, 0.01, {0, 0, 0}, 1.01);
  const std::vector<BodyId> fair = p.ring(2, 0.5, {0, 0, 300}, 1.01);
  const std::vector<BodyId> loose = p.ring(2, 0.5, {0, 0, 600}, 30.0);
  p.world.set_profiling(true).value();
  p.run(10.0);
  EXPECT_EQ(p.of(lying).reason, ProbeReason::touching);
  EXPECT_EQ(p.of(lying).largest_acceleration, 0.0);
  for (const BodyId id : narrow) EXPECT_EQ(p.of(id).reason, ProbeReason::narrow_misses) << id;
  for (const BodyId id : fair) EXPECT_NE(p.of(id).reason, ProbeReason::loose_limit) << id;
  for (const BodyId id : loose) {
    EXPECT_EQ(p.of(id).reason, ProbeReason::loose_limit) << id;
    EXPECT_EQ(p.of(id).acceleration_limit, 30.0);
    EXPECT_GT(p.of(id).largest_acceleration, 0.9) << id;
    EXPECT_LE(p.of(id).largest_acceleration, 1.0) << id;
  }
  EXPECT_GT(p.of(loose[0]).probes, 2 * p.of(fair[0]).probes);
}

/// Fifteen balls that lie in a heap on the ground.
TEST(Busiest, NamesAPileInTouch) {
  Playground p;
  p.world.add_static({.shape = HalfSpace{{0, 0, 1}, 0}}).value();
  for (int layer = 5; layer > 0; --layer)
    for (int k = 0; k < layer; ++k)
      p.add({.radius = 1,
             .acceleration_limit = 10,
             .position = {5.0 - layer + 2.0 * k, 0, 1 + (5 - layer) * std::sqrt(3.0)}},
            Vec3{});
  p.world.set_profiling(true).value();
  p.run(0.2);
  const std::vector<BusyBody> busiest = p.world.inspection().busiest(all).value();
  ASSERT_EQ(busiest.size(), 15u);
  for (const BusyBody& busy : busiest) EXPECT_EQ(busy.reason, ProbeReason::touching) << busy.body;
  EXPECT_EQ(sum(busiest), p.world.counters().probes);
  EXPECT_TRUE(std::is_sorted(busiest.begin(), busiest.end(), [](const BusyBody& a, const BusyBody& b) {
    return a.probes != b.probes ? a.probes > b.probes : a.body < b.body;
  }));
  const std::vector<BusyBody> first = p.world.inspection().busiest(4).value();
  EXPECT_EQ(first, std::vector(busiest.begin(), busiest.begin() + 4));
}

TEST(Busiest, LeavesOutRemovedBodiesAndBeginsAnewForTheirNumbers) {
  Carousels p;
  const BodyId removed = p.lying({0, 0, 0}, 1.0);
  const BodyId stays = p.lying({100, 0, 0}, 1.0);
  p.world.set_profiling(true).value();
  p.run(0.5);
  EXPECT_EQ(p.busiest()->size(), 2u);
  p.world.remove(removed).value();
  ASSERT_EQ(p.busiest()->size(), 1u);
  EXPECT_EQ(p.busiest()->front().body, stays);
  const std::uint64_t before = p.of(stays).probes;
  const BodyId again = p.at_rest({0, 50, 0}, 1.0);
  ASSERT_EQ(again.index, removed.index);
  p.run(1.0);
  EXPECT_GT(p.of(stays).probes, before);
  for (const BusyBody& busy : p.busiest().value()) EXPECT_NE(busy.body, removed);
}

TEST(Busiest, CountsWhileProfilingIsOnAndThenAnew) {
  Carousels p;
  const BodyId lying = p.lying({0, 0, 0}, 1.0);
  expect_error(p.busiest(), ErrorCode::not_profiling, "world", "busiest:");
  p.run(0.5);
  const std::uint64_t unseen = p.world.counters().probes;
  p.world.set_profiling(true).value();
  EXPECT_TRUE(p.busiest()->empty());
  p.run(1.0);
  p.world.set_profiling(false).value();
  const BusyBody kept = p.of(lying);
  EXPECT_EQ(kept.probes, p.world.counters().probes - unseen);
  p.run(1.5);
  EXPECT_EQ(p.of(lying), kept) << "kept, but not gone on with";
  EXPECT_TRUE(p.busiest(0)->empty());
  p.world.set_profiling(true).value();
  EXPECT_TRUE(p.busiest()->empty());
}

TEST(Busiest, IsNoPartOfSnapshotsAndClones) {
  Carousels p;
  p.lying({0, 0, 0}, 1.0);
  p.run(0.5);
  Carousels profiled;
  const BodyId lying = profiled.lying({0, 0, 0}, 1.0);
  profiled.world.set_profiling(true).value();
  profiled.run(0.5);
  EXPECT_EQ(profiled.world.save().value(), p.world.save().value());
  const World copy = profiled.world.clone().value();
  expect_error(copy.inspection().busiest(1), ErrorCode::not_profiling, "world", "busiest");
  // An engine that is copied must not count in the profile of the first one.
  const std::uint64_t before = profiled.of(lying).probes;
  World first = std::exchange(profiled.world, profiled.world.clone().value());
  profiled.run(1.0);
  EXPECT_EQ(first.inspection().busiest(1)->front().probes, before);
  profiled.world = World::restore(first.save().value()).value();
  expect_error(profiled.busiest(), ErrorCode::not_profiling, "world", "busiest");
  profiled.world.set_profiling(true).value();
  profiled.run(1.0);
  ASSERT_EQ(profiled.busiest()->size(), 1u);
  EXPECT_EQ(profiled.busiest()->front().reason, ProbeReason::touching);
}

/// Bodies that bounce in a box, some of which are turned and asked for by the caller.
struct Balls : BouncingWorld<RandomForces> {
  static constexpr int count = 200;

  Balls()
      : BouncingWorld(
            RandomForces::create({.start = start(), .acceleration_limits = std::vector<double>(count, 5.0)})
                .value(),
            World::create({.box = Box{{0, 0, 0}, {12, 12, 12}}}).value(), 0.95) {
    for (int number = 0; number < count; ++number) {
      BodyDefinition body = next();
      body.radius = 0.3;
      add(body, 1.0);
    }
    world.set_profiling(true).value();
  }

  void ask_for_some() {
    for (const BodyId id : world.bodies())
      if (id.index % 7 == 0) (void)world.certificates(motion.probe()).safe_until(id).value();
  }

  static std::vector<State> start() {
    Random random(5);
    std::vector<State> states;
    for (int k = 0; k < count; ++k)
      states.push_back({{1.0 + 2.0 * (k % 6), 1.0 + 2.0 * (k / 6 % 6), 1.0 + 2.0 * (k / 36)},
                        4.0 * random.point_in_ball()});
    return states;
  }
};

TEST(Busiest, CountsEachProbeOnceWithAnyNumberOfThreads) {
  Balls looped;
  looped.loop(2.0);
  looped.ask_for_some();
  const std::vector<BusyBody> expected = looped.world.inspection().busiest(all).value();
  EXPECT_EQ(expected.size(), std::size_t{Balls::count});
  EXPECT_EQ(sum(expected), looped.world.counters().probes);
  EXPECT_TRUE(
      std::any_of(expected.begin(), expected.end(), [](const BusyBody& b) { return b.contacts > 5; }));
  EXPECT_TRUE(std::any_of(expected.begin(), expected.end(), [](const BusyBody& b) { return b.queries > 0; }));
  for (const BusyBody& busy : expected) EXPECT_LE(busy.largest_acceleration, 5.0);
  for (const int threads : {1, 3}) {
    Balls balls;
    Workers workers = Workers::create(threads).value();
    balls.run(2.0, &workers).value();
    balls.ask_for_some();
    EXPECT_EQ(balls.world.inspection().busiest(all).value(), expected) << threads;
  }
}

TEST(Busiest, HasANameAndAnAdviceForEachReason) {
  EXPECT_EQ(name_of(ProbeReason::touching), "touching");
  EXPECT_EQ(name_of(ProbeReason::queries), "queries");
  for (int reason = 0; reason <= static_cast<int>(ProbeReason::queries); ++reason)
    EXPECT_GT(advice_on(static_cast<ProbeReason>(reason)).size(), 40u) << reason;
}

}  // namespace
}  // namespace kinesphere::busiest_test
