// Responses that remove bodies, disable them, put them to sleep, or stop the world so that the sink adds
// bodies: World::run is equal to a loop over advance() that does the same, with any number of threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <memory>
#include <optional>
#include <string>
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
      turn(event->first, given.first_velocity, given.first_action);
      turn(event->second, given.second_velocity, given.second_action);
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

 private:
  bool enabled(BodyId id) const { return world.contains(id) && world.body(id).value().enabled; }
  bool awake(BodyId id) const { return enabled(id) && !world.body(id).value().sleeping; }
  void act(BodyId id, BodyAction action) {
    if (action == BodyAction::remove && world.contains(id)) world.remove(id).value();
    if (action == BodyAction::disable && enabled(id)) world.disable(id).value();
    if (action == BodyAction::sleep && awake(id)) world.sleep(id).value();
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
  bool removes = true;     ///< responses remove and disable bodies
  std::uint64_t stop = 0;  ///< one event in so many stops the world; 0: none
  std::uint64_t sleep = 0;
  double end = 2.0;
};

constexpr int side = 12;
constexpr double spacing = 2.0;

/// Bodies of three sizes that bounce in a box, and vanish at some contacts.
struct Shooting : Game {
  explicit Shooting(const Kind& of) : Game(world_of(of), motion_of(of)), kind(of) {
    std::vector<double> radii;
    for (std::uint32_t number = 0; number < crowd->size(); ++number)
      radii.push_back(number % 7 == 0 ? 0.6 : number % 3 == 0 ? 0.4 : 0.2);
    const auto ids = bodies.add_all(world, *crowd, radii).value();
    if (kind.sensors) {
      for (std::size_t k = 0; k < ids.size(); k += 5) world.change(ids[k], {.sensor_class = 1}).value();
      world.set_sensor(1, {.distances = {0.2, 0.4}}).value();
    }
    if (!kind.fixed) return;
    for (int k = 0; k < 27; ++k) {
      const Vec3 place = Vec3{double(k % 3), double(k / 3 % 3), double(k / 9)} * 4.0 * spacing;
      statics.push_back(world.add_static({.shape = Ball{place + Vec3{spacing, spacing, spacing}, 0.3}}).value());
    }
    statics.push_back(world.add_zone(Box{{5, 5, 5}, {12, 12, 12}}).value());
  }

  Response respond(const Event& event) const override {
    Random random(std::bit_cast<std::uint64_t>(event.time) ^ (event.first.pack() * 31) ^
                  event.second.pack() ^ static_cast<std::uint64_t>(event.kind));
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
  for (const int threads : {1, 2, 3}) {
    SCOPED_TRACE(threads);
    Workers workers = Workers::create(threads).value();
    Shooting run(GetParam());
    for (const double part : {0.01, 0.3, 0.3, 1.0}) run.run(part * run.kind.end, &workers).value();
    expect_same_course(run, looped);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Of, ResponseActions,
    ::testing::Values(Kind{.name = "vanishing"}, Kind{.name = "impacts", .contacts = ContactEvents::impacts},
                      Kind{.name = "bullets", .faster = 40.0},
                      Kind{.name = "forces", .faster = 20.0, .sensors = true, .forces = true},
                      Kind{.name = "periodic", .faster = 5.0, .periodic = true},
                      Kind{.name = "sensors", .sensors = true},
                      Kind{.name = "fixed", .sensors = true, .fixed = true},
                      Kind{.name = "spawns", .faster = 10.0, .sensors = true, .stop = 64},
                      Kind{.name = "spawns_alone", .removes = false, .stop = 16, .end = 1.0},
                      Kind{.name = "sleeping", .sensors = true, .stop = 256, .sleep = 64}),
    [](const auto& kind) { return kind.param.name; });

}  // namespace
}  // namespace kinesphere::response_actions_test
