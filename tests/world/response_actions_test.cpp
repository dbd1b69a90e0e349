// Responses that turn bodies, remove them, disable them, put them to sleep, or stop the world so that the
// sink adds bodies: World::run is equal to a loop over advance() that does the same, with any number of
// threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "kinesphere/kinesphere.hpp"
#include "kinesphere/workers.hpp"
#include "support/expect_error.hpp"
#include "support/playground.hpp"

namespace kinesphere::response_actions_test {
namespace {

/// A world whose bodies vanish and appear, advanced by a loop over advance() or by World::run.
struct Game {
  World world;
  std::unique_ptr<Motion> crowd;
  Ballistic shots = Ballistic::create({}).value();
  BodyMap bodies;
  /// Hash of all events, in their order, and of the ids of added bodies.
  std::uint64_t course = 0;
  std::size_t told = 0;
  std::size_t stops = 0;

  Game(World empty, std::unique_ptr<Motion> moved_by) : world(std::move(empty)), crowd(std::move(moved_by)) {}
  virtual ~Game() = default;

  virtual Response respond(const Event& event) const = 0;
  /// Changes the world at an event whose response has Response::stop.
  virtual void change(const Event&) {}

  void loop(double until) {
    while (const auto event = world.advance(until, bodies.probe()).value()) {
      const Response given = respond(*event);
      const auto turn = [&](BodyId id, const std::optional<Vec3>& velocity, BodyAction action) {
        if (action == BodyAction::sleep && awake(id)) bodies.set_velocity(world, id, {}).value();
        if (action != BodyAction::sleep && velocity && enabled(id))
          bodies.set_velocity(world, id, *velocity).value();
      };
      const auto spin = [&](BodyId id, const std::optional<Vec3>& angular_velocity) {
        if (angular_velocity && enabled(id)) world.change(id, {.angular_velocity = angular_velocity}).value();
      };
      turn(event->first, given.first_velocity, given.first_action);
      turn(event->second, given.second_velocity, given.second_action);
      spin(event->first, given.first_angular_velocity);
      spin(event->second, given.second_angular_velocity);
      act(event->first, given.first_action);
      act(event->second, given.second_action);
      tell(*event, given);
    }
  }
  Result<void> run(double until, Workers* workers) {
    auto source = bodies.source();
    return world.run(
        until, source, [this](const Event& event) { return respond(event); },
        [this](const Event& event) { tell(event, respond(event)); }, workers);
  }

  void tell(const Event& event, const Response& given) {
    EventHash one;
    one.add(event);
    course = 31 * course + one.value();
    ++told;
    if (!given.stop) return;
    ++stops;
    EXPECT_EQ(world.time(), event.time);
    change(event);
  }

