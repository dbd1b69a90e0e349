#include "exchange.hpp"

#include <cstring>
#include <string>

#include "input/input_check.hpp"
#include "objects.hpp"

namespace kinesphere::c {

void require_number(std::string_view call, std::string_view argument, std::int64_t number, std::int64_t least,
                    std::int64_t most) {
  if (least <= number && number <= most) return;
  const std::string expectation = "must be from " + std::to_string(least) + " to " + std::to_string(most);
  InputCheck(call)
      .require(false, ErrorCode::out_of_range, {argument}, expectation, std::to_string(number))
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
  sensor_class_of(call, body.sensor_class);
  BodyDefinition definition;
  fields::each_body_definition_field(convert_fields, body, definition);
  return definition;
}

namespace {

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

}  // namespace

RigidBody rigid_of(std::string_view call, const ks_body_definition& body, const ks_rigid_definition& rigid) {
  return {.body = body_of(call, body),
          .parts = parts_of(call, rigid),
          .rotation = rotation_of(rigid.rotation),
          .angular_acceleration_limit = rigid.angular_acceleration_limit,
          .largest_angular_speed = rigid.largest_angular_speed,
          .inertia = vector_of(rigid.inertia)};
}

ks_body_definition c_body(const BodyDefinition& body) {
  ks_body_definition record{.struct_size = sizeof record};
  fields::each_body_definition_field(convert_fields, body, record);
  return record;
}

ErrorBound bound_of(std::string_view call, const ks_error_bound& bound) {
  require_number(call, "bound.kind", bound.kind, KS_BOUND_BALL, KS_BOUND_CYLINDER);
  return converted(bound);
}

ks_event c_event(const Event& event) {
  auto record = fields::make_event<ks_event>(event, converted);
  record.struct_size = sizeof record;
  return record;
}

void write_next(const std::optional<Event>& next, double time, ks_event* event) {
  ks_event told = c_event(next.value_or(Event{.time = time}));
  if (!next) told.kind = KS_EVENT_NONE;
  write_record(told, event, event->struct_size);
}

Event event_of(std::string_view call, const ks_event& given) {
  // Shorter in programs that were compiled earlier.
  if (given.struct_size != sizeof given)
    return event_of(call, read_record(given, {.struct_size = sizeof given}));
  require_number(call, "event.kind", given.kind, KS_EVENT_BOUND_VIOLATION, KS_EVENT_TIMER);
  require_number(call, "event.wall", given.wall, KS_WALL_NONE, KS_WALL_Z_UPPER);
  require_number(call, "event.senses", given.senses, 0, KS_SENSES_FIRST | KS_SENSES_SECOND);
  return fields::make_event<Event>(given, converted);
}

PairFilter pair_filter_of(ks_pair_filter filter, void* user) {
  if (filter == nullptr) return {};
  return [filter, user](BodyId first, BodyId second) { return filter(c_id(first), c_id(second), user) != 0; };
}

}  // namespace kinesphere::c
