// Sleeping bodies cost nothing until something wakes them, and then the whole island wakes.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "kinesphere/recording.hpp"
#include "support/expect_error.hpp"
#include "support/playground.hpp"

namespace kinesphere::sleep_test {
namespace {

constexpr double limit = 10.0;

class Rested : public Playground {
 public:
  using Playground::Playground;

  BodyId ball(const Vec3& position, const Vec3& velocity = {}) {
    return add({.radius = 1, .acceleration_limit = limit, .position = position, .velocity = velocity},
               Vec3{});
  }
  void rest(BodyId id) {
    set_velocity_unseen(id, {});
    steer(id, {});
    world.sleep(id).value();
  }
  bool resting(BodyId id) const { return world.body(id).value().sleeping; }
};

std::set<BodyId> woke(const std::vector<Event>& events) {
  std::set<BodyId> ids;
  for (const Event& event : of_kind(events, EventKind::woke)) ids.insert(event.first);
  return ids;
}

/// Balls in a row, each touching the next, on a floor.
std::vector<BodyId> row(Rested& p, int count, const Vec3& first) {
  std::vector<BodyId> ids;
  for (int k = 0; k < count; ++k) ids.push_back(p.ball(first + Vec3{2.0 * k, 0, 0}));
  return ids;
}

TEST(SleepingBesideARigidBody, EndsWhenItIsTurnedAtOnce) {
  Rested p;
  const BodyId plank = p.add_rigid_body({.parts = {{{-2, 0, 0}, {2, 0, 0}, 0.5}}});
  const BodyId ball = p.ball({1, 0, 1.5});
  p.run(0.0);
  p.rest(ball);
  p.run(1.0);
  ASSERT_TRUE(p.resting(ball));
  p.world.change(plank, {.rotation = Rotation{rotation_by({0, 0, 1e-9})}}).value();
  EXPECT_FALSE(p.resting(ball));
  EXPECT_EQ(woke(p.run(2.0)), std::set{ball});
  EXPECT_TRUE(is_clean(p.world));
}

class Modes : public testing::TestWithParam<ContactEvents> {};
INSTANTIATE_TEST_SUITE_P(Rest, Modes, testing::Values(ContactEvents::begin_and_end, ContactEvents::impacts));

TEST_P(Modes, FifteenBallsAtRestAreNotProbedAndDoNotWake) {
  Rested p({.contacts = GetParam()});
  p.world.add_static({.shape = HalfSpace{{0, 0, 1}, 0}}).value();
  std::vector<BodyId> balls;
  for (int layer = 5; layer > 0; --layer)
    for (const BodyId id : row(p, layer, {5.0 - layer, 0, 1 + (5 - layer) * std::sqrt(3.0)}))
      balls.push_back(id);
  ASSERT_EQ(balls.size(), 15u);
  p.run(0.0);
  for (const BodyId id : balls) p.rest(id);
  p.run(1.0);
  const Counters before = p.world.counters();
  EXPECT_TRUE(p.run(1e6).empty());
  EXPECT_EQ(p.world.counters().probes, before.probes);
  EXPECT_EQ(p.world.counters().steps(), before.steps());
  EXPECT_EQ(p.world.counters().certificates, before.certificates);
  EXPECT_TRUE(is_clean(p.world));
  for (const BodyId id : balls) EXPECT_TRUE(p.resting(id));

  // A ball that is thrown at the top wakes them all, and only the thrown ball was probed until then.
  const BodyId thrown = p.ball({4, 0, 30}, {0, 0, -5});
  std::vector<Event> events;
  while (events.empty() || events.back().kind != EventKind::contact_begin) {
    const auto event = p.advance(2e6);
    ASSERT_TRUE(event);
    events.push_back(*event);
  }
  EXPECT_TRUE(events.back().second == thrown && events.back().first == balls.back());
  EXPECT_NEAR(events.back().gap, 0.0, 1e-5);
  for (const BodyId id : balls) EXPECT_FALSE(p.resting(id));
  p.set_velocity(thrown, {0, 0, 5});
  for (int k = 0; k < 15; ++k) events.push_back(p.advance(2e6).value());
  EXPECT_EQ(woke(events), std::set<BodyId>(balls.begin(), balls.end()));
  EXPECT_EQ(p.world.counters().count(EventKind::woke), 15u);
  EXPECT_TRUE(is_clean(p.world));
}

TEST_P(Modes, AHitWakesItsIslandAndNoOther) {
  Rested p({.contacts = GetParam()});
  const auto hit = row(p, 5, {0, 0, 0});
  const auto other = row(p, 5, {0, 0, 20});
  p.run(0.0);
  for (const auto& island : {hit, other})
    for (const BodyId id : island) p.rest(id);
  p.ball({4, 10, 0}, {0, -1, 0});
  const auto events = p.run(20.0, [&](const Event& event) {
    if (event.kind == EventKind::contact_begin && event.approach_speed > 0.5)
      p.set_velocity({10, 0}, {0, 1, 0});
  });
  EXPECT_EQ(woke(events), std::set<BodyId>(hit.begin(), hit.end()));
  for (const BodyId id : other) EXPECT_TRUE(p.resting(id));
  EXPECT_TRUE(is_clean(p.world));
}

TEST_P(Modes, EachChangeWakesTheIsland) {
  const auto islands = [](const auto& change, bool tells_of_itself) {
    Rested p({.contacts = GetParam()});
    p.world.add_static({.shape = Box{{-1, -1, -2}, {20, 1, -1}}}).value();
    const auto balls = row(p, 4, {0, 0, 0});
    p.run(0.0);
    for (const BodyId id : balls) p.rest(id);
    EXPECT_TRUE(p.run(1.0).empty());
    change(p, balls[1]);
    std::set<BodyId> expected(balls.begin(), balls.end());
    if (!tells_of_itself) expected.erase(balls[1]);
    EXPECT_EQ(woke(p.run(1.0)), expected);
    EXPECT_TRUE(is_clean(p.world));
    const BodyDefinition now = p.world.body(balls[3]).value().definition;
    EXPECT_EQ(now.acceleration_limit, limit);
  };
  islands([](Rested& p, BodyId id) { p.world.wake(id).value(); }, true);
  islands([](Rested& p, BodyId id) { p.set_velocity(id, {0, 0, 1}); }, true);
  islands(
      [](Rested& p, BodyId id) {
        p.set_position(id, {2, 0, 30});
        p.world.teleport(id, p.state(id)).value();
      },
      true);
  islands([](Rested& p, BodyId id) { p.world.change(id, {.radius = 0.5}).value(); }, true);
  islands(
      [](Rested& p, BodyId id) {
        p.world.change(id, {.motion_limits = MotionLimits{.acceleration_limit = 1}}).value();
      },
      true);
  islands([](Rested& p, BodyId id) { p.world.remove(id).value(); }, false);
  islands([](Rested& p, BodyId id) { p.world.disable(id).value(); }, false);
  islands([](Rested& p, BodyId) { p.world.remove(BodyId{0, 0}).value(); }, true);
  islands([](Rested& p, BodyId) { p.world.disable({0, 0}).value(); }, true);
}

struct RestedUponOneThatIsAwake : Rested {
  RestedUponOneThatIsAwake() {
    run(0.0);
    rest(above);
    run(1.0);
  }