 private:
  bool enabled(BodyId id) const { return world.contains(id) && world.body(id).value().enabled; }
  bool awake(BodyId id) const { return enabled(id) && !world.body(id).value().sleeping; }
  void act(BodyId id, BodyAction action) {
    if (action == BodyAction::remove && world.contains(id)) world.remove(id).value();
    if (action == BodyAction::disable && enabled(id)) world.disable(id).value();
    if (action == BodyAction::sleep && awake(id)) world.sleep(id).value();
  }
};

/// Returns the ids that bodies would get that were added now: those of free numbers, last freed first.
std::vector<BodyId> next_ids(const World& world) {
  World copy = world.clone().value();
  std::vector<BodyId> ids;
  for (int k = 0; k < 40; ++k) ids.push_back({.index = copy.add({}).value().index});
  return ids;
}

void expect_same_course(const Game& found, const Game& expected) {
  EXPECT_EQ(found.told, expected.told);
  EXPECT_EQ(found.stops, expected.stops);
  EXPECT_EQ(found.course, expected.course);
  EXPECT_EQ(found.world.bodies(), expected.world.bodies());
  EXPECT_EQ(found.world.counters().probes, expected.world.counters().probes);
  EXPECT_EQ(found.world.counters().pair_checks, expected.world.counters().pair_checks);
  EXPECT_TRUE(is_clean(found.world));
  EXPECT_EQ(next_ids(found.world), next_ids(expected.world));
}

// Random games.

struct Kind {
  std::string name;
  double faster = 1.0;  ///< one in twenty starts so many times as fast
  ContactEvents contacts = ContactEvents::begin_and_end;
  bool periodic = false;
  bool sensors = false;
  bool fixed = false;      ///< there are static bodies and a zone
  bool forces = false;     ///< bodies accelerate at random
  bool rigid = false;      ///< four in five turn, and are no balls
  bool carried = false;    ///< one in twelve, or in four if many turn, carries a box or a triangle
  bool removes = true;     ///< responses remove and disable bodies
  std::uint64_t stop = 0;  ///< one event in so many stops the world; 0: none
  std::uint64_t sleep = 0;
  double end = 2.0;
  std::vector<int> threads{};  ///< numbers of threads of the runs
};

constexpr int side = 12;
constexpr double spacing = 2.0;

/// A dumbbell, a capsule, a box or eight balls.
RigidBody thing(std::uint32_t number, double size) {
  Random random(number + 1);
  RigidBody body{.inertia = Vec3{0.2, 0.2, 0.2} * (size * size)};
  const auto ball = [&](const Vec3& place, double radius) {
    body.parts.push_back({place * size, place * size, radius * size});
  };
  switch (number % 4) {
    case 0:
      ball({-0.5, 0.0, 0.0}, 0.4);
      ball({0.5, 0.0, 0.0}, 0.3);
      break;
    case 1:
      body.parts = {{{-0.6 * size, 0.0, 0.0}, {0.6 * size, 0.0, 0.0}, 0.3 * size}};
      break;
    case 2:
      body.parts = {box_part({Vec3{-0.4, -0.4, -0.4} * size, Vec3{0.4, 0.4, 0.6} * size}, 0.05 * size)};
      break;
    default:
      for (int corner = 0; corner < 8; ++corner)
        ball({corner & 1 ? 0.3 : -0.3, corner & 2 ? 0.3 : -0.3, corner & 4 ? 0.3 : -0.3}, 0.25);
  }
  body.rotation = {rotation_by(3.0 * random.point_in_ball()), 3.0 * random.point_in_ball()};
  return body;
}

/// A box or a triangle.
Shape carried_shape(std::uint32_t number) {
  Random random(number + 1);
  const Vec3 lower = -random.uniform(0.1, 0.8) * Vec3{1.0, 1.0, 0.2};
  if (number % 8 == 5) return Box{lower, -1.0 * lower};
  return Triangle{lower, {0.9, -0.3, 0.0}, {-0.2, 0.9, 0.5}};
}

/// Bodies of three sizes that bounce in a box, and vanish at some contacts.
struct Shooting : Game {
  explicit Shooting(const Kind& of) : Game(world_of(of), motion_of(of)), kind(of) {
    std::vector<double> radii;
    for (std::uint32_t number = 0; number < crowd->size(); ++number)
      radii.push_back(number % 7 == 0 ? 0.6 : number % 3 == 0 ? 0.4 : 0.2);
    std::vector<BodyId> ids;
    const auto add = [&](std::uint32_t number) {
      if (kind.carried && number % (kind.rigid ? 4 : 12) == (kind.rigid ? 1 : 5))
        return bodies.add_moving_shape(world, *crowd, number, {{}, carried_shape(number)});
      if (kind.rigid && number % 5 != 0)
        return bodies.add_rigid_body(world, *crowd, number, thing(number, 1.5 * radii[number]));
      return bodies.add(world, *crowd, number, {.radius = radii[number]});
    };
    if (kind.rigid || kind.carried) {
      for (std::uint32_t number = 0; number < radii.size(); ++number) ids.push_back(add(number).value());
    } else {
      ids = bodies.add_all(world, *crowd, radii).value();
    }
    if (kind.sensors) {
      for (std::size_t k = 0; k < ids.size(); k += 5) world.change(ids[k], {.sensor_class = 1}).value();
      world.set_sensor(1, {.distances = {0.2, 0.4}}).value();
    }
    if (!kind.fixed) return;
    for (int k = 0; k < 27; ++k) {
      const Vec3 place = Vec3{double(k % 3), double(k / 3 % 3), double(k / 9)} * 4.0 * spacing;
      statics.push_back(
          world.add_static({.shape = Ball{place + Vec3{spacing, spacing, spacing}, 0.3}}).value());
    }
    statics.push_back(world.add_zone(Box{{5, 5, 5}, {12, 12, 12}}).value());
  }

