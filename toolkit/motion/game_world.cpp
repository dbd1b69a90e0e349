// GameWorld: a world that moves its own bodies.
#include "kinesphere/game_world.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "archive/archive.hpp"
#include "archive/envelope.hpp"
#include "archive/fields.hpp"
#include "input/input_check.hpp"
#include "kinesphere/limits.hpp"
#include "kinesphere/response.hpp"
#include "motion/game_bodies.hpp"
#include "number/scope_guard.hpp"

namespace kinesphere {
namespace {

/// Raise the version when the fields change.
constexpr Envelope game_envelope{{'K', 'i', 'n', 'G', 'a', 'm', '\r', '\n'},
                                 1,
                                 "game",
                                 "GameWorld::restore",
                                 "snapshot",
                                 ErrorCode::bad_snapshot};

Error moved_from(std::string_view call) {
  return {ErrorCode::moved_from, "game", no_body,
          "GameWorld::" + std::string(call) + ": the game has been moved from"};
}

Error busy(std::string_view call) {
  return {ErrorCode::run_in_progress, "game", no_body,
          "GameWorld::" + std::string(call) + ": the game must not be called inside its own response"};
}

Result<void> check_gravity(std::string_view call, const WorldDefinition& world, const Vec3& gravity) {
  return InputCheck(call)
      .within({"gravity"}, gravity, limits::largest_acceleration)
      .require(world.dimensions == 3 || gravity.z == 0.0, ErrorCode::out_of_range, {"gravity"},
               "must have z = 0 in two dimensions", gravity)
      .require(world.shear_rate == 0.0, ErrorCode::unsupported, {"shear_rate"}, "must be 0 in a game",
               world.shear_rate)
      .result();
}

bool is_begin(const Event& event) {
  return event.kind == EventKind::contact_begin || event.kind == EventKind::wall_begin;
}

}  // namespace

GameResponse bouncing(double restitution) {
  return [=](const Event& event) {
    return is_begin(event) ? response_of(event, bounce(event, restitution)) : Response{};
  };
}

GameResponse settling(double restitution, double resting_speed) {
  return [=](const Event& event) {
    return is_begin(event) ? response_of(event, settle(event, restitution, resting_speed)) : Response{};
  };
}

struct GameWorld::Game {
  World world;
  GameBodies bodies;
  GameResponse response;
  std::vector<Event> events{};  ///< of the last step()
  Response answer{};            ///< to the present event
  bool answering = false;       ///< true inside the response
  bool interrupted = false;     ///< true if the last step() has failed

  Game(World own, GameBodies moved, GameResponse respond)
      : world(std::move(own)), bodies(std::move(moved)), response(std::move(respond)) {}

  /// Adds a body by `add`, which takes `definition` with its whole acceleration.
  template <class Add>
  Result<BodyId> add(BodyDefinition definition, Add add) {
    const Vec3 own = definition.planned_acceleration;
    definition.planned_acceleration = bodies.gravity() + own;
    auto id = add(definition);
    if (id) bodies.add(*id, world.time(), {definition.position, definition.velocity}, own);
    return id;
  }

  /// Makes a change of the world, and then of the motion of the body at its place.
  template <class Change, class Follow>
  Result<void> change(BodyId body, Change change, Follow follow) {
    const auto place = bodies.find(body);
    if (!place && world.contains(body) && !world.body(body)->is_static) return GameBodies::not_moved(body);
    auto done = change();
    if (done && place) follow(*place);
    return done;
  }

  /// Returns the change of the world that gives a body this whole acceleration. Errors: as World::body().
  Result<BodyChange> acceleration_of(BodyId body, const Vec3& acceleration) const {
    const auto view = world.body(body);
    if (!view) return view.error();
    MotionLimits limits = motion_limits_of(view->definition);
    limits.planned_acceleration = acceleration;
    return BodyChange{.motion_limits = limits};
  }

  Result<void> advance(std::string_view call, double until, const EventFn& sink) {
    if (answering) return busy(call);
    const auto respond = [&](const Event& event) {
      answering = true;
      const ScopeGuard answered([&] { answering = false; });
      answer = response ? response(event) : Response{};
      answer.stop = true;  // so that the sink may change the world
      return answer;
    };
    const auto hear = [&](const Event& event) {
      follow(event, event.first, answer.first_action);
      follow(event, event.second, answer.second_action);
      sink(event);
    };
    auto done = world.run(until, bodies, respond, hear);
    if (done) return done;
    Error error = done.error();
    constexpr std::string_view inner = "run:";
    if (error.message.starts_with(inner))
      error.message.replace(0, inner.size(), "GameWorld::" + std::string(call) + ":");
    return error;
  }

