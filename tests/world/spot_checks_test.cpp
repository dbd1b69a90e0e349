// Spot checks: a body that promises to fly straight on, or along its plan, is asked now and then whether it
// does.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>

#include "kinesphere/motion/ballistic.hpp"
#include "kinesphere/recording.hpp"
#include "kinesphere/workers.hpp"
#include "support/playground.hpp"

namespace kinesphere::spot_checks_test {
namespace {

constexpr double frame = 1.0 / 60.0;

/// A mistake of a newcomer: a motion, and a body whose limit of 0 does not allow it.
struct Mistake {
  std::string name;
  BodyDefinition body;
  std::function<State(double)> path;

  friend std::ostream& operator<<(std::ostream& out, const Mistake& mistake) { return out << mistake.name; }
};

const std::vector<Mistake> mistakes{
    {"falls_from_rest",
     {.position = {0, 0, 30}},
     [](double t) {
       return State{{0, 0, 30 - 4.905 * t * t}, {0, 0, -9.81 * t}};
     }},
    {"is_thrown",
     {.position = {0, 0, 2}, .velocity = {0.5, 0, 12}},
     [](double t) {
       return State{{0.5 * t, 0, 2 + 12 * t - 4.905 * t * t}, {0.5, 0, 12 - 9.81 * t}};
     }},
    {"circles",
     {.position = {20, 0, 5}, .velocity = {0, 10, 0}},
     [](double t) {
       const double c = std::cos(t / 2), s = std::sin(t / 2);
       return State{{20 * c, 20 * s, 5}, {-10 * s, 10 * c, 0}};
     }},
    {"moves_faster_than_it_says",
     {.position = {0, 0, 5}, .velocity = {1, 0, 0}},
     [](double t) {
       return State{{1.5 * t, 0, 5}, {1, 0, 0}};
     }},
    {"moves_and_says_that_it_stands",
     {.position = {0, 0, 5}},
     [](double t) {
       return State{{t, 0, 5}, {}};
     }},
};

/// Five bodies that fly straight on or stand still above a floor, but for one of them.
struct Newcomer {
  World world = World::create({}).value();
  std::vector<BodyId> ids;
  std::size_t wrong;
  Mistake mistake;
  std::vector<BodyDefinition> others{{.position = {40, 0, 5}, .velocity = {0, 0, 0.5}},
                                     {.position = {50, 10, 5}},
                                     {.position = {60, 20, 5}, .velocity = {1, 1, 0}},
                                     {.position = {70, 30, 5}}};