  Response respond(const Event& event) const override {
    Random random(std::bit_cast<std::uint64_t>(event.time) ^ (event.first.pack() * 31) ^ event.second.pack() ^
                  static_cast<std::uint64_t>(event.kind));
    (void)random.bits();
    Response given;
    const bool touches = event.kind == EventKind::contact_begin || event.kind == EventKind::wall_begin;
    if (touches && event.approach_speed > 0.0 && random.bits() % 16 != 0)
      given = response_of(event, bounce(event, 0.99));
    if (event.kind == EventKind::woke) given.first_velocity = event.first_state.velocity;
    if (event.kind == EventKind::contact_end && random.bits() % 8 == 0)
      given.first_velocity = event.first_state.velocity * 0.5;
    given.first_action = action_for(event, event.first, random);
    given.second_action = action_for(event, event.second, random);
    given.stop = kind.stop != 0 && is_of_crowd(event.first) &&
                 (event.second == no_body || is_of_crowd(event.second)) && random.bits() % kind.stop == 0;
    return given;
  }

  void change(const Event& event) override {
    Random random(std::bit_cast<std::uint64_t>(event.time));
    for (int k = 0; k < 3; ++k) {
      const Vec3 place = event.point + Vec3{0.0, 0.0, 0.3 * (k - 1)};
      const Vec3 inside{inside_of(place.x), inside_of(place.y), inside_of(place.z)};
      const auto number = shots.add(event.time, {inside, 9.0 * random.point_in_ball()}).value();
      const BodyId id = bodies.add(world, shots, number, {.radius = 0.1}).value();
      course = 31 * course + id.pack();
    }
    const auto ids = world.bodies();
    const BodyId any = ids[random.bits() % ids.size()];
    if (!is_lasting(any) && !is_fixed(any)) world.remove(any).value();
  }

  Kind kind;
  std::vector<BodyId> statics;

 private:
  static constexpr double size = side * spacing;

  static double inside_of(double coordinate) { return std::clamp(coordinate, 0.2, size - 0.2); }
  static bool is_of_crowd(BodyId id) { return id.index < side * side * side && id.generation == 0; }
  /// Bodies that are never removed.
  static bool is_lasting(BodyId id) { return id.index < 200 && is_of_crowd(id); }
  bool is_fixed(BodyId id) const { return std::find(statics.begin(), statics.end(), id) != statics.end(); }

  BodyAction action_for(const Event& event, BodyId id, Random& random) const {
    if (id == no_body || is_lasting(id)) return BodyAction::none;
    const std::uint64_t dice = random.bits();
    if (is_fixed(id)) return kind.removes && dice % 16 == 0 ? BodyAction::remove : BodyAction::none;
    if (kind.sleep != 0 && dice % kind.sleep == 0 && event.kind == EventKind::contact_begin)
      return BodyAction::sleep;
    if (!kind.removes) return BodyAction::none;
    return dice % 8 == 1 ? BodyAction::remove : dice % 16 == 2 ? BodyAction::disable : BodyAction::none;
  }