  BodyId below = ball({0, 0, 0});
  BodyId above = ball({0, 0, 2});
};

TEST(Sleep, EndsWhenABodyThatIsAwakeLeavesAContact) {
  RestedUponOneThatIsAwake p;
  p.set_velocity(p.below, {0, 0, -1});
  const auto events = p.run(2.0);
  EXPECT_EQ(woke(events), std::set<BodyId>{p.above});
  EXPECT_EQ(of_kind(events, EventKind::contact_end).size(), 1u);
}

TEST(Sleep, IsSeenInTheViewWithTheLimitsOfTheBody) {
  Rested p;
  const BodyId id = p.ball({1, 2, 3});
  p.rest(id);
  p.run(10.0);
  const BodyView view = p.world.body(id).value();
  EXPECT_TRUE(view.sleeping);
  EXPECT_EQ(view.definition.acceleration_limit, limit);
  EXPECT_EQ(view.bound.acceleration_limit, 0.0);
  EXPECT_EQ(view.bound.radius_at(10.0), 1.0);
  p.world.sleep(id).value();
  EXPECT_TRUE(p.run(11.0).empty());
  p.world.wake(id).value();
  EXPECT_FALSE(p.resting(id));
  EXPECT_EQ(p.world.body(id).value().bound.acceleration_limit, limit);
  p.world.wake(id).value();
  EXPECT_EQ(p.run(12.0).size(), 1u);
}

TEST(Sleep, GoesOnBesideABodyThatIsAwakeAndIsWoken) {
  RestedUponOneThatIsAwake p;
  p.world.wake(p.below).value();
  EXPECT_TRUE(p.resting(p.above));
  EXPECT_TRUE(p.run(2.0).empty());
}

TEST(Sleep, AsksOnceWhereABodyIsWhoseReportIsOld) {
  Rested p;
  const BodyId id = p.ball({}, {1, 0, 0});
  p.run(1.0);
  p.ball({50, 0, 0});
  p.run(1.5);
  const auto before = p.world.counters().probes;
  p.rest(id);
  EXPECT_TRUE(p.run(100.0).empty());
  EXPECT_GE(p.world.counters().probes, before + 1);
  EXPECT_EQ(p.world.body(id).value().bound.centre_at(100.0), (Vec3{1.5, 0, 0}));
  EXPECT_EQ(p.world.body(id).value().bound.time, 1.5);
}

TEST(Sleep, OfABodyThatMovesIsABrokenPromise) {
  Rested p;
  const BodyId id = p.ball({}, {1, 0, 0});
  p.run(1.01);
  p.world.sleep(id).value();
  const auto events = p.run(1.01);
  ASSERT_EQ(events.size(), 1u) << events;
  EXPECT_EQ(events[0].kind, EventKind::bound_violation);
  EXPECT_NEAR(events[0].velocity_excess, 1.0, 1e-9);
}

TEST(Sleep, OfABodyThatMovesIsABrokenPromiseAlsoWhereItsReportIsFromNow) {
  for (const bool stops : {false, true}) {
    SCOPED_TRACE(stops ? "stops" : "moves on");
    Rested p;
    const BodyId id = p.ball({}, {1, 0, 0}), other = p.ball({20, 0, 0});
    if (stops) p.set_velocity_unseen(id, {});
    p.world.sleep(id).value();
    EXPECT_TRUE(is_clean(p.world));
    const auto restored = World::restore(p.world.save().value());
    EXPECT_TRUE(restored) << restored.error().message;
    const auto events = p.run(0.0);
    ASSERT_EQ(events.size(), stops ? 0u : 1u) << events;
    for (const Event& event : events) {
      EXPECT_EQ(event.kind, EventKind::bound_violation);
      EXPECT_NEAR(event.velocity_excess, 1.0, 1e-9);
    }
    EXPECT_TRUE(p.resting(id));
    EXPECT_EQ(p.world.body(id).value().bound.velocity, Vec3{});
    EXPECT_TRUE(is_clean(p.world));
    // Awake again in the same instant, before anyone has asked where it is.
    p.world.set_velocity(other, {-1, 0, 0}).value();
    p.world.sleep(other).value();
    p.world.wake(other).value();
    p.set_velocity_unseen(other, {-1, 0, 0});
    EXPECT_TRUE(is_clean(p.world));
    EXPECT_EQ(of_kind(p.run(0.0), EventKind::woke).size(), 1u);
    p.world.set_velocity(other, {-1, 0, 0}).value();
    EXPECT_TRUE(of_kind(p.run(1.0), EventKind::bound_violation).empty());
    EXPECT_TRUE(is_clean(p.world));
  }
}

TEST(Sleep, AtAnEventIsABrokenPromiseOfABodyThatMovesOn) {
  Rested p;
  const BodyId id = p.ball({}, {1, 0, 0});
  p.ball({5, 0, 0});
  const auto events = p.run(10.0, [&](const Event& event) {
    if (event.kind == EventKind::contact_begin) p.world.sleep(id).value();
  });
  ASSERT_EQ(events.size(), 2u) << events;
  EXPECT_EQ(events[0].kind, EventKind::contact_begin);
  EXPECT_EQ(events[1].kind, EventKind::bound_violation);
  EXPECT_EQ(events[1].first, id);
}

TEST(Sleep, OfABodyThatMovesOnOtherwiseInTheSameInstantEndsWithItsNewVelocity) {
  Rested p;
  const BodyId id = p.ball({}, {1, 0, 0});
  p.ball({5, 1.5, 0});
  p.ball({5, -1.5, 0});
  const Vec3 velocity{1, 0.125, 0};
  const auto events =
      of_kind(p.run(10.0,
                    [&](const Event& event) {
                      if (event.kind != EventKind::contact_begin || p.state(id).velocity.y > 0.0) return;
                      p.world.sleep(id).value();
                      p.set_velocity(id, velocity);
                    }),
              EventKind::contact_begin);
  ASSERT_EQ(events.size(), 2u) << events;
  EXPECT_EQ(events[0].time, events[1].time);
  EXPECT_EQ(events[0].first_state.velocity, (Vec3{1, 0, 0}));
  EXPECT_EQ(events[1].first_state.velocity, velocity);
}

TEST_P(Modes, ABodyThatIsRemovedIsNotToldToWake) {
  Rested p({.contacts = GetParam()});
  const auto balls = row(p, 3, {0, 0, 0});
  p.run(0.0);
  for (const BodyId id : balls) p.rest(id);
  p.world.remove({balls[0], balls[1]}).value();
  p.world.disable(balls[2]).value();
  EXPECT_TRUE(woke(p.run(1.0)).empty());
}

TEST(Sleep, AfterItHasBeenBrokenIsNotToldToBeOver) {
  Rested p({.contacts = ContactEvents::impacts});
  const BodyId sleeper = p.ball({});
  p.rest(sleeper);
  p.run(1.0);
  const BodyId thrown = p.ball({5, 0, 0}, {-1, 0, 0});
  const auto events = p.run(20.0, [&](const Event& event) {
    if (event.kind != EventKind::contact_begin) return;
    EXPECT_FALSE(p.resting(sleeper));
    p.set_velocity(thrown, {1, 0, 0});
    p.rest(sleeper);
  });
  EXPECT_EQ(of_kind(events, EventKind::contact_begin).size(), 1u);
  EXPECT_TRUE(of_kind(events, EventKind::woke).empty()) << events;
  EXPECT_TRUE(p.resting(sleeper));
}

TEST(Sleep, RefusesWhatCannotRest) {
  Rested p;
  const BodyId id = p.ball({});
  const BodyId fixed = p.world.add_static({.shape = Ball{{9, 0, 0}, 1}}).value();
  expect_error(p.world.sleep(fixed), ErrorCode::static_body, "body", "sleep: ", fixed);
  expect_error(p.world.wake(fixed), ErrorCode::static_body, "body", "wake: ", fixed);
  p.world.disable(id).value();
  expect_error(p.world.sleep(id), ErrorCode::disabled_body, "body", "sleep: ", id);
  p.world.remove(id).value();
  expect_error(p.world.wake(id), ErrorCode::stale_body, "body", "wake: ", id);
}

/// Balls that fly about and are put to sleep in place, by a caller that does not know the future. The
/// reported events are compared with the exact gaps.
class RandomScene {
 public:
  explicit RandomScene(std::uint64_t seed) : random_(seed), p_(definition()) {
    if (random_.bits() % 3 == 0) p_.world.set_sensor(0, {.distances = {0.1}}).value();
    for (int k = 0; k < 10; ++k) {
      const double a = 2.0 * random_.uniform();
      p_.add({.radius = 0.1 + 0.25 * random_.uniform(),
              .acceleration_limit = a,
              .position = 0.4 * Vec3{1, 1, 1} + 3.2 * place(),
              .velocity = random_.point_in_ball()},
             0.99 * a * random_.point_in_ball());
    }
    p_.distort = [this](BodyId id, double, State&) {
      EXPECT_FALSE(is_known_to_rest_.contains(id)) << "a probe of " << id << ", which rests";
      ++probes_;
    };
    p_.world.start_recording().value();
  }