  Newcomer(const Mistake& of_his, std::size_t place) : wrong(place), mistake(of_his) {
    world.add_static({.shape = HalfSpace{{0, 0, 1}, 0}}).value();
    for (std::size_t k = 0; k < 5; ++k) ids.push_back(world.add(definition(k)).value());
  }
  BodyDefinition definition(std::size_t k) const {
    return k == wrong ? mistake.body : others[k < wrong ? k : k - 1];
  }
  auto probe() {
    return [this](std::span<const BodyId> asked, double time, std::span<State> states) {
      for (std::size_t j = 0; j < asked.size(); ++j) {
        const auto k = static_cast<std::size_t>(std::find(ids.begin(), ids.end(), asked[j]) - ids.begin());
        const BodyDefinition body = definition(k);
        states[j] =
            k == wrong ? mistake.path(time) : State{body.position + body.velocity * time, body.velocity};
      }
    };
  }
};

class Newcomers : public testing::TestWithParam<Mistake> {};
INSTANTIATE_TEST_SUITE_P(Mistakes, Newcomers, testing::ValuesIn(mistakes),
                         [](const auto& mistake) { return mistake.param.name; });

TEST_P(Newcomers, AreToldInTheFirstFrame) {
  for (std::size_t place = 0; place < 5; ++place) {
    Newcomer newcomer(GetParam(), place);
    const auto event = newcomer.world.advance(frame, newcomer.probe()).value();
    ASSERT_TRUE(event);
    EXPECT_EQ(event->kind, EventKind::bound_violation);
    EXPECT_EQ(event->first, newcomer.ids[place]);
    EXPECT_LE(event->time, 1.0 / 64.0);
    EXPECT_GT(event->position_excess + event->velocity_excess, 0.0);
    EXPECT_EQ(event->first_state, GetParam().path(event->time));
    for (const Event& later : newcomer.world.events(frame, newcomer.probe()))
      EXPECT_EQ(later.first, newcomer.ids[place]);
    EXPECT_FALSE(newcomer.world.inspection().audit());
  }
}

TEST_P(Newcomers, AreToldInOneCall) {
  for (std::size_t place = 0; place < 5; ++place) {
    Newcomer newcomer(GetParam(), place);
    std::size_t told = 0;
    for (const Event& event : newcomer.world.events(20.0, newcomer.probe())) {
      if (event.kind != EventKind::bound_violation) continue;
      EXPECT_EQ(event.first, newcomer.ids[place]);
      ++told;
    }
    EXPECT_GE(told, 1u);
    EXPECT_LT(newcomer.world.counters().probes, 200u);
  }
}

/// By a run too, with as many probes, whatever shares the work.
TEST_P(Newcomers, AreToldByARun) {
  Newcomer looped(GetParam(), 2);
  EventHash loop;
  for (const Event& event : looped.world.events(20.0, looped.probe())) loop.add(event);
  for (const int threads : {1, 3}) {
    Newcomer run(GetParam(), 2);
    EventHash hash;
    Workers workers = Workers::create(threads).value();
    const auto sink = [&](const Event& event) { hash.add(event); };
    run.world.run(20.0, run.probe(), sink, &workers).value();
    EXPECT_EQ(hash.value(), loop.value()) << threads;
    EXPECT_EQ(run.world.counters().probes, looped.world.counters().probes) << threads;
  }
}

TEST_P(Newcomers, AreToldAlikeByAReplayAndAfterASnapshot) {
  Newcomer recorded(GetParam(), 1);
  recorded.world.start_recording().value();
  EventHash hash;
  std::vector<World> others;
  for (int k = 1; k <= 20; ++k) {
    if (k % 4 == 1) others.push_back(World::restore(recorded.world.save().value()).value());
    for (const Event& event : recorded.world.events(k * frame, recorded.probe())) hash.add(event);
    for (World& other : others) {
      while (other.advance(k * frame, recorded.probe()).value()) continue;
    }
  }
  for (World& other : others) EXPECT_EQ(other.counters(), recorded.world.counters());
  Replay replay = Replay::open(recorded.world.stop_recording().value()).value();
  EventHash again;
  while (!replay.finished())
    if (const auto event = replay.advance().value()) again.add(*event);
  EXPECT_EQ(again.value(), hash.value());
  EXPECT_EQ(replay.world().counters().probes, recorded.world.counters().probes);
}

/// A body that breaks its promise later is found out before four times the time has passed.
TEST(SpotChecks, FindWhoStandsStillAndLeavesLater) {
  for (const double leaves : {0.05, 0.7, 3.0, 20.0}) {
    Playground p;
    const BodyId pillar = p.add({.position = {9, 0, 0}});
    const BodyId player = p.add({.position = {0, 0, 0}});
    double told = -1.0;
    for (int k = 1; k < 4000 && told < 0.0; ++k) {
      if (k * frame >= leaves && p.state(player).velocity == Vec3{})
        p.set_velocity_unseen(player, {-1, 0, 0});
      for (const Event& event : p.run(k * frame)) {
        EXPECT_EQ(event.kind, EventKind::bound_violation);
        EXPECT_EQ(event.first, player) << pillar;
        told = event.time;
      }
    }
    EXPECT_GE(told, leaves);
    EXPECT_LE(told, 4.0 * leaves + 2.0 * frame);
  }
}

/// Bodies far apart that fly straight on for long, some with a plan.
struct Sky : Playground {
  std::vector<BodyId> ids;

