// Several threads, by World::run and by World::use_workers: events equal to those of a loop over advance() on
// one thread, to the last bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <mutex>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "kinesphere/kinesphere.hpp"
#include "kinesphere/workers.hpp"
#include "support/playground.hpp"
#include "world/bouncing_world.hpp"

namespace kinesphere::run_on_workers_test {
namespace {

struct Kind {
  std::string name;
  int side = 12;  ///< bodies along each axis
  double spacing = 2.4;
  double faster = 1.0;  ///< one in a hundred starts so many times as fast
  ContactEvents contacts = ContactEvents::begin_and_end;
  bool periodic = false;
  bool sensors = false;
  bool fixed = false;
  bool passes = false;  ///< no responses
  bool lies = false;    ///< one in three accelerates more than it promises
  double end = 3.0;
  std::vector<int> threads{};  ///< numbers of threads of the runs
};

/// Bodies of some sizes that bounce in a box.
struct Hall : BouncingWorld<RandomForces> {
  explicit Hall(const Kind& hall) : BouncingWorld(motion_in(hall), world_of(hall), 0.98), kind(hall) {
    passes = kind.passes;
    for (std::uint32_t number = 0; number < motion.size(); ++number) {
      BodyDefinition body = next();
      body.radius = number % 7 == 0 ? 0.7 : number % 3 == 0 ? 0.5 : 0.2;
      if (kind.sensors && number % 5 == 0) body.sensor_class = 1;
      if (kind.lies && number % 3 == 0) body.acceleration_limit *= 0.25;
      add(body, body.radius * body.radius * body.radius);
    }
    if (kind.sensors) world.set_sensor(1, {.distances = {0.3, 0.6}}).value();
    if (!kind.fixed) return;
    // Between the rows.
    const double lower = 0.5 * kind.spacing * 2.0;
    for (int k = 0; k < 3; ++k)
      world.add_static({.shape = Ball{{lower + k * 2 * kind.spacing, lower, lower}, 0.3}}).value();
    world.add_zone(Box{{5, 5, 5}, {12, 12, 12}}).value();
  }

  Kind kind;