  void go() {
    for (int step = 0; step < 30 && !testing::Test::HasFailure(); ++step) {
      change();
      const double until = p_.world.time() + 0.1 * random_.uniform();
      while (const auto event = p_.advance(until)) hear(*event);
      check();
      if (step % 10 == 5) {
        const auto bytes = p_.world.save().value();
        EXPECT_EQ(World::restore(bytes).value().save().value(), bytes);
      }
    }
    auto replay = Replay::open(p_.world.stop_recording().value()).value();
    while (!replay.finished()) {
      const auto event = replay.advance();
      ASSERT_TRUE(event) << event.error().message;
    }
  }
  int woke() const { return woken_; }
  int rests() const { return rests_; }

 private:
  WorldDefinition definition() {
    WorldDefinition world{.box = Box{{0, 0, 0}, {4, 4, 4}}};
    if (random_.bits() % 2 == 0) world.contacts = ContactEvents::impacts;
    if (random_.bits() % 4 == 0) world.periodic = {true, true, false};
    return world;
  }
  Vec3 place() { return {random_.uniform(), random_.uniform(), random_.uniform()}; }
  bool resting(BodyId id) const { return p_.world.body(id).value().sleeping; }

  void change() {
    for (auto count = random_.bits() % 4; count > 0; --count) {
      const auto bodies = p_.world.bodies();
      const BodyId id = bodies[random_.bits() % bodies.size()];
      const std::set<BodyId> before = all_resting();
      switch (random_.bits() % 8) {
        case 0:
          p_.set_velocity(id, random_.point_in_ball());
          break;
        case 1:
          p_.world.wake(id).value();
          break;
        case 2:
          if (bodies.size() <= 6) break;
          p_.world.remove(id).value();
          awaited_.erase(id);
          break;
        default:
          p_.set_velocity_unseen(id, {});
          p_.steer(id, {});
          p_.world.sleep(id).value();
          ++rests_;
          EXPECT_TRUE(resting(id));
          awaited_.erase(id);
      }
      note_woken(before);
    }
  }

