// GameWorld: a world that moves its own bodies, so that a game keeps nothing of them but ids.
//
//   GameWorld game = GameWorld::create({.world = {.box = room, .contact_tolerance = 1e-3},
//                                       .gravity = {0, 0, -9.81},
//                                       .response = bouncing(0.8)}).value();
//   const BodyId ball = game.add({.radius = 0.2, .position = {5, 5, 5}, .velocity = {3, 0, 0}}).value();
//   ...
//   for (const Event& event : game.step(1.0 / 60).value())  // each frame
//     if (event.kind == EventKind::wall_begin) play_sound(event.approach_speed);
//   for (const Vec3& position : game.positions()) draw(position);
//
// Between events each body flies freely: its acceleration is the gravity of the game and its own
// (BodyDefinition::planned_acceleration), and is exact, so steps of any length miss nothing. A game that
// moves its bodies by an integrator of its own takes a FrameMotion (motion/frame_motion.hpp) instead.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "kinesphere/body.hpp"
#include "kinesphere/event.hpp"
#include "kinesphere/queries.hpp"
#include "kinesphere/result.hpp"
#include "kinesphere/run.hpp"
#include "kinesphere/world.hpp"

namespace kinesphere {

/// Any callable `Response(const Event&)` with the preconditions of ResponseFn, or none. The game keeps it, so
/// it owns its callable; what that refers to must outlive the game and its clones. Response::stop has no
/// effect.
using GameResponse = std::function<Response(const Event& event)>;

/// Returns the response that lets bodies bounce off each other and off walls: bounce() at each begin of a
/// contact, and nothing at other events.
GameResponse bouncing(double restitution);
/// Returns the response that lets bodies bounce and come to rest upon each other: settle() at each begin.
GameResponse settling(double restitution, double resting_speed);

/// What a GameWorld begins with.
struct GameDefinition {
  /// Space, tolerance and events, as for World::create().
  WorldDefinition world{};
  /// Acceleration of all bodies (length / time^2), beside that of each body itself.
  Vec3 gravity{};
  /// Called at each event, before the game hears of it; none leaves all bodies as they are.
  GameResponse response{};
};

/// A world, the motion of its bodies and the response to its events, as one value.
///
/// Errors. As for World, whose names and messages they have. Besides, each call that returns a Result returns
/// run_in_progress inside the game's response. A moved-from game answers with moved_from. Calls that return
/// no Result throw BadResult.
///
/// Threads: one at a time; after a step, several may make const calls. Lifetimes: references and queries are
/// valid until the game is assigned to or destroyed, spans until the next call that is not const. A game may
/// be moved at any time.
class GameWorld {
 public:
  /// Creates a game without bodies. Errors: as World::create(); not_finite or out_of_range for the gravity.
  static Result<GameWorld> create(const GameDefinition& definition);
  /// A moved-from game may only be assigned to and destroyed.
  GameWorld(GameWorld&&) noexcept;
  GameWorld& operator=(GameWorld&&) noexcept;
  ~GameWorld();

  // Bodies, at time(). Changes of the world with these names; a body goes on from there at once.

  /// Adds a body. Its acceleration is `planned_acceleration` beside the gravity of the game.
  Result<BodyId> add(const BodyDefinition& body);
  /// Adds bodies or, on an error, none: World::add_all().
  Result<std::vector<BodyId>> add_all(std::span<const BodyDefinition> bodies);
  /// Adds a body that carries a shape: World::add_moving_shape().
  Result<BodyId> add_moving_shape(const MovingShape& body);
  /// Adds a rigid body, which turns evenly between events.
  Result<BodyId> add_rigid_body(const RigidBody& body);
  /// Adds a body that never moves, or a zone. It is in world(), and not in ids().
  Result<BodyId> add_static(const StaticDefinition& body);
  Result<BodyId> add_zone(const Shape& shape, std::uint64_t user_data = 0);
  /// Removes bodies, static ones too, or, on an error, none. In ids() and the arrays beside it, the last body
  /// takes the place of the removed one; all others keep theirs. Ids of the others stay valid.
  Result<void> remove(BodyIds bodies);
  /// Puts a body into another state: World::teleport().
  Result<void> teleport(BodyId body, const State& state);
  /// Gives a body another velocity: World::set_velocity().
  Result<void> set_velocity(BodyId body, const Vec3& velocity);
  /// Gives each body the velocity at its place, or, on an error, none: World::set_velocities().
  Result<void> set_velocities(BodyIds bodies, std::span<const Vec3> velocities);
  /// Sets the velocities of all bodies, in the order of ids(), or, on an error, of none. A body that has its
  /// velocity already goes on undisturbed, asleep or awake; entries of disabled bodies have no effect.
  /// Errors: out_of_range for another number of velocities; as set_velocity(). Cost: O(n), and a search for
  /// each body whose velocity changes.
  Result<void> set_velocities(std::span<const Vec3> velocities);
  /// Sets the acceleration of a body beside the gravity of the game (length / time^2): engines, wind, or
  /// -gravity() for a body without weight. Errors: as World::change() for motion limits.
  Result<void> set_acceleration(BodyId body, const Vec3& acceleration);
  /// Sets the gravity of the game; wakes all that sleep. Errors: as create(). Cost: O(n).
  Result<void> set_gravity(const Vec3& gravity);
  /// Puts a body to sleep where it is, with velocity 0. It falls on when it wakes.
  Result<void> sleep(BodyId body);
  /// Disables a body, which keeps its place in the arrays, with velocity 0: World::disable().
  Result<void> disable(BodyId body);
  /// Enables a body again, in this state: World::enable().
  Result<void> enable(BodyId body, const State& state);