 private:
  static RandomForces motion_in(const Kind& kind) {
    Random random(7);
    const auto side = static_cast<std::size_t>(kind.side);
    std::vector<State> states;
    for (std::size_t k = 0; k < side * side * side; ++k) {
      const auto at = [&](std::size_t place) { return kind.spacing * (double(place % side) + 0.5); };
      states.push_back({{at(k), at(k / side), at(k / side / side)}, 3.0 * random.point_in_ball()});
      if (k % 100 == 50) states.back().velocity *= kind.faster;
    }
    return RandomForces::create({.start = states, .acceleration_limits = std::vector(states.size(), 6.0)})
        .value();
  }
  static World world_of(const Kind& kind) {
    const double size = kind.side * kind.spacing;
    WorldDefinition definition{.box = Box{{0, 0, 0}, {size, size, size}}, .contacts = kind.contacts};
    if (kind.periodic) definition.periodic = {true, true, true};
    return World::create(definition).value();
  }
};

class RunOnWorkers : public ::testing::TestWithParam<Kind> {};

TEST_P(RunOnWorkers, AreAsOneLoop) {
  Hall looped(GetParam());
  looped.loop(looped.kind.end);
  EXPECT_GT(looped.reported, 300u);
  for (const int threads : looped.kind.threads) {
    SCOPED_TRACE(threads);
    Workers workers = Workers::create(threads).value();
    Hall run(GetParam());
    for (const double part : {0.01, 0.3, 0.3, 1.0}) run.run(part * run.kind.end, &workers).value();
    expect_same_course(run, looped);
    EXPECT_TRUE(is_clean(run.world));
  }
}

/// Throws at the events from a time on, until it is switched off.
TEST(RunsThatFail, LeaveAWorldThatGoesOnAsIfNothingHadHappened) {
  const Kind kind{.name = "failing", .sensors = true, .fixed = true};
  Hall looped(kind);
  looped.loop(kind.end);
  Workers workers = Workers::create(3).value();
  Hall run(kind);
  SingleMotionSource source(run.motion);
  std::atomic<double> fails_from = 1.0;
  const auto respond = [&](const Event& event) {
    if (event.time >= fails_from) throw std::runtime_error("no answer");
    return run.answer(event);
  };
  const auto sink = [&](const Event& event) { run.tell(event); };
  for (const double next : {1.5, 2.2, std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW((void)run.world.run(kind.end, source, respond, sink, &workers), std::runtime_error);
    EXPECT_LE(run.last, fails_from);
    fails_from = next;
  }
  EXPECT_TRUE(run.world.run(kind.end, source, respond, sink, &workers));
  EXPECT_EQ(run.reported, looped.reported);
  EXPECT_EQ(run.hash.value(), looped.hash.value());
  EXPECT_TRUE(is_clean(run.world));
}

/// A refused response is requested again.
TEST(RunsThatFail, GoOnWhenTheyFailNoMore) {
  const Kind kind{.name = "failing once"};
  Hall looped(kind);
  looped.loop(kind.end);
  Workers workers = Workers::create(2).value();
  Hall run(kind);
  SingleMotionSource source(run.motion);
  std::atomic<int> asked = 0;
  const auto respond = [&](const Event& event) {
    Response answer = run.answer(event);
    if (++asked % 400 == 0) answer.first_velocity = Vec3{0.0, std::numeric_limits<double>::quiet_NaN(), 0.0};
    return answer;
  };
  const auto sink = [&](const Event& event) { run.tell(event); };
  int refused = 0;
  for (;;) {
    const auto result = run.world.run(kind.end, source, respond, sink, &workers);
    if (result) break;
    EXPECT_EQ(result.error().code, ErrorCode::not_finite);
    ASSERT_LT(++refused, 100);
  }
  EXPECT_EQ(run.reported, looped.reported);
  EXPECT_EQ(run.hash.value(), looped.hash.value());
}

/// If the sink throws, queries must find bodies at their places, also those with velocity changes since they
/// have their safe regions.
TEST(RunsThatWereInterrupted, LeaveBodiesWhereQueriesFindThem) {
  Workers workers = Workers::create(2).value();
  Hall run({.name = "interrupted"});
  SingleMotionSource source(run.motion);
  const auto respond = [&](const Event& event) { return run.answer(event); };
  const auto sink = [&](const Event& event) {
    run.tell(event);
    throw std::runtime_error("no more");
  };
  std::size_t interrupted = 0;
  std::size_t not_found = 0;
  double last = -1.0;
  for (bool done = false; !done;) {
    try {
      done = static_cast<bool>(run.world.run(run.kind.end, source, respond, sink, &workers));
    } catch (const std::runtime_error&) {
    }
    if (run.world.time() == last) continue;
    last = run.world.time();
    ++interrupted;
    EXPECT_TRUE(interrupted % 64 != 0 || is_clean(run.world));
    for (const BodyId id : run.world.bodies()) {
      const Vec3 centre = run.world.body(id).value().bound.centre_at(last);
      const auto found = run.world.queries().overlapping(centre, 0.0).value();
      if (std::none_of(found.begin(), found.end(), [&](const auto& one) { return one.body == id; }))
        ++not_found;
    }
  }
  EXPECT_GT(interrupted, 10u);
  EXPECT_EQ(not_found, 0u);
}

/// Crowds that are steered: in each frame, most velocities change.
struct Steered {
  WorldDefinition world{};
  double acceleration_limit = 0.0;
  bool sensors = false, shapes = false, radii = false;
  bool filters = false;    ///< a pair filter, which is asked in one thread
  bool irregular = false;  ///< some have turned before, and the order is any
};

/// What a steered crowd has seen: its events, counts and snapshot.
struct Seen {
  std::uint64_t hash = 0;
  std::size_t events = 0;
  std::uint64_t probes = 0, certificates = 0, starts = 0;
  std::vector<std::byte> snapshot{};
  std::set<std::thread::id> probed_in{};

  bool operator==(const Seen& other) const {
    return hash == other.hash && events == other.events && probes == other.probes &&
           certificates == other.certificates && starts == other.starts && snapshot == other.snapshot;
  }
};

constexpr std::uint32_t steered = 5000;

Seen steer(const Steered& kind, Workers* workers, bool call_probe) {
  World world = World::create(kind.world).value();
  world.use_workers(workers, call_probe).value();
  if (kind.filters)
    world.set_pair_filter([](BodyId a, BodyId b) { return (a.index + b.index) % 5 > 0; }).value();
  if (kind.sensors) world.set_sensor(1, {.distances = {0.1}}).value();
  Random random(5);
  std::vector<BodyDefinition> bodies;
  for (std::uint32_t k = 0; k < steered; ++k) {
    const Vec3 place{k % 18 + 0.5, k / 18 % 18 + 0.5, k / 324 + 0.5};
    BodyDefinition body{.radius = 0.3, .position = place * 0.75, .velocity = 6.0 * random.point_in_ball()};
    if (k % 3 > 0) body.acceleration_limit = kind.acceleration_limit;
    if (kind.sensors && k % 4 == 0) body.sensor_class = 1;
    if (kind.radii && k % 5 == 0) body.radius_rate = 0.05;
    bodies.push_back(body);
  }
  const std::vector<BodyId> ids = world.add_all(bodies).value();
  for (int k = 0; kind.shapes && k < 20; ++k)
    world.add_static({.shape = Ball{13.0 * Vec3{random.uniform(), random.uniform(), random.uniform()}, 0.5}})
        .value();
  std::vector<Vec3> accelerations(steered);
  double began = 0.0;
  Seen seen;
  std::mutex mutex;
  const auto state = [&](std::size_t k, double time) {
    const double s = time - began;
    return State{bodies[k].position + (bodies[k].velocity + accelerations[k] * (0.5 * s)) * s,
                 bodies[k].velocity + accelerations[k] * s};
  };
  const Probe probe = [&](std::span<const BodyId> asked, double time, std::span<State> states) {
    for (std::size_t k = 0; k < asked.size(); ++k) states[k] = state(asked[k].index, time);
    const std::lock_guard lock(mutex);
    seen.probed_in.insert(std::this_thread::get_id());
  };
  EventHash hash;
  for (int frame = 1; frame <= 5; ++frame) {
    std::vector<BodyId> turned;
    std::vector<Vec3> velocities;
    for (std::uint32_t k = 0; k < steered; ++k) {
      bodies[k].position = state(k, world.time()).position;
      bodies[k].velocity = 0.9 * bodies[k].velocity + random.point_in_ball();
      if (bodies[k].acceleration_limit > 0.0)
        accelerations[k] = 0.99 * kind.acceleration_limit * random.point_in_ball();
      turned.push_back(ids[k]);
      velocities.push_back(bodies[k].velocity);
    }
    began = world.time();
    if (kind.irregular) {
      for (std::uint32_t k = 0; k < steered; k += 50) world.set_velocity(ids[k], bodies[k].velocity).value();
      std::reverse(turned.begin() + 100, turned.end());
      std::reverse(velocities.begin() + 100, velocities.end());
    }
    world.set_velocities(turned, velocities).value();
    for (const Event& event : world.events(frame / 60.0, probe)) {
      hash.add(event);
      ++seen.events;
    }
  }
  seen.hash = hash.value();
  seen.probes = world.counters().probes;
  seen.certificates = world.counters().certificates;
  seen.starts = world.counters().starts;
  seen.snapshot = world.save().value();
  return seen;
}

class WorkersOfAWorld : public testing::TestWithParam<Steered> {};

const Box room{{0, 0, 0}, {13.5, 13.5, 13.5}};
INSTANTIATE_TEST_SUITE_P(
    Of, WorkersOfAWorld,
    testing::Values(Steered{.world = {.contacts = ContactEvents::impacts}},
                    Steered{.world = {.box = room}, .acceleration_limit = 2.0, .sensors = true},
                    Steered{.world = {.box = room, .periodic = {true, true, true}},
                            .acceleration_limit = 2.0},
                    Steered{.world = {.box = room, .periodic = {true, true, true}, .shear_rate = 0.5}},
                    Steered{.world = {.box = room}, .shapes = true, .radii = true, .filters = true},
                    Steered{.sensors = true, .irregular = true}));

TEST_P(WorkersOfAWorld, ChangeNothingButTheTime) {
  const Seen expected = steer(GetParam(), nullptr, false);
  EXPECT_GT(expected.events, 50u);
  for (const int threads : {1, 2, 3}) {
    Workers workers = Workers::create(threads).value();
    for (const bool call_probe : {false, true}) {
      const Seen seen = steer(GetParam(), &workers, call_probe);
      EXPECT_TRUE(seen == expected) << threads << " threads, " << call_probe;
      if (!call_probe) {
        EXPECT_EQ(seen.probed_in, std::set{std::this_thread::get_id()});
      }
      EXPECT_LE(seen.probed_in.size(), static_cast<std::size_t>(threads));
    }
  }
}

TEST(WorkersOfAWorldThatAreBusy, LeaveTheWorkToTheCaller) {
  const Steered kind{.world = {.contacts = ContactEvents::impacts}};
  const Seen expected = steer(kind, nullptr, false);
  Workers workers = Workers::create(2).value();
  World other = World::create({}).value();
  Seen seen;
  const Probe probe = [](std::span<const BodyId>, double, std::span<State>) {};
  other.schedule({.time = 0.5}).value();
  other
      .run(
          1.0, probe, [&](const Event&) { seen = steer(kind, &workers, true); }, &workers)
      .value();
  EXPECT_TRUE(seen == expected);
}

TEST(WorkersOfAWorldThatAreGone, ConcernNoClone) {
  World world = World::create({}).value();
  std::vector<BodyId> ids = world.add_all(std::vector<BodyDefinition>(steered, {.radius = 0.0})).value();
  std::optional<World> copy;
  {
    Workers workers = Workers::create(2).value();
    world.use_workers(&workers).value();
    copy = world.clone().value();
    const Probe probe = [&](std::span<const BodyId>, double, std::span<State> states) {
      EXPECT_EQ(world.use_workers(nullptr).error().code, ErrorCode::probe_in_progress);
      std::fill(states.begin(), states.end(), State{});
    };
    world.change(ids[0], {.motion_limits = MotionLimits{.acceleration_limit = 1.0}}).value();
    world.queries(probe).overlapping({}, 1.0).value();
    world.use_workers(nullptr).value();
  }
  for (World* each : {&world, &*copy}) {
    ids = each->bodies();
    each->set_velocities(ids, std::vector<Vec3>(steered, Vec3{1, 0, 0})).value();
  }
}

std::vector<Kind> all_kinds(const std::vector<int>& threads) {
  std::vector<Kind> kinds{{.name = "bouncing"},
                          {.name = "impacts", .contacts = ContactEvents::impacts},
                          {.name = "dense", .side = 9, .spacing = 1.45, .end = 1.0},
                          {.name = "bullets", .faster = 60.0},
                          {.name = "periodic", .periodic = true},
                          {.name = "sensors", .sensors = true},
                          {.name = "fixed", .sensors = true, .fixed = true},
                          {.name = "passing", .sensors = true, .passes = true},
                          {.name = "lying", .passes = true, .lies = true, .end = 8.0},
                          {.name = "lying_impacts", .contacts = ContactEvents::impacts, .lies = true}};
  for (Kind& kind : kinds) kind.threads = threads;
  return kinds;
}
const auto name_of_kind = [](const auto& kind) { return kind.param.name; };
INSTANTIATE_TEST_SUITE_P(Of, RunOnWorkers, ::testing::ValuesIn(all_kinds({1, 3})), name_of_kind);
INSTANTIATE_TEST_SUITE_P(Long, RunOnWorkers, ::testing::ValuesIn(all_kinds({2, 8})), name_of_kind);

}  // namespace
}  // namespace kinesphere::run_on_workers_test
