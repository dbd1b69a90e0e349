// Games: a GameWorld does what a plain world and a motion of one's own do by hand, keeps its bodies without
// gaps, and continues from its bytes.
#include "kinesphere/game_world.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

#include "kinesphere/body_map.hpp"
#include "kinesphere/motion/ballistic.hpp"
#include "kinesphere/queries.hpp"
#include "kinesphere/random.hpp"
#include "kinesphere/response.hpp"
#include "support/expect_error.hpp"

namespace kinesphere::game_world_test {
namespace {

static_assert(std::is_nothrow_move_constructible_v<GameWorld> && !std::is_copy_constructible_v<GameWorld>);

constexpr Vec3 gravity{0, 0, -9.81};
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

const WorldDefinition room{
    .box = Box{{0, 0, 0}, {10, 10, 10}}, .contact_tolerance = 1e-5, .contacts = ContactEvents::impacts};

GameWorld game_in_room(const GameResponse& response = bouncing(0.8)) {
  return GameWorld::create({.world = room, .gravity = gravity, .response = response}).value();
}

/// The same bodies by hand: a plain world, a Ballistic motion and a map between them. The game's dense arrays
/// are checked against a list from which the last body fills the place of a removed one.
class ByHand {
 public:
  ByHand() : world_(World::create(room).value()), motion_(Ballistic::create({.gravity = gravity}).value()) {}

  BodyId add(const BodyDefinition& body) {
    const auto number = motion_.add(world_.time(), {body.position, body.velocity}).value();
    order_.push_back(bodies_.add(world_, motion_, number, body).value());
    return order_.back();
  }
  void remove(BodyId body) {
    bodies_.remove(world_, own(body)).value();
    *std::find(order_.begin(), order_.end(), body) = order_.back();
    order_.pop_back();
  }
  void set_velocity(BodyId body, const Vec3& velocity) {
    bodies_.set_velocity(world_, own(body), velocity).value();
  }
  void teleport(BodyId body, const State& state) { bodies_.teleport(world_, own(body), state).value(); }
  /// Steps of dt, in which bodies bounce.
  std::vector<Event> step(double dt) {
    std::vector<Event> events;
    for (const Event& event : world_.events(world_.time() + dt, bodies_.probe())) {
      events.push_back(event);
      if (event.kind != EventKind::contact_begin && event.kind != EventKind::wall_begin) continue;
      const Bounce after = bounce(event, 0.8);
      if (event.first_can_move()) set_velocity(event.first, after.first_velocity);
      if (event.second_can_move()) set_velocity(event.second, after.second_velocity);
    }
    return events;
  }

  World& world() { return world_; }
  const std::vector<BodyId>& order() const { return order_; }
  State state(BodyId body) const { return bodies_.state(own(body), world_.time()); }

 private:
  /// A world knows the ids of another one, which has had the same bodies, without its tag.
  static BodyId own(BodyId body) { return {body.index, body.generation}; }

  World world_;
  Ballistic motion_;
  BodyMap bodies_;
  std::vector<BodyId> order_;
};

/// Draws bodies and changes, and makes each in the game and by hand.
class Twins {
 public:
  explicit Twins(std::uint64_t seed) : random_(seed) {
    const StaticDefinition pillar{.shape = Box{{4, 4, 0}, {6, 6, 4}}};
    pillar_ = game_.add_static(pillar).value();
    EXPECT_EQ(by_hand_.world().add_static(pillar).value(), pillar_);
    for (int k = 0; k < 100; ++k) add();
  }

  void frame() {
    for (int change = 0; change < 4; ++change) change_one();
    if (below(4) == 0) steer_all();
    const std::vector<Event> expected = by_hand_.step(1.0 / 30);
    const auto events = game_.step(1.0 / 30).value();
    events_ += events.size();
    ASSERT_TRUE(std::ranges::equal(events, expected));
    compare();
  }

  /// Goes on from the bytes of the game.
  void restore() {
    game_ = GameWorld::restore(game_.save().value(), bouncing(0.8)).value();
    compare();
  }
  void clone() { game_ = GameWorld(game_.clone().value()); }

