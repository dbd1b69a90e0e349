// Games: worlds that move their own bodies.
#include "kinesphere/game_world.hpp"

#include "exchange.hpp"
#include "objects.hpp"

namespace kinesphere::c {
namespace {

GameResponse response_of_game(std::string_view call, const ks_game_definition& definition) {
  return response_by(call, definition.respond, definition.respond_user, definition.restitution,
                     definition.resting_speed);
}

}  // namespace
}  // namespace kinesphere::c

using namespace kinesphere;
using namespace kinesphere::c;

ks_status ks_game_definition_init(ks_game_definition* definition, uint32_t struct_size) {
  return initialise(__func__, definition, struct_size,
                    ks_game_definition{.struct_size = struct_size, .restitution = 1.0});
}

ks_status ks_game_create(const ks_world_definition* world, const ks_game_definition* definition,
                         ks_world* game) {
  return guarded([&, call = __func__] {
    require_record(call, world, "world");
    require_record(call, definition, "definition");
    create<WorldObject>(call, game,
                        GameWorld::create({.world = world_of(call, *world),
                                           .gravity = vector_of(definition->gravity),
                                           .response = response_of_game(call, *definition)})
                            .value());
  });
}

ks_status ks_game_restore(const void* bytes, size_t count, const ks_game_definition* definition,
                          ks_pair_filter filter, void* user, ks_world* game) {
  return guarded([&, call = __func__] {
    require_array(call, bytes, count, "bytes");
    require_record(call, definition, "definition");
    const std::span snapshot(static_cast<const std::byte*>(bytes), count);
    create<WorldObject>(
        call, game,
        GameWorld::restore(snapshot, response_of_game(call, *definition), pair_filter_of(filter, user))
            .value());
  });
}

ks_status ks_game_step(ks_world game, double dt, ks_event_list* happened) {
  return changing(__func__, game, [&, call = __func__](WorldObject& object) {
    require_pointer(call, happened, "happened");
    const auto events = object.game().step(dt).value();
    object.events.clear();
    for (const Event& event : events) object.events.push_back(c_event(event));
    *happened = {object.events.size(), object.events.data()};
  });
}

ks_status ks_game_bodies(ks_world game, ks_body_list* found) {
  return reading(__func__, game, [&, call = __func__](const WorldObject& object) {
    require_pointer(call, found, "found");
    const GameWorld& of = object.game();
    *found = {of.ids().size(), c_ids(of.ids()), c_vectors(of.positions()), c_vectors(of.velocities())};
  });
}

ks_status ks_game_index_of(ks_world game, ks_body_id body, size_t* index) {
  return reading(__func__, game, [&, call = __func__](const WorldObject& object) {
    require_pointer(call, index, "index");
    (void)object.game().state(id_of(body));
    *index = *object.game().index_of(id_of(body));
  });
}

ks_status ks_game_set_response(ks_world game, const ks_game_definition* definition) {
  return changing(__func__, game, [&, call = __func__](WorldObject& object) {
    require_record(call, definition, "definition");
    object.game().set_response(response_of_game(call, *definition)).value();
  });
}

ks_status ks_game_set_velocities(ks_world game, const ks_vec3* velocities, size_t count) {
  return changing(__func__, game, [&, call = __func__](WorldObject& object) {
    require_array(call, velocities, count, "velocities");
    object.game().set_velocities(vectors_of(velocities, count)).value();
  });
}

ks_status ks_game_set_acceleration(ks_world game, ks_body_id body, ks_vec3 acceleration) {
  return changing(__func__, game, [&](WorldObject& object) {
    object.game().set_acceleration(id_of(body), vector_of(acceleration)).value();
  });
}

ks_status ks_game_set_gravity(ks_world game, ks_vec3 gravity) {
  return changing(__func__, game,
                  [&](WorldObject& object) { object.game().set_gravity(vector_of(gravity)).value(); });
}

ks_status ks_game_gravity(ks_world game, ks_vec3* gravity) {
  return reading(__func__, game, [&, call = __func__](const WorldObject& object) {
    require_pointer(call, gravity, "gravity");
    *gravity = c_vector(object.game().gravity());
  });
}