  explicit Sky(std::size_t bodies, const WorldDefinition& definition = {}) : Playground(definition) {
    for (std::size_t k = 0; k < bodies; ++k) {
      const double x = 20.0 * static_cast<double>(k);
      ids.push_back(add({.radius = 0.5, .position = {x, 0, 0}, .velocity = {0, 0.5 + 0.001 * x, 0}}));
    }
  }
};

TEST(SpotChecks, FindWhoTurnsLaterAmongMany) {
  for (const bool spreads : {false, true}) {
    Sky sky(300, {.contact_tolerance = 1e-3, .spread_window_starts = spreads});
    sky.run(200.0);
    const std::uint64_t before = sky.world.counters().starts;
    sky.set_velocity_unseen(sky.ids[217], {0, 0, 1});
    std::vector<Event> events;
    while (events.empty() && sky.world.counters().starts - before < 300u * 40u)
      events = sky.run(sky.world.time() + 100.0);
    ASSERT_EQ(events.size(), 1u);
    EXPECT_EQ(events.front().kind, EventKind::bound_violation);
    EXPECT_EQ(events.front().first, sky.ids[217]);
    EXPECT_LE(sky.world.counters().starts - before, 300u * 34u);
  }
}

/// Where steered bodies are probed all the time, those that fly straight on are probed so often that one that
/// turns has not gone its radius when it is told, with less than a hundredth of all probes.
TEST(SpotChecks, FindWhoTurnsBeforeItHasGoneItsRadiusIfProbesAreMany) {
  for (const int exact : {1, 3}) {
    Playground p({.contact_tolerance = 1e-3});
    for (int k = 0; k < 200; ++k) {
      const Vec3 place{2.5 * (k % 20), 2.5 * (k / 20), 0};
      p.add({.radius = 0.5, .acceleration_limit = 3.0, .position = place}, Vec3{});
    }
    std::set<BodyId> straight;
    for (int k = 0; k < exact; ++k)
      straight.insert(
          p.add({.radius = 2.0, .position = {10.0 * k, 0, 100}, .velocity = {0.1 + 0.01 * k, 0.5, 0}}));
    p.run(20.0);
    std::uint64_t of_straight = 0;
    const std::uint64_t before = p.world.counters().probes;
    p.distort = [&](BodyId id, double, State&) { of_straight += straight.contains(id); };
    p.run(60.0);
    EXPECT_LE(of_straight, (p.world.counters().probes - before) / 100) << exact;
    const BodyId turns = *std::next(straight.begin(), exact / 2);
    p.set_velocity_unseen(turns, {0, 0, 0.7});
    std::vector<Event> events;
    while (events.empty() && p.world.time() < 100.0) events = p.run(p.world.time() + 0.1);
    ASSERT_EQ(events.size(), 1u) << exact;
    EXPECT_EQ(events.front().kind, EventKind::bound_violation);
    EXPECT_EQ(events.front().first, turns);
    EXPECT_LE((events.front().time - 60.0) * 0.7, 2.0) << exact;
  }
}

/// Balls that fall on a floor, and whose limits were left at 0, from 10 up in rows. All are checked within a
/// 64th, whatever their number. From then on their limits are those of gravity, so each touches the floor.
TEST(SpotChecks, FindAllWhoFall) {
  constexpr double g = 9.8;
  for (const std::size_t balls : {1u, 33u, 1000u}) {
    Playground p({.contact_tolerance = 1e-3});
    p.world.add_static({.shape = HalfSpace{{0, 0, 1}, 0}}).value();
    std::map<BodyId, double> touches;
    for (std::size_t k = 0; k < balls; ++k) {
      const double height = 10.0 + static_cast<double>(k % 7);
      const Vec3 place{3.0 * static_cast<double>(k % 32), 3.0 * static_cast<double>(k / 32), height};
      touches[p.add({.radius = 0.5, .position = place}, Vec3{0, 0, -g})] =
          std::sqrt(2.0 * (height - 0.5) / g);
    }
    std::size_t violations = 0, contacts = 0;
    for (int k = 1; k <= 110; ++k)
      for (const Event& event : p.run(k * frame)) {
        if (event.kind == EventKind::bound_violation) {
          ++violations;
          EXPECT_LE(event.time, 1.0 / 64.0);
          EXPECT_GE(event.acceleration_limit, g);
          EXPECT_LE(event.acceleration_limit, 1.02 * g);
          EXPECT_EQ(p.world.body(event.first).value().definition.acceleration_limit,
                    event.acceleration_limit);
        } else if (event.kind == EventKind::contact_begin) {
          ++contacts;
          const BodyId ball = event.first_traits.is_static ? event.second : event.first;
          EXPECT_NEAR(event.time, touches[ball], 1e-3);
          EXPECT_GE(event.gap, -1e-3);
        }
      }
    EXPECT_EQ(violations, balls);
    EXPECT_EQ(contacts, balls);
  }
}

TEST(SpotChecks, LeaveTheLimitThatWasPromisedIfTheyShould) {
  Playground p({.adopt_observed_limits = false});
  const BodyId ball = p.add({.radius = 0.5, .position = {0, 0, 10}}, Vec3{0, 0, -9.8});
  const auto events = p.run(1.0);
  ASSERT_FALSE(events.empty());
  for (const Event& event : events) {
    EXPECT_EQ(event.kind, EventKind::bound_violation);
    EXPECT_EQ(event.acceleration_limit, 0.0);
  }
  EXPECT_EQ(p.world.body(ball).value().definition.acceleration_limit, 0.0);
}

/// Bodies that come in each frame are checked as soon as those that came together.
TEST(SpotChecks, FindWhoFallsAmongBodiesThatArriveAllTheTime) {
  for (const double interval : {1.0 / 60.0, 1.0 / 500.0}) {
    Playground p({.contact_tolerance = 1e-3});
    std::map<BodyId, double> added, found;
    for (int k = 0; k < 100; ++k) {
      const double now = k * interval;
      for (const Event& event : p.run(now)) found.emplace(event.first, event.time);
      added[p.add({.radius = 0.5, .position = {3.0 * k, 0, 0}}, Vec3{0, 0, -9.8})] = now;
    }
    for (const Event& event : p.run(100 * interval + 0.1)) found.emplace(event.first, event.time);
    EXPECT_EQ(found.size(), added.size());
    for (const auto& [ball, time] : found) EXPECT_LE(time - added[ball], 1.5 / 64.0) << ball;
    // Of them, nine for each that falls, as it leaves its safe regions.
    EXPECT_LT(p.world.counters().probes, 1000u);
  }
}

/// In the long run, and where bodies are new.
TEST(SpotChecks, AreFew) {
  Sky sky(300, {.contact_tolerance = 1e-3});
  sky.run(1.0);
  // One each within 1/64, more of the first bodies, and few where windows start.
  EXPECT_LE(sky.world.counters().probes, 300u + 32u * 6u);
  const Counters before = sky.world.counters();
  sky.run(1e7);
  const Counters& after = sky.world.counters();
  ASSERT_GT(after.starts - before.starts, 6000u);
  EXPECT_GT(after.probes, before.probes);
  // And one of each of the first bodies whenever the time has quadrupled.
  EXPECT_LE(after.probes - before.probes, (after.starts - before.starts) / 30u + 32u * 12u);
  EXPECT_EQ(after.events, Counters().events);
}

/// Calls and their ends do not choose who is checked.
TEST(SpotChecks, DoNotDependOnCalls) {
  Sky at_once(100), in_frames(100);
  at_once.run(20.0);
  for (int k = 1; k <= 200; ++k) in_frames.run(0.1 * k);
  in_frames.run(20.0);
  EXPECT_EQ(in_frames.world.counters(), at_once.world.counters());
  EXPECT_GT(at_once.world.counters().probes, 0u);
}

TEST(SpotChecks, AccuseNobodyWhoKeepsAPromiseForVeryLong) {
  for (const double tolerance : {1e-3, 1e-6}) {
    // Each state is computed from an origin long before the body was added.
    const double begin = -1000.0;
    World world = World::create({.contact_tolerance = tolerance, .start_time = 1.0}).value();
    const double length = 1e6 * tolerance;
    const std::vector<TrueCourse> courses{
        {begin, {{3, 4, 5}, Vec3{0.3, -0.1, 1.7} * length}, {}},
        {begin, {{300, 4, 5}, {1e-9, 0, 0}}, {}},
        {begin, {{-1e4, 0, 0}, Vec3{0, 0, 4} * length}, Vec3{0, 0, -8e-6} * length},
        {begin, {{0, 1e4, 0}, Vec3{-1001e-6, 0, 0} * length}, Vec3{1e-6, 0, 0} * length},
        {begin, {{-50, 60, 70}, {0, 0, 0}}, {}},
    };
    for (const TrueCourse& course : courses) {
      const State now = course.at(1.0);
      world
          .add({.planned_acceleration = course.acceleration,
                .position = now.position,
                .velocity = now.velocity})
          .value();
    }
    const auto probe = [&](std::span<const BodyId> ids, double time, std::span<State> states) {
      for (std::size_t k = 0; k < ids.size(); ++k) states[k] = courses[ids[k].index].at(time);
    };
    for (const double until : {1.01, 1.02, 2.0, 3.0, 10.0, 100.0, 1e3, 1e4, 1e5, 499e3, 1e6})
      for (const Event& event : world.events(until, probe))
        EXPECT_NE(event.kind, EventKind::bound_violation)
            << event << " excess " << event.position_excess << " " << event.velocity_excess;
    EXPECT_GT(world.counters().probes, 10u) << "they were asked";
  }
}

/// The velocity of a motion that adds up its steps is nearly zero at the top, where the plan says zero.
TEST(SpotChecks, AccuseNobodyAtTheTopOfAThrow) {
  for (const int steps : {7, 60, 100, 1000}) {
    World world = World::create({}).value();
    const double dt = 1.0 / steps;
    const Vec3 g{0, 0, -9.81};
    world.add({.planned_acceleration = g, .velocity = {0, 0, 9.81}}).value();
    bool at_top = false;
    const auto probe = [&](std::span<const BodyId>, double time, std::span<State> states) {
      State state{{0, 0, 0}, {0, 0, 9.81}};
      double now = 0.0;
      const auto step = [&](double length) {
        state.position += (state.velocity + 0.5 * length * g) * length;
        state.velocity += length * g;
      };
      for (; now + dt <= time + 1e-9; now += dt) step(dt);
      step(time - now);
      states[0] = state;
      at_top = at_top || norm(state.velocity) < 1e-9;
    };
    for (const Event& event : world.events(3.0, probe))
      ADD_FAILURE() << event << " " << event.velocity_excess;
    EXPECT_TRUE(at_top);
  }
}

/// Static, sleeping and disabled bodies and those that may deviate are not checked.
TEST(SpotChecks, AskOnlyForExactBodies) {
  World world = World::create({}).value();
  world.add_static({.shape = Box{{-1, -1, -1}, {1, 1, 1}}}).value();
  const BodyId asleep = world.add({.acceleration_limit = 9, .position = {10, 0, 0}}).value();
  world.sleep(asleep).value();
  const BodyId gone = world.add({.position = {20, 0, 0}, .velocity = {0, 1, 0}}).value();
  world.disable(gone).value();
  const BodyId unsure = world.add({.velocity_error = 1e-9, .position = {30, 0, 0}}).value();
  const BodyId spinning = world
                              .add_rigid_body({.body = {.position = {40, 0, 0}},
                                               .parts = {{{-1, 0, 0}, {1, 0, 0}, 0.5}},
                                               .rotation = {.angular_velocity = {0, 0, 3}}})
                              .value();
  const BodyId plate = world
                           .add_moving_shape({.body = {.position = {50, 0, 0}, .velocity = {0, 0, 1}},
                                              .shape = Box{{-1, -1, -1}, {1, 1, 1}}})
                           .value();
  std::set<BodyId> asked;
  const auto probe = [&](std::span<const BodyId> ids, double time, std::span<State> states) {
    asked.insert(ids.begin(), ids.end());
    for (std::size_t k = 0; k < ids.size(); ++k) {
      const double x = world.body(ids[k]).value().definition.position.x;
      states[k] = {{x, 0, ids[k] == plate ? time : 0.0}, {0, 0, ids[k] == plate ? 1.0 : 0.0}};
    }
  };
  for (int k = 1; k < 30; ++k) ASSERT_EQ(world.advance(frame * k, probe).value(), std::nullopt);
  EXPECT_EQ(asked, (std::set{spinning, plate})) << unsure;
}

/// Wrapped or not, a report is that of the nearest image.
TEST(SpotChecks, KnowThatSpaceRepeats) {
  World world = World::create({.box = Box{{0, 0, 0}, {10, 10, 10}}, .periodic = {true, true, true}}).value();
  world.add({.radius = 0.5, .position = {5, 5, 5}, .velocity = {3, 1, 0}}).value();
  std::size_t asked = 0;
  const auto probe = [&](std::span<const BodyId>, double time, std::span<State> states) {
    ++asked;
    states[0] = {{std::fmod(5 + 3 * time, 10.0), std::fmod(5 + time, 10.0), 5}, {3, 1, 0}};
  };
  for (int k = 1; k < 500; ++k) EXPECT_EQ(world.advance(0.1 * k, probe).value(), std::nullopt);
  EXPECT_GE(asked, 5u);
}

TEST(SpotChecks, RefuseABadAnswerAndAreRepeated) {
  World world = World::create({}).value();
  world.add({}).value();
  const auto none = [](std::span<const BodyId>, double, std::span<State>) {};
  const auto failed = world.advance(1.0, none);
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().code, ErrorCode::not_finite) << failed.error().message;
  EXPECT_EQ(failed.error().body.index, 0u);
  const auto late = [](std::span<const BodyId>, double, std::span<State> states) {
    states[0] = {{0, 0, -5}, {0, 0, -10}};
  };
  const auto event = world.advance(1.0, late).value();
  ASSERT_TRUE(event);
  EXPECT_EQ(event->kind, EventKind::bound_violation);
}

}  // namespace
}  // namespace kinesphere::spot_checks_test