  static std::unique_ptr<Motion> motion_of(const Kind& kind) {
    Random random(7);
    std::vector<State> states;
    for (std::size_t k = 0; k < side * side * side; ++k) {
      const auto at = [&](std::size_t place) { return spacing * (double(place % side) + 0.5); };
      states.push_back({{at(k), at(k / side), at(k / side / side)}, 3.0 * random.point_in_ball()});
      if (k % 20 == 10) states.back().velocity *= kind.faster;
    }
    if (!kind.forces) return std::make_unique<Ballistic>(Ballistic::create({.start = states}).value());
    const std::vector<double> limits(states.size(), 6.0);
    return std::make_unique<RandomForces>(
        RandomForces::create({.start = states, .acceleration_limits = limits}).value());
  }
  static World world_of(const Kind& kind) {
    WorldDefinition definition{.box = Box{{0, 0, 0}, {size, size, size}}, .contacts = kind.contacts};
    if (kind.periodic) definition.periodic = {true, true, true};
    return World::create(definition).value();
  }
};

class ResponseActions : public ::testing::TestWithParam<Kind> {};

TEST_P(ResponseActions, AreThoseOfALoop) {
  Shooting looped(GetParam());
  looped.loop(looped.kind.end);
  EXPECT_GT(looped.told, 1000u);
  EXPECT_EQ(looped.kind.stop != 0, looped.stops > 10);
  EXPECT_EQ(looped.kind.removes, looped.world.size() < looped.crowd->size() - 100);
  for (const int threads : looped.kind.threads) {
    SCOPED_TRACE(threads);
    Workers workers = Workers::create(threads).value();
    Shooting run(GetParam());
    for (const double part : {0.01, 0.3, 0.3, 1.0}) run.run(part * run.kind.end, &workers).value();
    expect_same_course(run, looped);
  }
}

std::vector<Kind> all_kinds(const std::vector<int>& threads) {
  std::vector<Kind> kinds{
      {.name = "vanishing"},
      {.name = "impacts", .contacts = ContactEvents::impacts},
      {.name = "bullets", .faster = 40.0},
      {.name = "forces", .faster = 20.0, .sensors = true, .forces = true},
      {.name = "periodic", .faster = 5.0, .periodic = true},
      {.name = "sensors", .sensors = true},
      {.name = "fixed", .sensors = true, .fixed = true},
      {.name = "spawns", .faster = 10.0, .sensors = true, .forces = true, .stop = 64},
      {.name = "spawns_alone", .forces = true, .removes = false, .stop = 64},
      {.name = "sleeping", .sensors = true, .stop = 64, .sleep = 256},
      {.name = "carried", .sensors = true, .carried = true, .stop = 64},
      {.name = "carried_impacts", .contacts = ContactEvents::impacts, .carried = true},
      {.name = "carried_forces", .faster = 5.0, .fixed = true, .forces = true, .carried = true},
      {.name = "carried_among_turning", .forces = true, .rigid = true, .carried = true},
      {.name = "turning", .contacts = ContactEvents::impacts, .rigid = true},
      {.name = "turning_periodic", .periodic = true, .rigid = true},
      {.name = "turning_forces", .sensors = true, .fixed = true, .forces = true, .rigid = true, .stop = 64}};
  for (Kind& kind : kinds) kind.threads = threads;
  return kinds;
}
const auto name_of_kind = [](const auto& kind) { return kind.param.name; };
INSTANTIATE_TEST_SUITE_P(Of, ResponseActions, ::testing::ValuesIn(all_kinds({1, 3})), name_of_kind);
INSTANTIATE_TEST_SUITE_P(Long, ResponseActions, ::testing::ValuesIn(all_kinds({2})), name_of_kind);

// Many things at one instant.

/// Many groups far from each other: a ball flies, with a companion that it touches, at two targets, and hits
/// both at one instant. This is the same in four groups each, which mirror each other.
struct Volley : Game {
  static constexpr std::uint32_t groups = 64;
  static constexpr std::uint32_t in_group = 4;  ///< two targets, the ball, its companion

  Volley() : Game(World::create({}).value(), motion()) {
    for (std::uint32_t number = 0; number < in_group * groups; ++number) {
      BodyDefinition like{.radius = number % in_group == 3 ? 0.3 : 0.5};
      like.sensor_class = number % in_group == 2 ? 1 : 0;
      bodies.add(world, *crowd, number, like).value();
    }
    world.set_sensor(1, {.distances = {0.25}}).value();
  }

  Response respond(const Event& event) const override {
    if (event.kind != EventKind::contact_begin || event.time == 0.0) return {};
    switch (event.first.index / in_group % 5) {
      case 0:  // the ball vanishes at the first target
        return {.second_action = BodyAction::remove};
      case 1:
        return {.first_action = BodyAction::remove, .second_action = BodyAction::disable};
      case 2:  // both targets vanish
        return {.first_action = BodyAction::remove};
      case 3: {
        Response bounced = response_of(event, bounce(event, 1.0));
        bounced.first_action = BodyAction::disable;
        return bounced;
      }
      default:
        return response_of(event, bounce(event, 1.0));
    }
  }