  /// Does to the motion of a body what an event and its response have done to the body.
  void follow(const Event& event, BodyId body, BodyAction action) {
    const auto place = bodies.find(body);
    if (!place) return;
    const GameMotion motion = bodies.motion(*place);
    if (!world.contains(body))
      bodies.remove(*place);
    else if (action == BodyAction::disable)
      bodies.halt(*place, event.time, GameMotion::disabled);
    else if (action == BodyAction::sleep && motion != GameMotion::disabled)
      bodies.halt(*place, event.time, GameMotion::asleep);
    else if (event.kind == EventKind::woke && motion == GameMotion::asleep)
      bodies.restart(*place, event.time, bodies.flight(*place, event.time));
  }

  /// Returns true if the world has these bodies, all that can move, and they move as it expects.
  bool is_valid() const {
    std::size_t movable = 0;
    for (const BodyId id : world.bodies()) movable += world.body(id)->is_static ? 0 : 1;
    const auto fits = [&](BodyId id) {
      const auto view = world.body(id);
      if (!view || view->is_static) return false;
      const std::size_t place = *bodies.find(id);
      const GameMotion motion = bodies.motion(place);
      return view->definition.planned_acceleration == bodies.gravity() + bodies.own_acceleration(place) &&
             view->enabled == (motion != GameMotion::disabled) &&
             (!view->sleeping || motion == GameMotion::asleep);
    };
    return movable == bodies.ids().size() && std::all_of(bodies.ids().begin(), bodies.ids().end(), fits);
  }
};

GameWorld::GameWorld(std::unique_ptr<Game> game) : game_(std::move(game)) {}
GameWorld::GameWorld(GameWorld&&) noexcept = default;
GameWorld& GameWorld::operator=(GameWorld&&) noexcept = default;
GameWorld::~GameWorld() = default;

GameWorld::Game& GameWorld::game(std::string_view call) const {
  if (!game_) [[unlikely]]
    detail::bad_result(moved_from(call));
  return *game_;
}

Result<GameWorld> GameWorld::create(const GameDefinition& definition) {
  auto world = World::create(definition.world);
  if (!world) return world.error();
  if (auto valid = check_gravity("GameWorld::create", definition.world, definition.gravity); !valid)
    return valid.error();
  GameBodies bodies(definition.world, definition.gravity);
  return GameWorld(std::make_unique<Game>(std::move(*world), std::move(bodies), definition.response));
}

Result<BodyId> GameWorld::add(const BodyDefinition& body) {
  if (!game_) return moved_from("add");
  return game_->add(body, [&](const BodyDefinition& whole) { return game_->world.add(whole); });
}

Result<std::vector<BodyId>> GameWorld::add_all(std::span<const BodyDefinition> bodies) {
  if (!game_) return moved_from("add_all");
  std::vector<BodyDefinition> flying(bodies.begin(), bodies.end());
  for (BodyDefinition& body : flying) body.planned_acceleration = gravity() + body.planned_acceleration;
  auto ids = game_->world.add_all(flying);
  for (std::size_t k = 0; ids && k < bodies.size(); ++k) {
    const BodyDefinition& body = bodies[k];
    game_->bodies.add((*ids)[k], time(), {body.position, body.velocity}, body.planned_acceleration);
  }
  return ids;
}

Result<BodyId> GameWorld::add_moving_shape(const MovingShape& body) {
  if (!game_) return moved_from("add_moving_shape");
  return game_->add(body.body, [&](const BodyDefinition& whole) {
    return game_->world.add_moving_shape({whole, body.shape});
  });
}

Result<BodyId> GameWorld::add_rigid_body(const RigidBody& body) {
  if (!game_) return moved_from("add_rigid_body");
  return game_->add(body.body, [&](const BodyDefinition& whole) {
    RigidBody flying = body;
    flying.body = whole;
    return game_->world.add_rigid_body(flying);
  });
}

Result<BodyId> GameWorld::add_static(const StaticDefinition& body) {
  if (!game_) return moved_from("add_static");
  return game_->world.add_static(body);
}

Result<BodyId> GameWorld::add_zone(const Shape& shape, std::uint64_t user_data) {
  if (!game_) return moved_from("add_zone");
  return game_->world.add_zone(shape, user_data);
}

Result<void> GameWorld::remove(BodyIds bodies) {
  if (!game_) return moved_from("remove");
  std::vector<BodyId> there;  // without those that the world alone has removed
  for (const BodyId body : bodies)
    if (game_->world.contains(body) || !game_->bodies.find(body)) there.push_back(body);
  auto removed = game_->world.remove(there);
  if (!removed) return removed;
  for (const BodyId body : bodies)
    if (const auto place = game_->bodies.find(body)) game_->bodies.remove(*place);
  return removed;
}

Result<void> GameWorld::teleport(BodyId body, const State& state) {
  if (!game_) return moved_from("teleport");
  return game_->change(
      body, [&] { return game_->world.teleport(body, state); },
      [&](std::size_t place) { game_->bodies.restart(place, time(), state); });
}

Result<void> GameWorld::set_velocity(BodyId body, const Vec3& velocity) {
  if (!game_) return moved_from("set_velocity");
  return game_->change(
      body, [&] { return game_->world.set_velocity(body, velocity); },
      [&](std::size_t place) { game_->bodies.set_velocity(place, time(), velocity); });
}

Result<void> GameWorld::set_velocities(BodyIds bodies, std::span<const Vec3> velocities) {
  if (!game_) return moved_from("set_velocities");
  auto done = game_->world.set_velocities(bodies, velocities);
  for (std::size_t k = 0; done && k < velocities.size(); ++k)
    if (const auto place = game_->bodies.find(bodies[k]))
      game_->bodies.set_velocity(*place, time(), velocities[k]);
  return done;
}

Result<void> GameWorld::set_velocities(std::span<const Vec3> velocities) {
  if (!game_) return moved_from("set_velocities");
  const GameBodies& bodies = game_->bodies;
  InputCheck check("GameWorld::set_velocities");
  check.require(velocities.size() == bodies.ids().size(), ErrorCode::out_of_range, {"velocities"},
                "must have one entry per body,", bodies.ids().size(), velocities.size());
  if (check.error()) return *check.error();
  const std::vector<Vec3>& before = bodies.velocities(time());
  std::vector<BodyId> turned;
  std::vector<Vec3> changed;
  for (std::size_t place = 0; place < velocities.size(); ++place) {
    if (before[place] == velocities[place] || bodies.motion(place) == GameMotion::disabled) continue;
    turned.push_back(bodies.ids()[place]);
    changed.push_back(velocities[place]);
  }
  return set_velocities(turned, changed);
}

Result<void> GameWorld::set_acceleration(BodyId body, const Vec3& acceleration) {
  if (!game_) return moved_from("set_acceleration");
  const auto whole = game_->acceleration_of(body, gravity() + acceleration);
  if (!whole) return whole.error();
  return game_->change(
      body, [&] { return game_->world.change(body, *whole); },
      [&](std::size_t place) { game_->bodies.set_acceleration(place, time(), acceleration); });
}

Result<void> GameWorld::set_gravity(const Vec3& gravity) {
  if (!game_) return moved_from("set_gravity");
  World& world = game_->world;
  GameBodies& bodies = game_->bodies;
  auto valid = check_gravity("GameWorld::set_gravity", world.definition(), gravity);
  std::vector<BodyChange> changes;
  for (std::size_t place = 0; place < bodies.ids().size() && valid; ++place) {
    const BodyId body = bodies.ids()[place];
    const auto whole = game_->acceleration_of(body, gravity + bodies.own_acceleration(place));
    if (!whole) return whole.error();
    valid = world.check_change(body, *whole);
    changes.push_back(*whole);
  }
  if (!valid) return valid;
  for (std::size_t place = 0; place < changes.size(); ++place)
    world.change(bodies.ids()[place], changes[place]).value();
  bodies.set_gravity(time(), gravity);
  return {};
}

Result<void> GameWorld::sleep(BodyId body) {
  if (!game_) return moved_from("sleep");
  return game_->change(
      body, [&] { return game_->world.sleep(body); },
      [&](std::size_t place) { game_->bodies.halt(place, time(), GameMotion::asleep); });
}

Result<void> GameWorld::disable(BodyId body) {
  if (!game_) return moved_from("disable");
  return game_->change(
      body, [&] { return game_->world.disable(body); },
      [&](std::size_t place) { game_->bodies.halt(place, time(), GameMotion::disabled); });
}

Result<void> GameWorld::enable(BodyId body, const State& state) {
  if (!game_) return moved_from("enable");
  return game_->change(
      body, [&] { return game_->world.enable(body, state); },
      [&](std::size_t place) { game_->bodies.restart(place, time(), state); });
}

Result<std::span<const Event>> GameWorld::step(double dt) {
  if (!game_) return moved_from("step");
  Game& game = *game_;
  InputCheck check("GameWorld::step");
  if (game.answering) return busy("step");
  if (check.positive({"dt"}, dt).error()) return *check.error();
  if (!std::exchange(game.interrupted, true)) game.events.clear();
  const auto done =
      game.advance("step", time() + dt, [&](const Event& event) { game.events.push_back(event); });
  if (!done) return done.error();
  game.interrupted = false;
  (void)game.bodies.positions(time());
  return std::span<const Event>(game.events);
}

Result<std::optional<Event>> GameWorld::advance(double until) {
  if (!game_) return moved_from("advance");
  std::optional<Event> next;
  const auto done = game_->advance("advance", until, [&](const Event& event) {
    next = event;
    game_->world.end_run();
  });
  if (!done) return done.error();
  if (!next) (void)game_->bodies.positions(until);
  return next;
}

Result<void> GameWorld::set_response(GameResponse response) {
  if (!game_) return moved_from("set_response");
  if (game_->answering) return busy("set_response");
  game_->response = std::move(response);
  return {};
}

double GameWorld::time() const { return game("time").world.time(); }
const Vec3& GameWorld::gravity() const { return game("gravity").bodies.gravity(); }
std::span<const BodyId> GameWorld::ids() const { return game("ids").bodies.ids(); }
std::span<const Vec3> GameWorld::positions() const { return game("positions").bodies.positions(time()); }
std::span<const Vec3> GameWorld::velocities() const { return game("velocities").bodies.velocities(time()); }
std::optional<std::size_t> GameWorld::index_of(BodyId body) const {
  return game("index_of").bodies.find(body);
}
State GameWorld::state(BodyId body) const {
  const auto place = index_of(body);
  if (place) [[likely]]
    return game_->bodies.state(*place, time());
  if (!game_->world.body(body).value().is_static) detail::bad_result(GameBodies::not_moved(body));
  detail::bad_result({ErrorCode::static_body, "body", body,
                      "GameWorld: body: " + text_of(body) + " must be one that can move"});
}

World::Queries GameWorld::queries() {
  GameBodies& bodies = game("queries").bodies;
  return game_->world.queries([&bodies](std::span<const BodyId> ids, double time, std::span<State> states) {
    bodies.states(ids, time, states);
  });
}
World& GameWorld::world() { return game("world").world; }
const World& GameWorld::world() const { return game("world").world; }

Result<std::vector<std::byte>> GameWorld::save() const {
  if (!game_) return moved_from("save");
  const auto world = game_->world.save();
  if (!world) return world.error();
  ByteWriter content;
  content(game_->bodies, *world);
  return game_envelope.seal(content.bytes());
}

Result<GameWorld> GameWorld::restore(std::span<const std::byte> snapshot, GameResponse response,
                                     PairFilter pair_filter) {
  const auto content = game_envelope.open(snapshot);
  if (!content) return content.error();
  ByteReader reader(*content);
  GameBodies bodies;
  std::vector<std::byte> bytes;
  reader(bodies, bytes);
  if (reader.failed() || reader.remaining() != 0)
    return game_envelope.refusal("must hold a game, but its content does not have the form of one");
  auto world = World::restore(bytes, std::move(pair_filter));
  if (!world) return world.error();
  const bool known =
      bodies.complete(world->definition(), world->time()) && world->definition().shear_rate == 0.0;
  (void)bodies.positions(world->time());
  auto game = std::make_unique<Game>(std::move(*world), std::move(bodies), std::move(response));
  if (!known || !game->is_valid())
    return game_envelope.refusal("must hold a game that can be, but contradicts itself in its bodies");
  return GameWorld(std::move(game));
}

Result<GameWorld> GameWorld::clone() const {
  if (!game_) return moved_from("clone");
  auto world = game_->world.clone();
  if (!world) return world.error();
  return GameWorld(std::make_unique<Game>(std::move(*world), game_->bodies, game_->response));
}

}  // namespace kinesphere