  // Time.

  /// Advances by dt > 0, answers each event by the response of the game, and returns all events of the step,
  /// in order. Errors: not_finite or out_of_range for dt; run_in_progress inside a response; those of
  /// World::run(). After an error, or an exception of the response, the game stands at its time(), and the
  /// next step goes on from there; it first answers the event that could not be answered, and returns the
  /// events of the interrupted step, too.
  Result<std::span<const Event>> step(double dt);
  /// Advances to the next event, at most to the time `until`, answers it by the response of the game, and
  /// returns it, or nothing once the game is at `until`. The game stands at the event then, and may be
  /// changed:
  ///   while (const auto event = game.advance(until).value())
  ///     if (event->kind == EventKind::contact_begin) game.remove(event->first).value();
  /// Errors: as step(); time_backwards if `until` has passed.
  Result<std::optional<Event>> advance(double until);
  /// Replaces the response. Errors: run_in_progress inside of it.
  Result<void> set_response(GameResponse response);

  // What there is. All arrays have the order of ids().

  /// Return the present time, and the gravity that acts on all bodies.
  double time() const;
  const Vec3& gravity() const;
  /// The bodies that can move, disabled ones too.
  std::span<const BodyId> ids() const;
  /// Centres and velocities at time(). On periodic axes positions lie in the box. Cost: O(1); O(n) for the
  /// first call at a time in the middle of a step.
  std::span<const Vec3> positions() const;
  std::span<const Vec3> velocities() const;
  /// Returns the place of a body in ids(), or nothing for one that is not there.
  std::optional<std::size_t> index_of(BodyId body) const;
  /// Returns position and velocity at time(). Throws BadResult for a body not in ids(): as World::body();
  /// static_body.
  State state(BodyId body) const;

  /// The spatial queries at time(), exact but for rounding.
  World::Queries queries();
  /// The world, for all other calls: sensors, filters, shapes, sleeping bodies to wake, contacts, counters.
  /// The game has to know of what moves, so moving bodies are added, moved, removed and disabled by its own
  /// calls, and their motion limits stay. A moving body that the world alone knows is an error as soon as the
  /// world asks for it: unknown_body, thrown as BadResult by step(). One that the world alone has removed
  /// stays in the arrays until remove() takes it out; all other calls return stale_body for it.
  World& world();
  const World& world() const;

  /// Serializes the game; it continues bit for bit after restore(), in any process and on any machine. The
  /// response and a pair filter are not in the bytes. Errors: as World::save().
  Result<std::vector<std::byte>> save() const;
  /// Restores a game that save() wrote. Errors: bad_snapshot for bytes that are foreign, truncated, damaged
  /// or of another format version, or that contradict themselves.
  static Result<GameWorld> restore(std::span<const std::byte> snapshot, GameResponse response = {},
                                   PairFilter pair_filter = {});
  /// Returns an independent copy that continues as this game does: the fast way to roll back or to look
  /// ahead.
  Result<GameWorld> clone() const;

 private:
  struct Game;
  explicit GameWorld(std::unique_ptr<Game> game);
  /// Returns the content; throws BadResult with moved_from if there is none.
  Game& game(std::string_view call) const;

  std::unique_ptr<Game> game_;  ///< null after a move
};

}  // namespace kinesphere