 private:
  static std::unique_ptr<Motion> motion() {
    std::vector<State> states;
    for (std::uint32_t k = 0; k < groups; ++k) {
      const auto sign = [k](unsigned bit) { return (k >> bit & 1u) != 0 ? 1.0 : -1.0; };
      const Vec3 place = Vec3{sign(0), 0.0, sign(1)} * (16.0 * (1 + k / 4));
      for (const double y : {0.75, -0.75}) states.push_back({place + Vec3{5.0 * sign(0), y, 0.0}, {}});
      for (const double x : {0.0, -0.5})
        states.push_back({place + Vec3{x * sign(0), 0.0, 0.0}, {8.0 * sign(0), 0.0, 0.0}});
    }
    return std::make_unique<Ballistic>(Ballistic::create({.start = states}).value());
  }
};

TEST(ResponsesAtOneInstant, AreThoseOfALoop) {
  Volley looped;
  looped.loop(0.1);
  std::map<double, int> begins;
  World passing = looped.world.clone().value();
  while (const auto event = passing.advance(1.0, looped.bodies.probe()).value())
    if (event->kind == EventKind::contact_begin) ++begins[event->time];
  for (const auto& [time, count] : begins) EXPECT_EQ(count % 8, 0) << "all balls hit both targets at once";
  looped.loop(2.0);
  for (const int threads : {1, 2, 3}) {
    SCOPED_TRACE(threads);
    Workers workers = Workers::create(threads).value();
    Volley run;
    run.run(0.1, &workers).value();
    run.run(2.0, &workers).value();
    expect_same_course(run, looped);
  }
  for (std::uint32_t k = 0; k < Volley::groups; k += 5) {
    EXPECT_TRUE(looped.world.contains({4 * k, 0}) && looped.world.contains({4 * k + 1, 0}));
    EXPECT_FALSE(looped.world.contains({4 * k + 2, 0}));
  }
}

// What an interrupted or recorded run leaves.

TEST(ResponseActions, AreRecordedAndReplayed) {
  const Kind kind{.name = "recorded", .sensors = true, .fixed = true, .stop = 64};
  Shooting looped(kind), run(kind);
  Workers workers = Workers::create(2).value();
  run.world.start_recording().value();
  looped.loop(1.0);
  run.run(1.0, &workers).value();
  EXPECT_EQ(run.course, looped.course);
  Replay replay = Replay::open(run.world.stop_recording().value()).value();
  EventHash replayed;
  std::size_t told = 0;
  while (!replay.finished()) {
    if (const auto event = replay.advance().value()) replayed.add(*event), ++told;
  }
  EXPECT_EQ(told, looped.told);
}

TEST(ResponseActions, LeaveAWorldThatCanBeSaved) {
  Shooting run({.name = "saved", .sensors = true, .fixed = true, .stop = 64});
  Workers workers = Workers::create(2).value();
  run.run(1.0, &workers).value();
  World restored = World::restore(run.world.save().value()).value();
  const auto on = [&](World& world) {
    EventHash hash;
    while (const auto event = world.advance(1.5, run.bodies.probe()).value()) hash.add(*event);
    return hash.value();
  };
  EXPECT_EQ(on(restored), on(run.world));
  EXPECT_EQ(restored.counters().probes, run.world.counters().probes);
  EXPECT_EQ(restored.bodies(), run.world.bodies());
}

/// Two balls that meet, one of which then meets a wall and a static ball.
struct Few {
  Ballistic motion = Ballistic::create({.start = {{{2, 5, 5}, {1, 0, 0}}, {{4, 5, 5}, {}}}}).value();
  World world = World::create({.box = Box{{0, 0, 0}, {10, 10, 10}}}).value();
  BodyMap bodies;
  std::vector<std::string> told;

