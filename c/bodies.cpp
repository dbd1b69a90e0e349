// Bodies of worlds: adding, changing and removing them; filters, zones and sensors.
#include <algorithm>
#include <array>
#include <vector>

#include "exchange.hpp"
#include "input/input_check.hpp"
#include "objects.hpp"

namespace kinesphere::c {
namespace {

/// Throws the error of a change of the world, if there is one. Those of World::change() begin with the name
/// of `call`.
void require_changed(std::string_view call, const Result<void>& changed) {
  if (changed) return;
  Error error = changed.error();
  constexpr std::string_view in_cpp = "change";
  if (error.message.starts_with(in_cpp)) error.message.replace(0, in_cpp.size(), call);
  throw BadResult(std::move(error));
}

/// Changes one body by a call of the world.
template <class Change>
ks_status change_body(std::string_view call, ks_world world, ks_body_id body, const Change& change) {
  return changing(call, world,
                  [&](WorldObject& object) { require_changed(call, change(object.world(), id_of(body))); });
}

StaticDefinition static_of(std::string_view call, const ks_static_definition& body) {
  refuse_zeros(call, body.filter, body.solid, 0.0, "ks_default_static_definition()");
  return {.shape = shape_of(call, body.shape),
          .filter = filter_of(body.filter),
          .solid = body.solid != 0,
          .sensor_class = sensor_class_of(call, body.sensor_class),
          .user_data = body.user_data};
}

/// Adds bodies of either kind: `convert` makes the library's definitions. `add` adds one, whose error needs
/// no number, and `add_all` several.
template <class Definition, class Convert, class Add, class AddAll>
ks_status add_bodies(std::string_view call, ks_world world, const Definition* bodies, std::size_t count,
                     ks_body_id* ids, const Convert& convert, const Add& add, const AddAll& add_all) {
  return changing(call, world, [&](WorldObject& object) {
    require_records(call, bodies, count, "bodies");
    require_array(call, ids, count, "ids");
    std::vector<decltype(convert(call, *bodies))> definitions;
    definitions.reserve(count);
    for (std::size_t k = 0; k < count; ++k) definitions.push_back(convert(call, bodies[k]));
    if (count == 1) {
      *ids = c_id(add(object, definitions.front()).value());
      return;
    }
    for (const BodyId id : add_all(object, definitions).value()) *ids++ = c_id(id);
  });
}

/// Calls change(motion, number, time) for the motion of a body, if it has one: after the world has accepted
/// the change. A game has changed its own motion.
template <class Change>
void change_motion(WorldObject& object, BodyId body, const Change& change) {
  if (object.is_game()) return;
  const auto moved = object.simulation().find(body);
  if (moved) change(object.simulation().motion(moved->motion), moved->number, object.world().time()).value();
}

void turn(WorldObject& object, BodyId body, const Vec3& velocity) {
  change_motion(object, body, [&](Motion& motion, std::uint32_t number, double time) {
    return motion.set_velocity(number, time, velocity);
  });
}

/// Puts a body into a state by a call of the world, and in its motion.
template <class Change>
ks_status place(std::string_view call, ks_world world, ks_body_id body, const ks_state* state,
                const Change& change) {
  return changing(call, world, [&](WorldObject& object) {
    require_pointer(call, state, "state");
    object.change([&](auto& of) { return change(of, id_of(body), state_of(*state)); }).value();
    change_motion(object, id_of(body), [&](Motion& motion, std::uint32_t number, double time) {
      return motion.teleport(number, time, state_of(*state));
    });
  });
}

/// Removes bodies of which some have motions. The world knows all of them, and none twice.
void remove_with_motions(Simulation& simulation, std::span<const BodyId> bodies) {
  for (const BodyId body : bodies)
    (simulation.find(body) ? simulation.remove(body) : simulation.world().remove(body)).value();
}

/// Throws BadResult as World::remove() would.
void require_removable(std::string_view call, const World& world, std::span<const BodyId> bodies) {
  for (const BodyId body : bodies) (void)world.body(body).value();
  std::vector<BodyId> sorted(bodies.begin(), bodies.end());
  std::sort(sorted.begin(), sorted.end());
  if (const auto twice = std::adjacent_find(sorted.begin(), sorted.end()); twice != sorted.end()) {
    detail::bad_result({ErrorCode::stale_body, "bodies", *twice,
                        std::string(call) + ": " + text_of(*twice) + " is listed twice"});
  }
}

}  // namespace
}  // namespace kinesphere::c

using namespace kinesphere;
using namespace kinesphere::c;