  std::size_t events() const { return events_; }
  const World& world() const { return game_.world(); }
  const World& world_by_hand() { return by_hand_.world(); }

 private:
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(random_.bits() % count); }
  Vec3 place() { return Vec3{5, 5, 7} + 2.9 * random_.point_in_ball(); }
  BodyId any() { return game_.ids()[below(game_.ids().size())]; }

  void add() {
    const BodyDefinition body{.radius = 0.1 + 0.2 * random_.uniform(),
                              .position = place(),
                              .velocity = 8.0 * random_.point_in_ball(),
                              .mass = 0.5 + random_.uniform()};
    EXPECT_EQ(game_.add(body).value(), by_hand_.add(body));
  }
  void change_one() {
    switch (below(8)) {
      case 0:
        return add();
      case 1: {
        if (game_.ids().size() < 60) return;
        const BodyId body = any();
        game_.remove(body).value();
        by_hand_.remove(body);
        EXPECT_FALSE(game_.index_of(body));
        return expect_error(game_.set_velocity(body, {}), ErrorCode::stale_body, "body", "set_velocity",
                            body);
      }
      case 2: {
        const BodyId body = any();
        const State state{place(), 8.0 * random_.point_in_ball()};
        game_.teleport(body, state).value();
        return by_hand_.teleport(body, state);
      }
      default: {
        const BodyId body = any();
        const Vec3 velocity = game_.state(body).velocity + random_.point_in_ball();
        game_.set_velocity(body, velocity).value();
        return by_hand_.set_velocity(body, velocity);
      }
    }
  }
  void steer_all() {
    std::vector<Vec3> velocities(game_.velocities().begin(), game_.velocities().end());
    for (std::size_t k = 0; k < velocities.size(); ++k) {
      if (below(2) == 0) continue;  // goes on as before, and the world does not hear of it
      velocities[k] += random_.point_in_ball();
      by_hand_.set_velocity(game_.ids()[k], velocities[k]);
    }
    game_.set_velocities(velocities).value();
  }
  void compare() {
    ASSERT_TRUE(std::ranges::equal(game_.ids(), by_hand_.order()));
    ASSERT_EQ(game_.positions().size(), game_.ids().size());
    ASSERT_EQ(game_.velocities().size(), game_.ids().size());
    for (std::size_t k = 0; k < game_.ids().size(); ++k) {
      const State expected = by_hand_.state(game_.ids()[k]);
      ASSERT_EQ((State{game_.positions()[k], game_.velocities()[k]}), expected);
      ASSERT_EQ(game_.state(game_.ids()[k]), expected);
      ASSERT_EQ(game_.index_of(game_.ids()[k]), k);
    }
  }

