#include "exchange.hpp"

#include <cstring>
#include <string>

#include "input/input_check.hpp"
#include "objects.hpp"

namespace kinesphere::c {
namespace {

std::uint32_t c_traits(const BodyTraits& traits) {
  return bit_of(traits.is_static, KS_TRAIT_STATIC) | bit_of(traits.is_zone, KS_TRAIT_ZONE) |
         bit_of(traits.is_sleeping, KS_TRAIT_SLEEPING);
}

BodyTraits traits_of(std::uint32_t traits) {
  return {(traits & KS_TRAIT_STATIC) != 0, (traits & KS_TRAIT_ZONE) != 0, (traits & KS_TRAIT_SLEEPING) != 0};
}

}  // namespace

void require_number(std::string_view call, std::string_view argument, std::int64_t number, std::int64_t least,
                    std::int64_t most) {
  const std::string expectation = "must be from " + std::to_string(least) + " to " + std::to_string(most);
  InputCheck(call)
      .require(least <= number && number <= most, ErrorCode::out_of_range, {argument}, expectation,
               std::to_string(number))
      .result()
      .value();
}

SensorClass sensor_class_of(std::string_view call, std::int32_t number) {
  require_number(call, "sensor_class", number, 0, zone_class);
  return static_cast<SensorClass>(number);
}

Shape shape_of(std::string_view call, const ks_shape& shape) {
  require_number(call, "shape.kind", shape.kind, KS_SHAPE_BALL, KS_SHAPE_MESH);
  const Vec3 a = vector_of(shape.points[0]), b = vector_of(shape.points[1]), c = vector_of(shape.points[2]);
  if (shape.kind == KS_SHAPE_BALL) return Ball{a, shape.number};
  if (shape.kind == KS_SHAPE_HALF_SPACE) return HalfSpace{a, shape.number};
  if (shape.kind == KS_SHAPE_BOX) return Box{a, b};
  if (shape.kind == KS_SHAPE_MESH) {
    ks_mesh mesh;
    std::memcpy(&mesh.value, &shape.number, sizeof mesh.value);
    return find(call, mesh)->mesh;
  }
  return Triangle{a, b, c};
}

void refuse_zeros(std::string_view call, const ks_filter& filter, std::int32_t solid, double mass,
                  const char* defaults) {
  if (solid != 0 || mass != 0.0 || filter_of(filter) != Filter{.category = 0, .mask = 0}) return;
  throw Failure{KS_ERROR_BAD_STRUCT, "filter",
                std::string(call) + ": a definition must begin with " + defaults +
                    ": this body would touch nothing, as its filter, solid and mass are 0"};
}

BodyDefinition body_of(std::string_view call, const ks_body_definition& body) {
  refuse_zeros(call, body.filter, body.solid, body.mass, "ks_default_body_definition()");
  require_number(call, "contacts", body.contacts, KS_CONTACTS_OF_WORLD, KS_CONTACTS_ALL);
  BodyDefinition definition{.radius = body.radius,
                            .acceleration_limit = body.acceleration_limit,
                            .planned_acceleration = vector_of(body.planned_acceleration),
                            .position_error = body.position_error,
                            .velocity_error = body.velocity_error,
                            .position = vector_of(body.position),
                            .velocity = vector_of(body.velocity),
                            .filter = filter_of(body.filter),
                            .solid = body.solid != 0,
                            .sensor_class = sensor_class_of(call, body.sensor_class),
                            .user_data = body.user_data,
                            .mass = body.mass};
  if (body.contacts != KS_CONTACTS_OF_WORLD) definition.contacts = static_cast<ContactEvents>(body.contacts);
  return definition;
}

std::vector<RigidPart> parts_of(std::string_view call, const ks_rigid_definition& rigid) {
  require_array(call, rigid.parts, rigid.part_count, "rigid.parts");
  require_array(call, rigid.hulls, rigid.hull_count, "rigid.hulls");
  std::vector<RigidPart> parts;
  for (std::size_t k = 0; k < rigid.part_count; ++k)
    parts.push_back({vector_of(rigid.parts[k].a), vector_of(rigid.parts[k].b), rigid.parts[k].radius});
  for (std::size_t k = 0; k < rigid.hull_count; ++k) {
    const ks_rigid_hull& hull = rigid.hulls[k];
    require_pointer(call, hull.point_count > 0 ? hull.points : nullptr, "rigid.hulls.points");
    parts.push_back(hull_part(vectors_of(hull.points, hull.point_count), hull.radius));
  }
  return parts;
}

ks_body_definition c_body(const BodyDefinition& body) {
  return {.struct_size = sizeof(ks_body_definition),
          .solid = body.solid,
          .contacts = body.contacts ? static_cast<ks_contacts>(*body.contacts) : KS_CONTACTS_OF_WORLD,
          .sensor_class = body.sensor_class,
          .radius = body.radius,
          .acceleration_limit = body.acceleration_limit,
          .position_error = body.position_error,
          .velocity_error = body.velocity_error,
          .mass = body.mass,
          .planned_acceleration = c_vector(body.planned_acceleration),
          .position = c_vector(body.position),
          .velocity = c_vector(body.velocity),
          .filter = c_filter(body.filter),
          .user_data = body.user_data};
}

ErrorBound bound_of(std::string_view call, const ks_error_bound& bound) {
  require_number(call, "bound.kind", bound.kind, KS_BOUND_BALL, KS_BOUND_CYLINDER);
  return bound.kind == KS_BOUND_BALL ? ErrorBound(bound.horizontal)
                                     : ErrorBound::cylinder(bound.horizontal, bound.vertical);
}

ks_error_bound c_bound(const ErrorBound& bound) {
  const bool is_ball = bound == ErrorBound(bound.horizontal());
  return {is_ball ? KS_BOUND_BALL : KS_BOUND_CYLINDER, bound.horizontal(), bound.vertical()};
}

ks_event c_event(const Event& event) {
  return {.struct_size = sizeof(ks_event),
          .kind = KS_EVENT_BOUND_VIOLATION + static_cast<ks_event_kind>(event.kind),
          .time = event.time,
          .first = c_id(event.first),
          .second = c_id(event.second),
          .wall = static_cast<ks_wall>(event.wall),
          .repeated = event.repeated,
          .jammed = event.jammed,
          .already_touching = event.already_touching,
          .senses = static_cast<std::uint32_t>(event.senses),
          .first_traits = c_traits(event.first_traits),
          .second_traits = c_traits(event.second_traits),
          .reserved = 0,
          .first_state = c_state(event.first_state),
          .second_state = c_state(event.second_state),
          .point = c_vector(event.point),
          .normal = c_vector(event.normal),
          .gap = event.gap,
          .approach_speed = event.approach_speed,
          .position_excess = event.position_excess,
          .velocity_excess = event.velocity_excess,
          .distance = event.distance,
          .first_user_data = event.first_user_data,
          .second_user_data = event.second_user_data,
          .first_mass = event.first_mass,
          .second_mass = event.second_mass,
          .first_part = event.first_part,
          .second_part = event.second_part,
          .first_angular_velocity = c_vector(event.first_angular_velocity),
          .second_angular_velocity = c_vector(event.second_angular_velocity),
          .first_spin_gain = c_vector(event.first_spin_gain),
          .second_spin_gain = c_vector(event.second_spin_gain),
          .acceleration_limit = event.acceleration_limit};
}

void write_next(const std::optional<Event>& next, double time, ks_event* event) {
  ks_event told = c_event(next.value_or(Event{.time = time}));
  if (!next) told.kind = KS_EVENT_NONE;
  write_record(told, event, event->struct_size);
}

/// Leaves out what records of programs that were compiled earlier lack, which no answer needs.
Event event_of(std::string_view call, const ks_event& event) {
  require_number(call, "event.kind", event.kind, KS_EVENT_BOUND_VIOLATION, KS_EVENT_WOKE);
  require_number(call, "event.wall", event.wall, KS_WALL_NONE, KS_WALL_Z_UPPER);
  require_number(call, "event.senses", event.senses, 0, KS_SENSES_FIRST | KS_SENSES_SECOND);
  return {.kind = static_cast<EventKind>(event.kind - KS_EVENT_BOUND_VIOLATION),
          .time = event.time,
          .first = id_of(event.first),
          .second = id_of(event.second),
          .wall = static_cast<Wall>(event.wall),
          .repeated = event.repeated != 0,
          .jammed = event.jammed != 0,
          .already_touching = event.already_touching != 0,
          .senses = static_cast<Senses>(event.senses),
          .first_traits = traits_of(event.first_traits),
          .second_traits = traits_of(event.second_traits),
          .first_state = state_of(event.first_state),
          .second_state = state_of(event.second_state),
          .point = vector_of(event.point),
          .normal = vector_of(event.normal),
          .gap = event.gap,
          .approach_speed = event.approach_speed,
          .position_excess = event.position_excess,
          .velocity_excess = event.velocity_excess,
          .distance = event.distance,
          .first_user_data = event.first_user_data,
          .second_user_data = event.second_user_data,
          .first_mass = event.first_mass,
          .second_mass = event.second_mass,
          .first_part = event.first_part,
          .second_part = event.second_part,
          .first_angular_velocity = vector_of(event.first_angular_velocity),
          .second_angular_velocity = vector_of(event.second_angular_velocity),
          .first_spin_gain = vector_of(event.first_spin_gain),
          .second_spin_gain = vector_of(event.second_spin_gain)};
}

PairFilter pair_filter_of(ks_pair_filter filter, void* user) {
  if (filter == nullptr) return {};
  return [filter, user](BodyId first, BodyId second) { return filter(c_id(first), c_id(second), user) != 0; };
}

}  // namespace kinesphere::c