  Few() {
    bodies.add_all(world, motion, {.radius = 0.5}).value();
    world.add_static({.shape = Ball{{8, 5, 5}, 0.5}}).value();
  }
  Result<void> run(const ResponseFn& respond, const EventFn& sink) {
    auto source = bodies.source();
    return world.run(20.0, source, respond, [&](const Event& event) {
      told.push_back(to_string(event));
      sink(event);
    });
  }
};

TEST(ResponseStop, LetsTheSinkChangeTheWorld) {
  Few few;
  std::optional<BodyId> added;
  const auto respond = [](const Event& event) {
    return Response{.stop = event.kind == EventKind::contact_begin && event.second.index == 1};
  };
  const auto sink = [&](const Event& event) {
    const auto busy = ErrorCode::run_in_progress;
    expect_error(few.world.advance(20.0, few.bodies.probe()), busy, "world", "advance:");
    expect_error(few.world.run(20.0, few.bodies.probe(), [](const Event&) {}), busy, "world", "run:");
    if (!respond(event).stop) return expect_error(few.world.add({}), busy, "world", "add:");
    EXPECT_EQ(few.world.time(), event.time);
    EXPECT_TRUE(few.world.save());
    const auto number = few.motion.add(event.time, {{5, 1, 5}, {0, -1, 0}}).value();
    added = few.bodies.add(few.world, few.motion, number, {.radius = 0.5}).value();
    few.bodies.remove(few.world, {1, 0}).value();
    throw std::runtime_error("interrupted");
  };
  EXPECT_THROW((void)few.run(respond, sink), std::runtime_error);
  few.run(respond, [](const Event&) {}).value();
  ASSERT_EQ(added, (BodyId{3, 0}));
  ASSERT_GE(few.told.size(), 3u);
  EXPECT_EQ(few.told[0].rfind("contact_begin of 0 and 1", 0), 0u);
  EXPECT_EQ(few.told[1].rfind("contact_end of 0 and 1", 0), 0u) << "not told again, and the change counts";
  EXPECT_EQ(few.told[2].rfind("wall_begin of 3 at y_lower", 0), 0u) << few.told[2];
}

TEST(ResponseStop, KeepsTheWorldFromGoing) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_DEATH(
      {
        auto few = std::make_unique<Few>();
        (void)few->run([](const Event&) { return Response{.stop = true}; },
                       [&](const Event&) { const World taken = std::move(few->world); });
      },
      "a World was moved from inside its own run");
}

TEST(WrongResponseAction, IsRefusedByBody) {
  const auto nothing = [](const Event&) {};
  Few few;
  const auto sleeps = [](const Event& event) {
    return Response{.second_action = event.second.index == 2 ? BodyAction::sleep : BodyAction::none};
  };
  const auto asleep = few.run(sleeps, nothing);
  expect_error(asleep, ErrorCode::static_body, "second_action",
               "run: respond: second_action at contact_begin", {2, 0});
  const auto at_wall = [](const Event& event) {
    const bool is_wall = event.kind == EventKind::wall_begin;
    return Response{.second_action = is_wall ? BodyAction::remove : BodyAction::none};
  };
  expect_error(few.run(at_wall, nothing), ErrorCode::unknown_body, "second_action",
               "run: respond: second_action at wall_begin", no_body);
}

TEST(ResponseActions, LeaveTheRestToTheMap) {
  Few few;
  const auto respond = [](const Event& event) {
    return Response{.second_action =
                        event.kind == EventKind::contact_begin ? BodyAction::remove : BodyAction::none};
  };
  few.run(respond,
          [&](const Event& event) {
            if (event.second == BodyId{1, 0} && few.bodies.find(event.second))
              few.bodies.remove(few.world, event.second).value();
          })
      .value();
  EXPECT_FALSE(few.bodies.find({1, 0}));
  EXPECT_FALSE(few.motion.contains(1));
  EXPECT_EQ(few.world.bodies(), (std::vector{BodyId{0, 0}})) << "the static ball as well";
}

/// A sink that ends the run at each stop leaves the world at that event, and another run goes on behind it.
TEST(EndRun, AtEachStopHasTheCourseOfOneRun) {
  for (const int threads : {1, 3}) {
    Workers workers = Workers::create(threads).value();
    const Kind kind{.name = "stops", .stop = 50};
    Shooting whole(kind), parts(kind);
    ASSERT_TRUE(whole.run(kind.end, &workers));
    auto source = parts.bodies.source();
    std::size_t runs = 0;
    for (; parts.world.time() < kind.end && !HasFailure(); ++runs) {
      double ended_at = kind.end;
      const auto sink = [&](const Event& event) {
        parts.tell(event, parts.respond(event));
        if (!parts.respond(event).stop) return;
        parts.world.end_run();
        ended_at = event.time;
      };
      ASSERT_TRUE(parts.world.run(
          kind.end, source, [&](const Event& event) { return parts.respond(event); }, sink, &workers));
      EXPECT_EQ(parts.world.time(), ended_at);
    }
    EXPECT_GT(runs, 10u);
    expect_same_course(parts, whole);
  }
}

TEST(EndRun, ElsewhereKeepsTheEventsThatAreStillToCome) {
  Shooting whole({.name = "whole"}), parts({.name = "parts"});
  Workers workers = Workers::create(3).value();
  whole.world.end_run();  // no effect outside a sink
  ASSERT_TRUE(whole.run(2.0, &workers));
  EXPECT_EQ(whole.world.time(), 2.0);
  auto source = parts.bodies.source();
  std::size_t runs = 0;
  for (std::size_t before = 1; before != parts.told; ++runs) {
    before = parts.told;
    std::size_t in_this = 0;
    const auto sink = [&](const Event& event) {
      parts.tell(event, parts.respond(event));
      if (++in_this == 100) parts.world.end_run();
    };
    ASSERT_TRUE(parts.world.run(
        2.0, source, [&](const Event& event) { return parts.respond(event); }, sink, &workers));
    EXPECT_LE(in_this, 100u);
  }
  EXPECT_GT(runs, 5u);
  expect_same_course(parts, whole);
}

}  // namespace
}  // namespace kinesphere::response_actions_test