  void hear(const Event& event) {
    const std::set<BodyId> before = told_to_rest_;
    if (event.kind == EventKind::woke) {
      ++woken_;
      EXPECT_EQ(awaited_.erase(event.first), 1u) << event;
      EXPECT_EQ(event.first_state.velocity, Vec3{});
      return;
    }
    note_woken(before);
    if (event.kind == EventKind::contact_begin || event.kind == EventKind::contact_end) {
      for (const BodyId id : {event.first, event.second})
        EXPECT_FALSE(p_.world.contains(id) && resting(id)) << event;
    }
    if (event.kind == EventKind::contact_begin && event.approach_speed > 0.0) {
      for (const auto& [id, sign] : {std::pair(event.first, -1.0), std::pair(event.second, 1.0)})
        p_.set_velocity(id, p_.state(id).velocity + sign * event.approach_speed * event.normal);
      note_woken(before);
    }
    if (event.kind == EventKind::wall_begin && event.approach_speed > 0.0)
      p_.set_velocity(event.first,
                      p_.state(event.first).velocity - 2.0 * event.approach_speed * event.normal);
  }

  std::set<BodyId> all_resting() const {
    std::set<BodyId> ids;
    for (const BodyId id : p_.world.bodies())
      if (resting(id)) ids.insert(id);
    return ids;
  }