ks_status ks_body_definition_init(ks_body_definition* definition, uint32_t struct_size) {
  return initialise(__func__, definition, struct_size, c_body({}));
}

ks_status ks_static_definition_init(ks_static_definition* definition, uint32_t struct_size) {
  const StaticDefinition defaults;
  return initialise(__func__, definition, struct_size,
                    ks_static_definition{.struct_size = struct_size,
                                         .solid = defaults.solid,
                                         .sensor_class = defaults.sensor_class,
                                         .shape = ks_ball({0.0, 0.0, 0.0}, Ball{}.radius),
                                         .filter = c_filter(defaults.filter),
                                         .user_data = defaults.user_data});
}

ks_status ks_world_add(ks_world world, const ks_body_definition* bodies, size_t count, ks_body_id* ids) {
  return add_bodies(
      __func__, world, bodies, count, ids, body_of,
      [](WorldObject& object, const BodyDefinition& body) {
        return object.change([&](auto& to) { return to.add(body); });
      },
      [](WorldObject& object, const std::vector<BodyDefinition>& all) {
        return object.change([&](auto& to) { return to.add_all(all); });
      });
}

ks_status ks_world_add_static(ks_world world, const ks_static_definition* bodies, size_t count,
                              ks_body_id* ids) {
  return add_bodies(
      __func__, world, bodies, count, ids, static_of,
      [](WorldObject& object, const StaticDefinition& body) { return object.world().add_static(body); },
      [](WorldObject& object, const std::vector<StaticDefinition>& all) {
        return object.world().add_static_all(all);
      });
}

ks_status ks_mesh_create(const ks_vec3* vertices, size_t vertex_count, const uint32_t* corners,
                         size_t triangle_count, ks_mesh* mesh) {
  return guarded([&, call = __func__] {
    require_pointer(call, mesh, "handle");
    require_array(call, vertices, vertex_count, "vertices");
    require_array(call, corners, triangle_count, "corners");
    std::vector<std::array<std::uint32_t, 3>> triples(triangle_count);
    for (std::size_t k = 0; k < triangle_count; ++k)
      triples[k] = {corners[3 * k], corners[3 * k + 1], corners[3 * k + 2]};
    create<MeshObject>(call, mesh, Mesh::create(vectors_of(vertices, vertex_count), triples).value());
  });
}

ks_status ks_mesh_create_chain(const ks_vec3* points, size_t count, ks_mesh* mesh) {
  return guarded([&, call = __func__] {
    require_pointer(call, mesh, "handle");
    require_array(call, points, count, "points");
    create<MeshObject>(call, mesh, Mesh::chain(vectors_of(points, count)).value());
  });
}

ks_status ks_mesh_destroy(ks_mesh mesh) { return destroy(__func__, mesh); }

ks_status ks_world_add_moving_shape(ks_world world, const ks_body_definition* body, const ks_shape* shape,
                                    ks_body_id* id) {
  return changing(__func__, world, [&, call = __func__](WorldObject& object) {
    require_record(call, body, "body");
    require_pointer(call, shape, "shape");
    require_pointer(call, id, "id");
    const MovingShape moving{body_of(call, *body), shape_of(call, *shape)};
    *id = c_id(object.change([&](auto& to) { return to.add_moving_shape(moving); }).value());
  });
}

ks_status ks_rigid_definition_init(ks_rigid_definition* definition, uint32_t struct_size) {
  const RigidBody defaults;
  return initialise(__func__, definition, struct_size,
                    ks_rigid_definition{.struct_size = struct_size,
                                        .part_count = 0,
                                        .parts = nullptr,
                                        .rotation = c_rotation(defaults.rotation),
                                        .angular_acceleration_limit = defaults.angular_acceleration_limit,
                                        .largest_angular_speed = defaults.largest_angular_speed,
                                        .inertia = c_vector(defaults.inertia),
                                        .hull_count = 0,
                                        .hulls = nullptr});
}

ks_status ks_world_add_rigid_body(ks_world world, const ks_body_definition* body,
                                  const ks_rigid_definition* rigid, ks_body_id* id) {
  return changing(__func__, world, [&, call = __func__](WorldObject& object) {
    require_record(call, body, "body");
    require_record(call, rigid, "rigid");
    require_pointer(call, id, "id");
    const RigidBody turning = rigid_of(call, *body, *rigid);
    *id = c_id(object.change([&](auto& to) { return to.add_rigid_body(turning); }).value());
  });
}

