// Worlds: definitions, bodies, snapshots.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "body.hpp"
#include "exchange.hpp"

namespace kinesphere::browser {
namespace {

World* handle_of(Result<World> world) { return is_good(world) ? new World(std::move(*world)) : nullptr; }

}  // namespace

WorldDefinition definition_at(const double* numbers) {
  NumberReader reader(numbers);
  WorldDefinition definition;
  fields::each_world_definition_field(reader, definition);
  if (const bool has_box = reader.flag(); has_box) {
    const Vec3 lower = reader.take<Vec3>();
    definition.box = Box{lower, reader.take<Vec3>()};
  } else {
    reader.take<State>();
  }
  if (reader.flag()) definition.wall_filter = reader.take<Filter>();
  return definition;
}

/// `numbers`: how many vertices and triangles there are, and then both.
Result<Shape> mesh_at(const double* numbers) {
  std::vector<Vec3> vertices(static_cast<std::size_t>(numbers[0]));
  std::vector<std::array<std::uint32_t, 3>> corners(static_cast<std::size_t>(numbers[1]));
  const double* next = numbers + 2;
  for (Vec3& vertex : vertices) {
    vertex = vector_at(next);
    next += 3;
  }
  constexpr double most = 0xffffffffu;
  for (auto& triple : corners)
    for (std::uint32_t& corner : triple) {
      const double given = *next++;
      // No vertex has the largest number.
      const bool is_whole = given >= 0.0 && given < most && given == std::floor(given);
      corner = static_cast<std::uint32_t>(is_whole ? given : most);
    }
  const auto mesh = Mesh::create(vertices, corners);
  return mesh ? Result<Shape>(mesh.value()) : Result<Shape>(mesh.error());
}

/// `numbers`: how many points there are, and then x and y of each.
Result<Shape> chain_at(const double* numbers) {
  std::vector<Vec3> points(static_cast<std::size_t>(numbers[0]));
  for (std::size_t k = 0; k < points.size(); ++k) points[k] = {numbers[1 + 2 * k], numbers[2 + 2 * k], 0.0};
  const auto mesh = Mesh::chain(points);
  return mesh ? Result<Shape>(mesh.value()) : Result<Shape>(mesh.error());
}

Result<Shape> shape_at(int kind, const double* numbers) {
  if (kind == 0) return Shape(Ball{vector_at(numbers), numbers[3]});
  if (kind == 1) return Shape(HalfSpace{vector_at(numbers), numbers[3]});
  if (kind == 2) return Shape(Box{vector_at(numbers), vector_at(numbers + 3)});
  if (kind == 4) return mesh_at(numbers);
  if (kind == 5) return chain_at(numbers);
  return Shape(Triangle{vector_at(numbers), vector_at(numbers + 3), vector_at(numbers + 6)});
}

BodyDefinition body_at(const double* numbers) {
  BodyDefinition body;
  fields::each_body_definition_field(NumberReader(numbers), body);
  return body;
}

KINESPHERE_EXPORT(allocate) void* allocate(std::size_t size) { return std::malloc(size); }
KINESPHERE_EXPORT(release) void release(void* memory) { std::free(memory); }

KINESPHERE_EXPORT(world_create) World* world_create(const double* definition) {
  return handle_of(World::create(definition_at(definition)));
}
/// Calls the package's pair filter of this number; one that throws lets the pair touch, and the package
/// throws what it threw when the running call ends.
KINESPHERE_IMPORT(filter) bool javascript_filter(double filter, double first, double second);
PairFilter pair_filter_of(double filter) {
  if (filter < 0.0) return {};
  return [filter](BodyId first, BodyId second) {
    return javascript_filter(filter, number_of(first), number_of(second));
  };
}
KINESPHERE_EXPORT(world_restore)
World* world_restore(const std::byte* snapshot, std::size_t size, double filter) {
  return handle_of(World::restore({snapshot, size}, pair_filter_of(filter)));
}
KINESPHERE_EXPORT(world_clone) World* world_clone(const World* world) { return handle_of(world->clone()); }
KINESPHERE_EXPORT(world_free) void world_free(World* world) { delete world; }
KINESPHERE_EXPORT(world_save) bool world_save(const World* world) {
  auto saved = world->save();
  if (saved) answer_bytes() = std::move(*saved);
  return is_good(saved);
}

KINESPHERE_EXPORT(world_definition) const WorldDefinition* world_definition(const World* world) {
  return &world->definition();
}
/// Writes the numbers that definition_at() reads.
KINESPHERE_EXPORT(definition_numbers) void definition_numbers(const WorldDefinition* written) {
  const WorldDefinition& definition = *written;
  // Each field takes at most three numbers.
  answer().assign(64, 0.0);
  NumberWriter writer(answer().data());
  fields::each_world_definition_field(writer, definition);
  writer.put(definition.box.has_value());
  writer.put(definition.box.value_or(Box{}).lower);
  writer.put(definition.box.value_or(Box{}).upper);
  writer.put(definition.wall_filter.has_value());
  writer.put(definition.wall_filter.value_or(Filter{}));
}

KINESPHERE_EXPORT(world_time) double world_time(const World* world) { return world->time(); }
KINESPHERE_EXPORT(world_size) std::size_t world_size(const World* world) { return world->size(); }
KINESPHERE_EXPORT(world_contains) bool world_contains(const World* world, double body) {
  return world->contains(body_of(body));
}

KINESPHERE_EXPORT(world_add_all)
bool world_add_all(World* world, std::size_t count, const double* bodies) {
  // The error of one body does not number it.
  if (count == 1) {
    const auto id = world->add(body_at(bodies));
    if (is_good(id)) answer_ids({&*id, 1});
    return id.has_value();
  }
  std::vector<BodyDefinition> definitions;
  for (std::size_t k = 0; k < count; ++k) definitions.push_back(body_at(bodies + k * body_numbers));
  const auto ids = world->add_all(definitions);
  if (!is_good(ids)) return false;
  answer_ids(*ids);
  return true;
}

KINESPHERE_EXPORT(world_add_static)
double world_add_static(World* world, int kind, const double* shape, const double* filter, bool solid,
                        int sensor_class, double user_data) {
  const auto made = shape_at(kind, shape);
  if (!is_good(made)) return no_id;
  const auto id = world->add_static({.shape = *made,
                                     .filter = filter_at(filter),
                                     .solid = solid,
                                     .sensor_class = static_cast<SensorClass>(sensor_class),
                                     .user_data = static_cast<std::uint64_t>(user_data)});
  return is_good(id) ? number_of(*id) : no_id;
}
KINESPHERE_EXPORT(world_add_moving_shape)
double world_add_moving_shape(World* world, int kind, const double* shape, const double* body) {
  const auto made = shape_at(kind, shape);
  if (!is_good(made)) return no_id;
  const auto id = world->add_moving_shape({body_at(body), *made});
  return is_good(id) ? number_of(*id) : no_id;
}
KINESPHERE_EXPORT(world_add_zone)
double world_add_zone(World* world, int kind, const double* shape, const double* filter, double user_data) {
  const auto made = shape_at(kind, shape);
  if (!is_good(made)) return no_id;
  const auto id = world->add_zone(*made, static_cast<std::uint64_t>(user_data));
  if (!is_good(id)) return no_id;
  const Filter given = filter_at(filter);
  return given == Filter{} || is_good(world->change(*id, {.filter = given})) ? number_of(*id) : no_id;
}

KINESPHERE_EXPORT(world_remove) bool world_remove(World* world, double body) {
  return is_good(world->remove(body_of(body)));
}
KINESPHERE_EXPORT(world_set_velocity)
bool world_set_velocity(World* world, double body, const double* velocity) {
  return is_good(world->set_velocity(body_of(body), vector_at(velocity)));
}
KINESPHERE_EXPORT(world_set_velocity_all)
bool world_set_velocity_all(World* world, std::size_t count, const double* bodies, const double* velocities) {
  std::vector<BodyId> ids;
  std::vector<Vec3> each;
  for (std::size_t k = 0; k < count; ++k) {
    ids.push_back(body_of(bodies[k]));
    each.push_back(vector_at(velocities + 3 * k));
  }
  return is_good(world->set_velocities(ids, each));
}
KINESPHERE_EXPORT(world_teleport) bool world_teleport(World* world, double body, const double* state) {
  return is_good(world->teleport(body_of(body), state_at(state)));
}
KINESPHERE_EXPORT(world_set_radius) bool world_set_radius(World* world, double body, double radius) {
  return is_good(world->change(body_of(body), {.radius = radius}));
}
KINESPHERE_EXPORT(world_set_radius_rate)
bool world_set_radius_rate(World* world, double body, double rate) {
  return is_good(world->change(body_of(body), {.radius_rate = rate}));
}
KINESPHERE_EXPORT(world_set_shape)
bool world_set_shape(World* world, double body, int kind, const double* shape) {
  const auto made = shape_at(kind, shape);
  return is_good(made) && is_good(world->set_shape(body_of(body), *made));
}
KINESPHERE_EXPORT(world_set_mass) bool world_set_mass(World* world, double body, double mass) {
  return is_good(world->change(body_of(body), {.mass = mass}));
}
KINESPHERE_EXPORT(world_set_motion_limits)
bool world_set_motion_limits(World* world, double body, const double* limits) {
  MotionLimits promised;
  fields::each_motion_limits_field(NumberReader(limits), promised);
  return is_good(world->change(body_of(body), {.motion_limits = promised}));
}
KINESPHERE_EXPORT(world_disable) bool world_disable(World* world, double body) {
  return is_good(world->disable(body_of(body)));
}
KINESPHERE_EXPORT(world_enable) bool world_enable(World* world, double body, const double* state) {
  return is_good(world->enable(body_of(body), state_at(state)));
}
KINESPHERE_EXPORT(world_sleep) bool world_sleep(World* world, double body) {
  return is_good(world->sleep(body_of(body)));
}
KINESPHERE_EXPORT(world_wake) bool world_wake(World* world, double body) {
  return is_good(world->wake(body_of(body)));
}
KINESPHERE_EXPORT(world_set_filter) bool world_set_filter(World* world, double body, const double* filter) {
  return is_good(world->change(body_of(body), {.filter = filter_at(filter)}));
}
/// As for world_restore.
KINESPHERE_EXPORT(world_set_pair_filter) bool world_set_pair_filter(World* world, double filter) {
  return is_good(world->set_pair_filter(pair_filter_of(filter)));
}
KINESPHERE_EXPORT(world_refresh_filter) bool world_refresh_filter(World* world, double body) {
  return is_good(world->refresh_filter(body_of(body)));
}
KINESPHERE_EXPORT(world_set_solid) bool world_set_solid(World* world, double body, bool solid) {
  return is_good(world->change(body_of(body), {.solid = solid}));
}
KINESPHERE_EXPORT(world_set_user_data) bool world_set_user_data(World* world, double body, double data) {
  return is_good(world->change(body_of(body), {.user_data = static_cast<std::uint64_t>(data)}));
}
KINESPHERE_EXPORT(world_set_sensor_class)
bool world_set_sensor_class(World* world, double body, int sensor_class) {
  return is_good(world->change(body_of(body), {.sensor_class = static_cast<SensorClass>(sensor_class)}));
}
KINESPHERE_EXPORT(world_set_pair_state)
bool world_set_pair_state(World* world, double first, double second, int state) {
  return is_good(world->set_pair_state(body_of(first), body_of(second), state));
}
KINESPHERE_EXPORT(world_pair_state) bool world_pair_state(World* world, double first, double second) {
  const auto state = world->pair_state(body_of(first), body_of(second));
  if (state) answer().assign({static_cast<double>(*state)});
  return is_good(state);
}
KINESPHERE_EXPORT(world_turn_back) bool world_turn_back(World* world, const double* event) {
  return is_good(world->turn_back(event_at(event)));
}
KINESPHERE_EXPORT(world_schedule)
bool world_schedule(World* world, double time, double user_data, double period) {
  return is_good(
      world->schedule({.time = time, .user_data = static_cast<std::uint64_t>(user_data), .period = period}));
}
KINESPHERE_EXPORT(world_unschedule) bool world_unschedule(World* world, double user_data) {
  const auto removed = world->unschedule(static_cast<std::uint64_t>(user_data));
  if (removed) answer().assign({static_cast<double>(*removed)});
  return is_good(removed);
}
KINESPHERE_EXPORT(world_set_sensor)
bool world_set_sensor(World* world, int sensor_class, std::size_t count, const double* distances,
                      double mask) {
  return is_good(world->set_sensor(static_cast<SensorClass>(sensor_class),
                                   {.distances = {distances, distances + count}, .mask = mask_of(mask)}));
}

}  // namespace kinesphere::browser