  Random random_;
  GameWorld game_ = game_in_room();
  ByHand by_hand_;
  BodyId pillar_;
  std::size_t events_ = 0;
};

class RandomGames : public testing::TestWithParam<std::uint64_t> {};

TEST_P(RandomGames, DoWhatAPlainWorldDoesByHand) {
  Twins twins(GetParam());
  for (int frame = 0; frame < 240 && !testing::Test::HasFatalFailure(); ++frame) {
    twins.frame();
    if (frame == 70) twins.restore();
    if (frame == 100) twins.clone();
  }
  EXPECT_GT(twins.events(), 500u);
  EXPECT_EQ(twins.world().counters().count(EventKind::bound_violation), 0u);
  EXPECT_EQ(twins.world().save().value(), twins.world_by_hand().save().value());
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomGames, testing::Range<std::uint64_t>(1, 7));

TEST(GameWorld, TheLastBodyTakesThePlaceOfARemovedOne) {
  GameWorld game = GameWorld::create({}).value();
  std::vector<BodyId> ids;
  for (int k = 0; k < 5; ++k) ids.push_back(game.add({.position = {3.0 * k, 0, 0}}).value());
  game.remove(ids[1]).value();
  EXPECT_TRUE(std::ranges::equal(game.ids(), std::vector{ids[0], ids[4], ids[2], ids[3]}));
  EXPECT_EQ(game.positions()[1].x, 12.0);
  EXPECT_EQ(game.index_of(ids[4]), 1u);
  game.remove({ids[0], ids[3]}).value();
  EXPECT_TRUE(std::ranges::equal(game.ids(), std::vector{ids[2], ids[4]}));
  const BodyId next = game.add({.position = {50, 0, 0}}).value();
  EXPECT_EQ(next.index, ids[3].index) << "the index of a removed body is used again";
  EXPECT_FALSE(game.index_of(ids[3]));
  EXPECT_EQ(game.index_of(next), 2u);
  EXPECT_EQ(game.state(next).position.x, 50.0);
}

TEST(GameWorld, EventsAreTheSameHoweverLongTheStepsAre) {
  std::vector<Event> events[2];
  for (const int parts : {1, 7}) {
    GameWorld game = game_in_room();
    Random random(3);
    for (int k = 0; k < 30; ++k)
      game.add({.radius = 0.3, .position = Vec3{5, 5, 5} + 4.0 * random.point_in_ball()}).value();
    for (int k = 0; k < 64 * parts; ++k)
      for (const Event& event : game.step(0.03125 / parts).value()) {
        if (event.time < 1.9) events[parts / 7].push_back(event);
      }
  }
  EXPECT_GT(events[0].size(), 50u);
  EXPECT_EQ(events[0], events[1]);
}

TEST(GameWorld, AddsAndTurnsSeveralAtOnce) {
  GameWorld game = game_in_room();
  const BodyDefinition first{.radius = 0.5, .position = {2, 5, 5}},
      second{.radius = 0.5, .position = {5, 5, 5}};
  const auto ids = game.add_all(std::vector{first, second}).value();
  EXPECT_TRUE(std::ranges::equal(game.ids(), ids));
  EXPECT_FALSE(game.add_all(std::vector{first, BodyDefinition{.radius = nan}}));
  EXPECT_EQ(game.ids().size(), 2u);
  game.set_velocities({ids[1], ids[0]}, std::vector{Vec3{1, 0, 0}, Vec3{0, 1, 0}}).value();
  EXPECT_EQ(game.velocities()[0], (Vec3{0, 1, 0}));
  expect_error(game.set_velocities({ids[0], ids[1]}, std::vector{Vec3{}, Vec3{nan, 0, 0}}),
               ErrorCode::not_finite, "velocity", "set_velocities", ids[1]);
  EXPECT_EQ(game.velocities()[1], (Vec3{1, 0, 0}));
  game.step(0.5).value();
  EXPECT_EQ(game.state(ids[1]).position, (Vec3{5.5, 5, 5} + 0.125 * gravity));
  for (const BodyId id : ids)
    EXPECT_EQ(game.world().body(id)->definition.planned_acceleration, gravity) << "what the world knows";
}

TEST(GameWorld, LookingChangesNothing) {
  GameWorld game =
      GameWorld::create({.world = {.box = Box{{0, 0, 0}, {10, 10, 10}}, .periodic = {.x = true}}}).value();
  const BodyId ball = game.add({.radius = 0.5, .position = {9.1, 5, 5}, .velocity = {4.3, 0.1, 0}}).value();
  game.world().schedule({.time = 0.37}).value();
  EXPECT_EQ(game.advance(1.0).value()->kind, EventKind::timer);
  GameWorld seen = game.clone().value();
  EXPECT_NEAR(seen.positions()[0].x, 9.1 + 4.3 * 0.37 - 10, 1e-12);
  for (GameWorld* const one : {&game, &seen}) {
    one->set_velocity(ball, {0.7, 0, 0}).value();
    one->step(1.0).value();
  }
  EXPECT_EQ(game.save().value(), seen.save().value());
}

TEST(GameWorld, SteeringLeavesThoseAloneWhoHaveTheirVelocity) {
  GameWorld game = game_in_room();
  for (const double x : {2.0, 8.0}) game.add({.radius = 0.5, .position = {x, 5, 5}}).value();
  game.sleep(game.ids()[0]).value();
  game.set_velocities(std::vector{Vec3{}, Vec3{1, 0, 0}}).value();
  EXPECT_TRUE(game.world().body(game.ids()[0])->sleeping);
  game.set_velocities(std::vector{Vec3{0, 1, 0}, Vec3{1, 0, 0}}).value();
  EXPECT_FALSE(game.world().body(game.ids()[0])->sleeping);
}

TEST(GameWorld, AdvancesToEachEvent) {
  GameWorld game = game_in_room();
  const BodyId ball = game.add({.radius = 0.5, .position = {5, 5, 0.6}, .velocity = {0, 0, -3}}).value();
  std::vector<BodyId> added;
  while (const auto next = game.advance(2.0).value()) {
    const Event& event = *next;
    EXPECT_EQ(game.time(), event.time);
    EXPECT_NEAR(game.state(event.first).velocity.z, 0.8 * event.approach_speed, 1e-9) << "after the response";
    // A change in the middle of a step begins where the body is.
    const State now = game.state(ball);
    game.set_velocity(ball, {1, 0, now.velocity.z}).value();
    EXPECT_EQ(game.state(ball), (State{now.position, {1, 0, now.velocity.z}}));
    EXPECT_EQ(game.positions()[0], game.state(ball).position);
    if (added.empty()) added.push_back(game.add({.radius = 0.1, .position = {2, 2, 9}}).value());
  }
  EXPECT_EQ(game.time(), 2.0);
  EXPECT_EQ(game.ids().size(), 2u);
  EXPECT_LT(game.state(added.at(0)).position.z, 9.0);
  EXPECT_TRUE(game.advance(7.0).value());
  EXPECT_LT(game.time(), 7.0);
  EXPECT_EQ(game.positions()[0], game.state(ball).position);
  EXPECT_TRUE(game.step(0.01));
}

TEST(GameWorld, ResponsesRemoveDisableAndPutToSleep) {
  for (const BodyAction action : {BodyAction::remove, BodyAction::disable, BodyAction::sleep}) {
    GameWorld game = game_in_room([=](const Event& event) -> Response {
      if (event.kind != EventKind::wall_begin) return {};
      return {.first_action = action};
    });
    const BodyId ball = game.add({.radius = 0.5, .position = {5, 5, 2}, .velocity = {1, 0, 0}}).value();
    const BodyId other = game.add({.radius = 0.5, .position = {2, 2, 9}}).value();
    EXPECT_EQ(game.step(0.8).value().size(), 1u) << name_of(action);
    EXPECT_LT(game.state(other).velocity.z, -7.0);
    if (action == BodyAction::remove) {
      EXPECT_TRUE(std::ranges::equal(game.ids(), std::vector{other}));
      continue;
    }
    EXPECT_NEAR(game.state(ball).position.z, 0.5, 1e-4) << name_of(action);
    EXPECT_EQ(game.state(ball).velocity, Vec3{}) << name_of(action);
    if (action == BodyAction::disable)
      game.enable(ball, {{5, 5, 3}, {}}).value();
    else
      game.world().wake(ball).value();
    game.set_velocity(ball, {0, 0, 5}).value();
    game.step(0.1).value();
    EXPECT_NEAR(game.state(ball).velocity.z, 5.0 - 0.981, 1e-9) << name_of(action);
    EXPECT_EQ(game.world().counters().count(EventKind::bound_violation), 0u) << name_of(action);
  }
}

TEST(GameWorld, SleepersStandStillUntilTheyWake) {
  GameWorld game = game_in_room();
  const BodyId sleeper = game.add({.radius = 0.5, .position = {5, 5, 3}, .velocity = {1, 0, 0}}).value();
  game.sleep(sleeper).value();
  game.step(1.0).value();
  EXPECT_EQ(game.state(sleeper), (State{{5, 5, 3}, {}}));
  // A steering of all that leaves it as it is does not wake it; it falls as soon as it is struck.
  game.set_velocities(game.velocities()).value();
  game.add({.radius = 0.5, .planned_acceleration = -gravity, .position = {1, 5, 3}, .velocity = {20, 0, 0}})
      .value();
  bool woke = false;
  for (const Event& event : game.step(0.25).value()) woke = woke || event.kind == EventKind::woke;
  EXPECT_TRUE(woke);
  EXPECT_GT(game.state(sleeper).velocity.x, 5.0);
  EXPECT_LT(game.state(sleeper).velocity.z, -0.5);
  // One that wakes without a new velocity falls, too.
  game.teleport(sleeper, {{2, 2, 8}, {}}).value();
  game.sleep(sleeper).value();
  game.step(0.1).value();
  game.world().wake(sleeper).value();
  game.step(0.1).value();
  EXPECT_NEAR(game.state(sleeper).velocity.z, -0.981, 1e-9);
  EXPECT_EQ(game.world().counters().count(EventKind::bound_violation), 0u);
}

TEST(GameWorld, GravityAndOwnAccelerationsAddUp) {
  GameWorld game = GameWorld::create({.gravity = gravity}).value();
  const BodyId stone = game.add({}).value();
  const BodyId balloon = game.add({.planned_acceleration = -gravity, .position = {9, 0, 0}}).value();
  const BodyId off = game.add({.position = {0, 9, 0}}).value();
  game.disable(off).value();
  game.step(1.0).value();
  EXPECT_NEAR(game.state(stone).position.z, -4.905, 1e-12);
  EXPECT_EQ(game.state(balloon), (State{{9, 0, 0}, {}}));
  game.set_acceleration(balloon, {1, 0, 0}).value();
  game.set_gravity({0, 0, 1}).value();
  EXPECT_EQ(game.gravity(), (Vec3{0, 0, 1}));
  game.step(2.0).value();
  EXPECT_NEAR(game.state(stone).velocity.z, -9.81 + 2.0, 1e-12);
  EXPECT_NEAR(game.state(balloon).velocity.x, 2.0, 1e-12);
  EXPECT_NEAR(game.state(balloon).velocity.z, 2.0, 1e-12);
  game.enable(off, {{0, 9, 0}, {}}).value();
  game.step(1.0).value();
  EXPECT_NEAR(game.state(off).velocity.z, 1.0, 1e-12);
  EXPECT_EQ(game.world().counters().count(EventKind::bound_violation), 0u);
}

TEST(GameWorld, PositionsLieInAPeriodicBox) {
  GameWorld game = GameWorld::create({.world = {.box = Box{{-5, -5, -5}, {5, 5, 5}},
                                                .periodic = {.x = true},
                                                .contacts = ContactEvents::impacts}})
                       .value();
  const BodyId ball = game.add({.radius = 0.5, .velocity = {3, 0, 0}}).value();
  game.add({.radius = 0.5, .position = {-2.9, 0, 0}}).value();
  std::vector<Event> events;
  for (int k = 0; k < 20; ++k) {
    const auto told = game.step(0.1).value();
    events.insert(events.end(), told.begin(), told.end());
  }
  EXPECT_NEAR(game.state(ball).position.x, -4.0, 1e-12);
  EXPECT_EQ(game.positions()[0], game.state(ball).position);
  ASSERT_EQ(events.size(), 0u);
  EXPECT_EQ(game.step(0.1).value().size(), 1u) << "beyond the border";
}

TEST(GameWorld, CarriesShapesAndRigidBodies) {
  GameWorld game =
      GameWorld::create({.world = {.contacts = ContactEvents::impacts}, .response = bouncing(1.0)}).value();
  const BodyId lift =
      game.add_moving_shape({.body = {.velocity = {0, 0, 1}}, .shape = Box{{-1, -1, -1}, {1, 1, 1}}}).value();
  const BodyId rod = game.add_rigid_body({.body = {.position = {0, 0, 9}},
                                          .parts = {{{-1, 0, 0}, {1, 0, 0}, 0.5}},
                                          .rotation = {.angular_velocity = {0, 0, 1}}})
                         .value();
  EXPECT_EQ(game.step(10.0).value().size(), 1u);
  EXPECT_NEAR(game.state(lift).velocity.z, 0.0, 1e-9);
  EXPECT_NEAR(game.state(rod).velocity.z, 1.0, 1e-9);
}

TEST(GameWorld, QueriesAreOfTheTruePlaces) {
  GameWorld game = GameWorld::create({}).value();
  const BodyId ball = game.add({.velocity = {1, 0, 0}}).value();
  game.step(7.0).value();
  const auto hits = game.queries().overlapping({7, 0, 0}, 1e-6).value();
  ASSERT_EQ(hits.size(), 1u);
  EXPECT_EQ(hits[0], (OverlapHit{ball, Certainty::certainly}));
}

TEST(GameWorld, WrongUseIsToldByName) {
  GameWorld game = game_in_room();
  const BodyId ball = game.add({.radius = 0.5, .position = {5, 5, 5}}).value();
  const BodyId gone = game.add({.radius = 0.5, .position = {2, 5, 5}}).value();
  const BodyId floor = game.add_static({.shape = HalfSpace{{0, 0, 1}, 0}}).value();
  game.remove(gone).value();
  expect_error(game.step(0.0), ErrorCode::out_of_range, "dt", "GameWorld::step");
  expect_error(game.step(-1.0), ErrorCode::out_of_range, "dt", "GameWorld::step");
  expect_error(game.step(nan), ErrorCode::not_finite, "dt", "GameWorld::step");
  expect_error(game.advance(-1.0), ErrorCode::time_backwards, "until", "GameWorld::advance");
  expect_error(game.advance(nan), ErrorCode::not_finite, "until", "GameWorld::advance");
  expect_error(game.set_velocity(gone, {}), ErrorCode::stale_body, "body", "set_velocity", gone);
  expect_error(game.set_velocity(ball, {nan, 0, 0}), ErrorCode::not_finite, "velocity", "set_velocity", ball);
  expect_error(game.set_velocity(floor, {}), ErrorCode::static_body, "body", "set_velocity", floor);
  expect_error(game.teleport(floor, {}), ErrorCode::static_body, "body", "teleport", floor);
  expect_error(game.sleep(gone), ErrorCode::stale_body, "body", "sleep", gone);
  expect_error(game.remove({gone}), ErrorCode::stale_body, "body", "remove", gone);
  expect_error(game.set_acceleration(gone, {}), ErrorCode::stale_body, "body", "body", gone);
  expect_error(game.set_acceleration(floor, {}), ErrorCode::static_body, "body", "change", floor);
  expect_error(game.set_acceleration(ball, {0, nan, 0}), ErrorCode::not_finite, "planned_acceleration",
               "change", ball);
  expect_error(game.set_gravity({0, 0, nan}), ErrorCode::not_finite, "gravity", "GameWorld::set_gravity");
  expect_error(game.set_velocities({}), ErrorCode::out_of_range, "velocities", "GameWorld::set_velocities");
  expect_error(game.set_velocities(std::vector{Vec3{0, nan, 0}}), ErrorCode::not_finite, "velocity",
               "set_velocities", ball);
  for (const auto& [body, code] : {std::pair(gone, ErrorCode::stale_body), {floor, ErrorCode::static_body}})
    try {
      (void)game.state(body);
      ADD_FAILURE();
    } catch (const BadResult& bad) {
      EXPECT_EQ(bad.error().code, code);
      EXPECT_EQ(bad.error().body, body);
    }
  expect_error(GameWorld::create({.world = {.dimensions = 2}, .gravity = gravity}), ErrorCode::out_of_range,
               "gravity", "GameWorld::create");
  EXPECT_EQ(game.state(ball), (State{{5, 5, 5}, {}}));
  EXPECT_EQ(game.time(), 0.0);
}

TEST(GameWorld, MovedFromGamesSaySo) {
  GameWorld game = game_in_room();
  const GameWorld other = std::move(game);
  const auto moved = ErrorCode::moved_from;
  expect_error(game.step(1.0), moved, "game", "GameWorld::step");
  expect_error(game.add({}), moved, "game", "GameWorld::add");
  expect_error(game.set_velocities({}), moved, "game", "GameWorld::set_velocities");
  expect_error(game.save(), moved, "game", "GameWorld::save");
  EXPECT_THROW((void)game.positions(), BadResult);
  EXPECT_EQ(other.time(), 0.0);
}

TEST(GameWorld, RefusesStepsAndChangesInsideAResponse) {
  std::optional<GameWorld> game;
  int calls = 0;
  game = game_in_room([&](const Event& event) -> Response {
    ++calls;
    const auto running = ErrorCode::run_in_progress;
    expect_error(game->step(1.0), running, "game", "GameWorld::step");
    expect_error(game->advance(1.0), running, "game", "GameWorld::advance");
    EXPECT_EQ(game->set_velocity(event.first, {}).error().code, running);
    EXPECT_EQ(game->set_velocities(std::vector{Vec3{1, 2, 3}}).error().code, running);
    EXPECT_EQ(game->set_gravity({}).error().code, running);
    EXPECT_EQ(game->set_acceleration(event.first, {}).error().code, running);
    EXPECT_EQ(game->remove(event.first).error().code, running);
    EXPECT_EQ(game->add({}).error().code, running);
    EXPECT_EQ(game->save().error().code, running);
    EXPECT_EQ(game->clone().error().code, running);
    expect_error(game->set_response({}), running, "game", "GameWorld::set_response");
    return response_of(event, bounce(event, 1.0));
  });
  game->add({.radius = 0.5, .position = {5, 5, 0.6}, .velocity = {0, 0, -3}}).value();
  while (const auto event = game->advance(1.0).value()) {
    EXPECT_TRUE(game->set_velocity(event->first, {0, 0, 1}));
    EXPECT_TRUE(game->save());
    EXPECT_TRUE(game->clone());
  }
  EXPECT_GT(calls, 2);
}

TEST(GameWorld, LosesNoEventWhereTheResponseFails) {
  GameWorld game = game_in_room();
  for (const double x : {2.0, 8.0})
    game.add({.radius = 0.5, .position = {x, 5, 0.6 + 0.01 * x}, .velocity = {0, 0, -3}}).value();
  GameWorld plain = game.clone().value();
  game.set_response([fails = 0](const Event& event) mutable {
        if (++fails == 2) throw std::runtime_error("a slip of the pen");
        Response response = bouncing(0.8)(event);
        if (fails == 4) response.first_velocity = Vec3{0, 0, nan};
        return response;
      })
      .value();
  EXPECT_THROW((void)game.step(0.25), std::runtime_error);
  const double stopped = game.time();
  EXPECT_LT(stopped, 0.25);
  const auto events = game.step(0.25 - stopped).value();
  EXPECT_TRUE(std::ranges::equal(events, plain.step(0.25).value()));
  expect_error(game.step(1.0), ErrorCode::not_finite, "first_velocity", "GameWorld::step", game.ids()[0]);
}

TEST(GameWorld, BodiesThatTheWorldAloneKnowsAreTold) {
  GameWorld game = GameWorld::create({}).value();
  const BodyId ball = game.add({.radius = 1}).value();
  const BodyId other = game.add({.radius = 1, .position = {9, 0, 0}}).value();
  game.world().remove(ball).value();
  game.step(1.0).value();
  EXPECT_EQ(game.ids().size(), 2u);
  expect_error(game.set_velocities(std::vector{Vec3{1, 0, 0}, Vec3{}}), ErrorCode::stale_body, "body",
               "set_velocities", ball);
  expect_error(game.set_gravity({}), ErrorCode::stale_body, "body", "body", ball);
  game.remove(ball).value();
  EXPECT_TRUE(std::ranges::equal(game.ids(), std::vector{other}));
  const BodyId stray =
      game.world().add({.radius = 1, .acceleration_limit = 1, .position = {20, 0, 0}}).value();
  const auto unknown = ErrorCode::unknown_body;
  expect_error(game.set_velocity(stray, {}), unknown, "body", "GameWorld", stray);
  expect_error(game.teleport(stray, {}), unknown, "body", "GameWorld", stray);
  expect_error(game.set_acceleration(stray, {}), unknown, "body", "GameWorld", stray);
  expect_error(game.sleep(stray), unknown, "body", "GameWorld", stray);
  expect_error(game.disable(stray), unknown, "body", "GameWorld", stray);
  try {
    (void)game.step(100.0);
    FAIL();
  } catch (const BadResult& bad) {
    EXPECT_EQ(bad.error().code, ErrorCode::unknown_body);
    EXPECT_EQ(bad.error().body, stray);
  }
}

TEST(GameWorld, ABodyThatAppearsInsideAnotherIsTold) {
  // At rest, and flying out of it.
  for (const double speed : {0.0, 3.0}) {
    GameWorld game = game_in_room();
    game.set_gravity({}).value();
    game.add({.radius = 1, .position = {5, 5, 5}}).value();
    EXPECT_TRUE(game.step(0.1)->empty());
    const BodyId spawned =
        game.add({.radius = 1, .position = {5.5, 5, 5}, .velocity = {speed, 0, 0}}).value();
    const auto events = game.step(0.1).value();
    ASSERT_EQ(events.size(), 1u);
    EXPECT_EQ(events[0].kind, EventKind::contact_begin);
    EXPECT_EQ(events[0].second, spawned);
    EXPECT_LT(events[0].gap, -1.0);
    EXPECT_TRUE(game.step(0.3)->empty()) << "once";
    // Two that only touch have no event.
    game.add({.radius = 1, .position = {5, 7, 5}}).value();
    EXPECT_TRUE(game.step(0.1)->empty());
  }
}

TEST(GameWorld, AMaskWithoutBit1FallsThroughAFloorOfTheDefaultCategory) {
  for (const std::uint64_t mask : {2, 3}) {
    GameWorld game = game_in_room();
    game.add_static({.shape = Box{{0, 0, 4}, {10, 10, 5}}}).value();
    const BodyId ball =
        game.add({.radius = 0.5, .position = {5, 5, 7}, .filter = {.category = 2, .mask = mask}}).value();
    game.step(1.0).value();
    EXPECT_EQ(game.state(ball).position.z < 4.5, mask == 2);
  }
}

TEST(GameWorld, RestoresWithAllThatMoves) {
  GameWorld game = game_in_room();
  Random random(8);
  std::vector<BodyId> ids;
  for (int k = 0; k < 30; ++k)
    ids.push_back(game.add({.radius = 0.2,
                            .planned_acceleration = 3.0 * random.point_in_ball(),
                            .position = Vec3{5, 5, 5} + 4.0 * random.point_in_ball(),
                            .velocity = 9.0 * random.point_in_ball()})
                      .value());
  game.step(0.7).value();
  game.remove({ids[3], ids[20]}).value();
  game.sleep(ids[4]).value();
  game.disable(ids[5]).value();
  const std::vector<std::byte> bytes = game.save().value();
  GameWorld again = GameWorld::restore(bytes, bouncing(0.8)).value();
  EXPECT_EQ(again.save().value(), bytes);
  EXPECT_TRUE(std::ranges::equal(again.ids(), game.ids()));
  EXPECT_TRUE(std::ranges::equal(again.positions(), game.positions()));
  EXPECT_TRUE(std::ranges::equal(again.velocities(), game.velocities()));
  for (GameWorld* each : {&game, &again}) {
    each->set_gravity({0, 0, -2}).value();
    each->enable(ids[5], {{5, 5, 9}, {}}).value();
  }
  for (int k = 0; k < 50; ++k)
    ASSERT_TRUE(std::ranges::equal(game.step(0.02).value(), again.step(0.02).value()));
  EXPECT_EQ(again.save().value(), game.save().value());
}

TEST(GameWorld, DamagedBytesAreRefused) {
  GameWorld game = game_in_room();
  for (int k = 0; k < 3; ++k) game.add({.radius = 0.2, .position = {1.0 + k, 5, 5}}).value();
  const std::vector<std::byte> bytes = game.save().value();
  for (std::size_t at = 0; at < bytes.size(); at += 7) {
    std::vector<std::byte> damaged = bytes;
    damaged[at] ^= std::byte{16};
    EXPECT_EQ(GameWorld::restore(damaged).error().code, ErrorCode::bad_snapshot);
    EXPECT_EQ(GameWorld::restore(std::span(bytes).first(at)).error().code, ErrorCode::bad_snapshot);
  }
  EXPECT_EQ(GameWorld::restore(game.world().save().value()).error().code, ErrorCode::bad_snapshot);
}

}  // namespace
}  // namespace kinesphere::game_world_test