ks_status ks_world_add_zone(ks_world world, const ks_shape* shape, uint64_t user_data, ks_body_id* id) {
  return changing(__func__, world, [&, call = __func__](WorldObject& object) {
    require_pointer(call, shape, "shape");
    require_pointer(call, id, "id");
    *id = c_id(object.world().add_zone(shape_of(call, *shape), user_data).value());
  });
}

ks_status ks_world_reserve(ks_world world, size_t bodies) {
  return changing(__func__, world, [&](WorldObject& object) { object.world().reserve(bodies).value(); });
}

ks_status ks_world_remove(ks_world world, const ks_body_id* bodies, size_t count) {
  return changing(__func__, world, [&, call = __func__](WorldObject& object) {
    require_array(call, bodies, count, "bodies");
    const std::span ids = ids_of(bodies, count);
    if (object.is_game()) return object.game().remove(ids).value();
    Simulation& simulation = object.simulation();
    const bool moved =
        std::any_of(ids.begin(), ids.end(), [&](BodyId body) { return simulation.find(body).has_value(); });
    if (!moved) return simulation.world().remove(ids).value();
    require_idle(simulation.world());
    require_removable(call, simulation.world(), ids);
    remove_with_motions(simulation, ids);
  });
}

ks_status ks_world_set_velocity(ks_world world, ks_body_id body, ks_vec3 velocity) {
  return changing(__func__, world, [&](WorldObject& object) {
    object.change([&](auto& of) { return of.set_velocity(id_of(body), vector_of(velocity)); }).value();
    turn(object, id_of(body), vector_of(velocity));
  });
}

ks_status ks_world_set_velocities(ks_world world, const ks_body_id* bodies, const ks_vec3* velocities,
                                  size_t count) {
  return changing(__func__, world, [&, call = __func__](WorldObject& object) {
    require_array(call, bodies, count, "bodies");
    require_array(call, velocities, count, "velocities");
    const std::span ids = ids_of(bodies, count);
    const std::span given = vectors_of(velocities, count);
    object.change([&](auto& of) { return of.set_velocities(ids, given); }).value();
    for (std::size_t k = 0; k < count; ++k) turn(object, ids[k], given[k]);
  });
}

ks_status ks_world_set_angular_velocity(ks_world world, ks_body_id body, ks_vec3 angular_velocity) {
  return change_body(__func__, world, body, [&](World& of, BodyId id) {
    return of.change(id, {.angular_velocity = vector_of(angular_velocity)});
  });
}

ks_status ks_world_set_rotation(ks_world world, ks_body_id body, const ks_rotation* rotation) {
  return change_body(__func__, world, body, [&, call = __func__](World& of, BodyId id) {
    require_pointer(call, rotation, "rotation");
    return of.change(id, {.rotation = rotation_of(*rotation)});
  });
}

ks_status ks_world_set_rotation_probe(ks_world world, ks_rotation_probe probe, void* user) {
  return changing(__func__, world, [&](WorldObject& object) {
    RotationProbe asked;
    if (probe != nullptr) {
      asked = [probe, user](std::span<const BodyId> ids, double time, std::span<Rotation> rotations) {
        require_success("rotation probe", probe(c_ids(ids), ids.size(), time, c_rotations(rotations), user));
      };
    }
    object.world().set_rotation_probe(std::move(asked)).value();
  });
}

ks_status ks_world_teleport(ks_world world, ks_body_id body, const ks_state* state) {
  return place(__func__, world, body, state,
               [](auto& of, BodyId id, const State& to) { return of.teleport(id, to); });
}

ks_status ks_world_set_radius(ks_world world, ks_body_id body, double radius) {
  return change_body(__func__, world, body,
                     [&](World& of, BodyId id) { return of.change(id, {.radius = radius}); });
}

ks_status ks_world_set_radius_rate(ks_world world, ks_body_id body, double rate) {
  return change_body(__func__, world, body,
                     [&](World& of, BodyId id) { return of.change(id, {.radius_rate = rate}); });
}

ks_status ks_world_set_mass(ks_world world, ks_body_id body, double mass) {
  return change_body(__func__, world, body,
                     [&](World& of, BodyId id) { return of.change(id, {.mass = mass}); });
}

ks_status ks_world_set_motion_limits(ks_world world, ks_body_id body, const ks_motion_limits* limits) {
  return changing(__func__, world, [&, call = __func__](WorldObject& object) {
    require_pointer(call, limits, "limits");
    (void)object.simulation();
    MotionLimits promised;
    fields::each_motion_limits_field(convert_fields, *limits, promised);
    require_changed(call, object.world().change(id_of(body), {.motion_limits = promised}));
  });
}

