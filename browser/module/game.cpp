// Games: worlds that move their own bodies. JavaScript has a game by the address of its world.
#include <array>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "body.hpp"
#include "exchange.hpp"
#include "kinesphere/game_world.hpp"
#include "kinesphere/step_potential.hpp"
#include "numbers.hpp"
#include "rigid_bodies.hpp"

namespace kinesphere::browser {
namespace {

std::map<const World*, GameWorld>& games() {
  static auto* const all = new std::map<const World*, GameWorld>();
  return *all;
}
GameWorld& game_of(const World* world) { return games().find(world)->second; }

/// Keeps a new game, and returns its world; null for an error.
World* kept(Result<GameWorld> game) {
  if (!is_good(game)) return nullptr;
  World* const world = &game->world();
  games().emplace(world, std::move(*game));
  return world;
}

/// What answers the events of a game.
struct Answering {
  Responding responding;
  double restitution;
  double resting_speed;
  const double* rough;  ///< the numbers of bounce_roughly()
  const StepPotential* potential;

  GameResponse response() const {
    switch (responding) {
      case Responding::nothing:
      case Responding::as_in_scene:
        return {};
      case Responding::bounces:
        return
            [e = restitution, v = resting_speed](const Event& event) { return bounce_off(event, {}, e, v); };
      case Responding::asks_javascript:
        return [](const Event& event) { return ask_javascript(event); };
      case Responding::by_potential:
        return [own = *potential](const Event& event) { return own.respond(event); };
      case Responding::rough:
        return [e = restitution, numbers = std::array{rough[0], rough[1], rough[2]}](const Event& event) {
          return bounce_roughly(event, e, numbers.data());
        };
    }
    return {};
  }
};

double numbered(const Result<BodyId>& id) { return is_good(id) ? number_of(*id) : no_id; }

}  // namespace

KINESPHERE_EXPORT(game_create)
World* game_create(const double* definition, const double* gravity, Responding responding, double restitution,
                   double resting_speed, const double* rough, const StepPotential* potential) {
  const Answering answering{responding, restitution, resting_speed, rough, potential};
  return kept(GameWorld::create(
      {.world = definition_at(definition), .gravity = vector_at(gravity), .response = answering.response()}));
}
KINESPHERE_EXPORT(game_restore)
World* game_restore(const std::byte* snapshot, std::size_t size, double filter, Responding responding,
                    double restitution, double resting_speed, const double* rough,
                    const StepPotential* potential) {
  const Answering answering{responding, restitution, resting_speed, rough, potential};
  return kept(GameWorld::restore({snapshot, size}, answering.response(), pair_filter_of(filter)));
}
KINESPHERE_EXPORT(game_clone) World* game_clone(const World* world) { return kept(game_of(world).clone()); }
KINESPHERE_EXPORT(game_free) void game_free(const World* world) { games().erase(world); }
KINESPHERE_EXPORT(game_save) bool game_save(const World* world) {
  auto saved = game_of(world).save();
  if (saved) answer_bytes() = std::move(*saved);
  return is_good(saved);
}
KINESPHERE_EXPORT(game_set_response)
bool game_set_response(const World* world, Responding responding, double restitution, double resting_speed,
                       const double* rough, const StepPotential* potential) {
  const Answering answering{responding, restitution, resting_speed, rough, potential};
  return is_good(game_of(world).set_response(answering.response()));
}

KINESPHERE_EXPORT(game_add_all)
bool game_add_all(const World* world, std::size_t count, const double* bodies) {
  if (count == 1) {
    const auto id = game_of(world).add(body_at(bodies));
    if (is_good(id)) answer_ids({&*id, 1});
    return id.has_value();
  }
  std::vector<BodyDefinition> definitions;
  for (std::size_t k = 0; k < count; ++k) definitions.push_back(body_at(bodies + k * body_numbers));
  const auto ids = game_of(world).add_all(definitions);
  if (!is_good(ids)) return false;
  answer_ids(*ids);
  return true;
}
KINESPHERE_EXPORT(game_add_moving_shape)
double game_add_moving_shape(const World* world, int kind, const double* shape, const double* body) {
  const auto made = shape_at(kind, shape);
  return is_good(made) ? numbered(game_of(world).add_moving_shape({body_at(body), *made})) : no_id;
}
KINESPHERE_EXPORT(game_add_rigid_body)
double game_add_rigid_body(const World* world, const double* body, const double* rigid, std::size_t count,
                           const double* parts) {
  return numbered(game_of(world).add_rigid_body(rigid_body_at({body, rigid, count, parts})));
}
KINESPHERE_EXPORT(game_remove) bool game_remove(const World* world, double body) {
  return is_good(game_of(world).remove(body_of(body)));
}
KINESPHERE_EXPORT(game_set_velocity)
bool game_set_velocity(const World* world, double body, const double* velocity) {
  return is_good(game_of(world).set_velocity(body_of(body), vector_at(velocity)));
}
/// `bodies` is null for all bodies of the game, in its order.
KINESPHERE_EXPORT(game_set_velocity_all)
bool game_set_velocity_all(const World* world, std::size_t count, const double* bodies,
                           const double* velocities) {
  std::vector<BodyId> ids;
  std::vector<Vec3> each;
  for (std::size_t k = 0; k < count; ++k) {
    if (bodies != nullptr) ids.push_back(body_of(bodies[k]));
    each.push_back(vector_at(velocities + 3 * k));
  }
  GameWorld& game = game_of(world);
  return is_good(bodies != nullptr ? game.set_velocities(ids, each) : game.set_velocities(each));
}
KINESPHERE_EXPORT(game_set_acceleration)
bool game_set_acceleration(const World* world, double body, const double* acceleration) {
  return is_good(game_of(world).set_acceleration(body_of(body), vector_at(acceleration)));
}
KINESPHERE_EXPORT(game_set_gravity) bool game_set_gravity(const World* world, const double* gravity) {
  return is_good(game_of(world).set_gravity(vector_at(gravity)));
}
KINESPHERE_EXPORT(game_teleport) bool game_teleport(const World* world, double body, const double* state) {
  return is_good(game_of(world).teleport(body_of(body), state_at(state)));
}
KINESPHERE_EXPORT(game_disable) bool game_disable(const World* world, double body) {
  return is_good(game_of(world).disable(body_of(body)));
}
KINESPHERE_EXPORT(game_enable) bool game_enable(const World* world, double body, const double* state) {
  return is_good(game_of(world).enable(body_of(body), state_at(state)));
}
KINESPHERE_EXPORT(game_sleep) bool game_sleep(const World* world, double body) {
  return is_good(game_of(world).sleep(body_of(body)));
}

/// The events are in answer() afterwards.
KINESPHERE_EXPORT(game_step) bool game_step(const World* world, double dt) {
  const auto events = game_of(world).step(dt);
  if (!is_good(events)) return false;
  answer().resize(events->size() * event_numbers);
  double* numbers = answer().data();
  for (const Event& event : *events) put(event, std::exchange(numbers, numbers + event_numbers));
  return true;
}
/// As world_advance().
KINESPHERE_EXPORT(game_advance) int game_advance(const World* world, double until) {
  return answer_event(game_of(world).advance(until));
}

/// Answers the ids of the bodies that can move.
KINESPHERE_EXPORT(game_ids) void game_ids(const World* world) { answer_ids(game_of(world).ids()); }
/// Return three numbers for each, valid until the next call that changes the game.
KINESPHERE_EXPORT(game_positions) const double* game_positions(const World* world) {
  return reinterpret_cast<const double*>(game_of(world).positions().data());
}
KINESPHERE_EXPORT(game_velocities) const double* game_velocities(const World* world) {
  return reinterpret_cast<const double*>(game_of(world).velocities().data());
}
KINESPHERE_EXPORT(game_count) std::size_t game_count(const World* world) {
  return game_of(world).ids().size();
}
/// Returns -1 for a body that is none of these.
KINESPHERE_EXPORT(game_index_of) double game_index_of(const World* world, double body) {
  const auto place = game_of(world).index_of(body_of(body));
  return place ? static_cast<double>(*place) : -1.0;
}
/// Answers the gravity.
KINESPHERE_EXPORT(game_gravity) void game_gravity(const World* world) {
  const auto& [x, y, z] = game_of(world).gravity();
  answer() = {x, y, z};
}

}  // namespace kinesphere::browser