  /// Each body that slept and does not any more must be reported, and no body in touch with it sleeps.
  void note_woken(const std::set<BodyId>& before) {
    told_to_rest_ = all_resting();
    for (const BodyId id : before) {
      if (told_to_rest_.contains(id) || !p_.world.contains(id)) continue;
      awaited_.insert(id);
      is_known_to_rest_.erase(id);
      for (const BodyId other : told_to_rest_) EXPECT_GT(gap(id, other), 4e-6) << id << " " << other;
    }
  }

  double gap(BodyId a, BodyId b) const {
    Vec3 way = p_.state(b).position - p_.state(a).position;
    const Axes periodic = p_.world.definition().periodic;
    for (int axis = 0; axis < 3; ++axis)
      if (periodic[axis]) way[axis] = std::remainder(way[axis], 4.0);
    return norm(way) - p_.radius(a) - p_.radius(b);
  }

  void check() {
    ASSERT_TRUE(is_clean(p_.world));
    EXPECT_TRUE(awaited_.empty());
    is_known_to_rest_ = told_to_rest_ = all_resting();
    const auto bodies = p_.world.bodies();
    for (const BodyId a : bodies)
      for (const BodyId b : bodies) {
        if (!(a < b)) continue;
        const auto touching = p_.world.touching(a).value();
        const bool touch = std::find(touching.begin(), touching.end(), b) != touching.end();
        const double gap = this->gap(a, b);
        if (p_.world.definition().contacts == ContactEvents::impacts) continue;
        EXPECT_TRUE(touch || gap >= -1.1e-6) << a << " " << b << " overlap untold: " << gap;
        EXPECT_TRUE(!touch || gap <= 5.1e-6) << a << " " << b << " are apart untold: " << gap;
      }
  }

  Random random_;
  Rested p_;
  std::set<BodyId> told_to_rest_, is_known_to_rest_, awaited_;
  int woken_ = 0, rests_ = 0, probes_ = 0;
};

TEST(Sleep, InAThousandScenesIsWhatTheExactGapsTell) {
  int woke = 0;
  int rests = 0;
  for (std::uint64_t seed = 0; seed < 1000 && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomScene scene(seed);
    scene.go();
    woke += scene.woke();
    rests += scene.rests();
  }
  EXPECT_GT(rests, 10000) << "too little happens";
  EXPECT_GT(woke, 5000) << "too little happens";
}

}  // namespace
}  // namespace kinesphere::sleep_test