ks_status ks_world_set_shape(ks_world world, ks_body_id body, const ks_shape* shape) {
  return change_body(__func__, world, body, [&, call = __func__](World& of, BodyId id) {
    require_pointer(call, shape, "shape");
    return of.set_shape(id, shape_of(call, *shape));
  });
}

ks_status ks_world_disable(ks_world world, ks_body_id body) {
  return changing(__func__, world, [&](WorldObject& object) {
    object.change([&](auto& of) { return of.disable(id_of(body)); }).value();
  });
}

ks_status ks_world_enable(ks_world world, ks_body_id body, const ks_state* state) {
  return place(__func__, world, body, state,
               [](auto& of, BodyId id, const State& at) { return of.enable(id, at); });
}

ks_status ks_world_sleep(ks_world world, ks_body_id body) {
  return changing(__func__, world, [&](WorldObject& object) {
    object.change([&](auto& of) { return of.sleep(id_of(body)); }).value();
  });
}

ks_status ks_world_wake(ks_world world, ks_body_id body) {
  return change_body(__func__, world, body, [](World& of, BodyId id) { return of.wake(id); });
}

ks_status ks_world_set_user_data(ks_world world, ks_body_id body, uint64_t data) {
  return change_body(__func__, world, body,
                     [&](World& of, BodyId id) { return of.change(id, {.user_data = data}); });
}

ks_status ks_world_set_filter(ks_world world, ks_body_id body, const ks_filter* filter) {
  return change_body(__func__, world, body, [&, call = __func__](World& of, BodyId id) {
    require_pointer(call, filter, "filter");
    return of.change(id, {.filter = filter_of(*filter)});
  });
}

ks_status ks_world_set_pair_filter(ks_world world, ks_pair_filter filter, void* user) {
  return changing(__func__, world, [&](WorldObject& object) {
    object.world().set_pair_filter(pair_filter_of(filter, user)).value();
  });
}

ks_status ks_world_refresh_filter(ks_world world, ks_body_id body) {
  return change_body(__func__, world, body, [](World& of, BodyId id) { return of.refresh_filter(id); });
}

ks_status ks_world_set_solid(ks_world world, ks_body_id body, int32_t solid) {
  return change_body(__func__, world, body,
                     [&](World& of, BodyId id) { return of.change(id, {.solid = solid != 0}); });
}

ks_status ks_world_set_sensor(ks_world world, int32_t sensor_class, const double* distances, size_t count,
                              uint64_t mask) {
  return changing(__func__, world, [&, call = __func__](WorldObject& object) {
    require_array(call, distances, count, "distances");
    object.world()
        .set_sensor(sensor_class_of(call, sensor_class),
                    {.distances = {distances, distances + count}, .mask = mask})
        .value();
  });
}

ks_status ks_world_set_sensor_class(ks_world world, ks_body_id body, int32_t sensor_class) {
  return change_body(__func__, world, body, [&, call = __func__](World& of, BodyId id) {
    return of.change(id, {.sensor_class = sensor_class_of(call, sensor_class)});
  });
}

ks_status ks_world_set_pair_state(ks_world world, ks_body_id first, ks_body_id second, int32_t state) {
  return changing(__func__, world, [&](WorldObject& object) {
    object.world().set_pair_state(id_of(first), id_of(second), state).value();
  });
}

ks_status ks_world_pair_state(ks_world world, ks_body_id first, ks_body_id second, int32_t* state) {
  return reading(__func__, world, [&, call = __func__](const WorldObject& object) {
    require_pointer(call, state, "state");
    *state = object.world().pair_state(id_of(first), id_of(second)).value();
  });
}

ks_status ks_world_turn_back(ks_world world, const ks_event* crossing) {
  return changing(__func__, world, [&, call = __func__](WorldObject& object) {
    require_pointer(call, crossing, "crossing");
    object.world().turn_back(event_of(call, *crossing)).value();
  });
}

ks_status ks_world_schedule(ks_world world, double time, uint64_t user_data, double period) {
  return changing(__func__, world, [&](WorldObject& object) {
    object.world().schedule({.time = time, .user_data = user_data, .period = period}).value();
  });
}

ks_status ks_world_unschedule(ks_world world, uint64_t user_data, size_t* count) {
  return changing(__func__, world, [&](WorldObject& object) {
    const std::size_t removed = object.world().unschedule(user_data).value();
    if (count != nullptr) *count = removed;
  });
}
