#include "world/preconditions.hpp"

#include <string>

#include "bodies/shaped_body.hpp"
#include "bodies/validation.hpp"
#include "input/input_check.hpp"
#include "world/undelivered_events.hpp"

namespace kinesphere {

Error World::Preconditions::error_about(ErrorCode code, BodyId body, std::string_view what) const {
  return {code, "body", body, std::string(call_) + ": " + std::string(what)};
}

Result<void> World::Preconditions::exists() const {
  if (engine_) return {};
  return moved_from_error(call_);
}

Result<void> World::Preconditions::idle() const {
  auto valid = exists();
  return valid ? check_idle(world_.activity(), call_) : valid;
}

Result<void> World::Preconditions::may_advance() const {
  auto valid = idle();
  return valid && world_.running_ ? busy_error(CallState::running, call_) : valid;
}

Result<void> World::Preconditions::all_delivered() const {
  auto valid = idle();
  if (!valid || !world_.undelivered_ || world_.undelivered_->empty()) return valid;
  return Error{ErrorCode::run_in_progress, "world", no_body,
               std::string(call_) + ": world must have delivered all events of an interrupted run first," +
                   " in another run or by advance"};
}

Result<void> World::Preconditions::may_ask(const Probe& probe) const {
  auto valid = idle();
  if (valid && !probe) {
    return Error{ErrorCode::null_probe, "probe", no_body,
                 std::string(call_) + ": probe must be a function, but is empty"};
  }
  return valid;
}

bool World::Preconditions::is_foreign(BodyId body) const {
  return body.world != engine_->bodies().table().tag() && body.world != 0 &&
         engine_->bodies().table().tag() != 0;
}

Result<void> World::Preconditions::known(BodyId body) const {
  if (auto valid = exists(); !valid) return valid;
  if (is_known(body)) return {};
  const std::string name = text_of(body);
  if (body == no_body)
    return error_about(ErrorCode::unknown_body, body,
                       name + " stands for none, as for the second body of a wall event");
  if (is_foreign(body)) return error_about(ErrorCode::foreign_body, body, name + " is one of another world");
  const auto& table = engine_->bodies().table();
  // A free slot stores the generation of its next body, so a smaller generation is that of a removed body.
  if (body.index < table.numbers() && body.generation < table[body.index].generation)
    return error_about(ErrorCode::stale_body, body, name + " has been removed");
  return error_about(ErrorCode::unknown_body, body, name + " was never in this world");
}

Result<void> World::Preconditions::changeable(BodyId body) const {
  auto valid = idle();
  return valid ? known(body) : valid;
}

Result<void> World::Preconditions::enabled(BodyId body, bool enabled) const {
  auto valid = changeable(body);
  return valid ? is_enabled(body, enabled) : valid;
}

Result<void> World::Preconditions::moving(BodyId body) const {
  auto valid = changeable(body);
  return valid ? is_moving(body) : valid;
}

Result<void> World::Preconditions::mobile(BodyId body) const {
  auto valid = idle();
  return valid ? can_turn(body) : valid;
}

Result<void> World::Preconditions::can_turn(BodyId body) const {
  auto valid = exists();
  if (!valid || may_turn(body)) return valid;
  valid = known(body);
  if (valid) valid = is_moving(body);
  return valid ? is_enabled(body, true) : valid;
}

Result<void> World::Preconditions::can_sleep(BodyId body) const {
  auto valid = can_turn(body);
  if (valid) valid = check_no_shear(definition(), call_);
  if (!valid) return valid;
  if (engine_->bodies()[body.index].is_rigid)
    return error_about(ErrorCode::unsupported, body, "body must not be rigid, but " + text_of(body) + " is");
  if (engine_->bodies().radius_rate(body.index) != 0.0)
    return error_about(ErrorCode::unsupported, body,
                       "body must have radius_rate 0, but " + text_of(body) + " has not");
  return {};
}

Result<void> World::Preconditions::is_enabled(BodyId body, bool enabled) const {
  if (engine_->bodies().table()[body.index].enabled == enabled) return {};
  return error_about(enabled ? ErrorCode::disabled_body : ErrorCode::enabled_body, body,
                     std::string("body must be ") + (enabled ? "enabled" : "disabled") + ", but " +
                         text_of(body) + " is not");
}

Result<void> World::Preconditions::is_moving(BodyId body) const {
  if (!engine_->bodies().table()[body.index].is_static()) return {};
  return error_about(
      ErrorCode::static_body, body,
      "body must be one that can move, but " + text_of(body) + " is static; set_shape() changes it");
}

Result<void> World::Preconditions::pair(BodyId first, BodyId second) const {
  auto valid = changeable(first);
  if (valid) valid = known(second);
  if (!valid || first != second) return valid;
  return Error{ErrorCode::out_of_range, "second", second,
               std::string(call_) + ": second must be another body than first, but is " + text_of(second)};
}

Result<void> World::Preconditions::no_overlap(const CollisionShape& shape, const BodyDefinition& body,
                                              BodyId id, std::string_view argument) const {
  if (definition().allow_overlap) return {};
  const auto other = engine_->overlaps().of_body(id, shape, body);
  return other ? Result<void>(overlap_error(call_, *other, text_of(*other), argument)) : Result<void>();
}

Result<void> World::Preconditions::no_overlap(const BodyDefinition& body, BodyId id) const {
  return no_overlap({bound_now(body, engine_->time())}, body, id, "position");
}

Result<void> World::Preconditions::no_static_overlap(const StaticDefinition& added, BodyId id) const {
  const BodyDefinition body = body_of(added);
  const Bound bound = bound_now(body, engine_->time());
  return no_overlap(collision_shape_of(bound, added.shape), body, id, "shape");
}

Result<void> World::Preconditions::no_overlap(const MovingShape& added, BodyId id) const {
  const BodyDefinition body = body_of(added, definition());
  const Bound bound = bound_now(body, engine_->time());
  return no_overlap(carried_shape_of(bound, added.shape, body.radius), body, id, "shape");
}

Result<void> World::Preconditions::can_spin(BodyId body, const Vec3& angular_velocity) const {
  auto valid = can_turn(body);
  if (!valid) return valid;
  const RigidRecord* const turning = engine_->bodies().rigid.find(engine_->bodies()[body.index]);
  return check_spin(angular_velocity, turning, body, definition(), call_);
}

Result<void> World::Preconditions::new_rigid_body(const RigidBody& added, BodyId id) const {
  auto valid = check_new_rigid_body(added, definition(), call_);
  if (valid) valid = reach(body_of(added), no_body, "sensor_class");
  return valid ? room_for(added, id) : valid;
}

/// The parts are inside the walls and, if overlaps are forbidden, overlap no other body.
Result<void> World::Preconditions::room_for(const RigidBody& added, BodyId id) const {
  const BodyDefinition body = body_of(added);
  const RigidRecord record = record_of(added, engine_->time());
  const Bound bound = bound_now(body, engine_->time());
  const CollisionShape shape{bound, false, nullptr, body.radius, &record};
  if (const auto wall = engine_->overlaps().of_wall(shape, body.filter))
    return wall_error(call_, is_known(id) ? id : no_body, *wall);
  return no_overlap(shape, body, id, "position");
}

Result<void> World::Preconditions::turned(BodyId id, const Rotation& rotation) const {
  auto valid = can_spin(id, rotation.angular_velocity);
  if (valid) valid = check_rotation(rotation, id, definition(), call_);
  if (!valid) return valid;
  const Body& body = engine_->bodies()[id.index];
  const RigidRecord& record = engine_->bodies().rigid[body];
  BodyDefinition definition = engine_->bodies().definition_of(id.index);
  definition.position = body.bound.centre_at(engine_->time());
  return room_for({.body = definition, .parts = record.parts, .rotation = rotation}, id);
}

WorldDefinition World::Preconditions::domain_of(bool has_shape) const {
  WorldDefinition domain = definition();
  if (has_shape) domain.box.reset();
  return domain;
}

Result<void> World::Preconditions::moved(BodyId id, const State& state) const {
  const Body& body = engine_->bodies()[id.index];
  BodyDefinition moved = engine_->bodies().definition_of(id.index);
  if (auto valid = check_state(state, moved, id, domain_of(body.is_shaped() || body.is_rigid), call_); !valid)
    return valid;
  moved.radius = engine_->bodies().radius_at(id.index, engine_->time());
  moved.position = state.position;
  moved.velocity = state.velocity;
  if (body.is_rigid) {
    const RigidRecord& record = engine_->bodies().rigid[body];
    // How it has turned since its last report is not known, and so no overlap is certain.
    if (!record.keeps_spin() && record.origin_time != engine_->time()) return {};
    return room_for({.body = moved, .parts = record.parts, .rotation = record.at(engine_->time())}, id);
  }
  return body.carries_shape ? no_overlap(MovingShape{moved, engine_->bodies().shapes.of(body)}, id)
                            : no_overlap(moved, id);
}

Result<void> World::Preconditions::changed(BodyId id, const BodyChange& change) const {
  const bool is_of_moving = change.radius || change.radius_rate || change.motion_limits || change.mass;
  auto valid = is_of_moving ? moving(id) : changeable(id);
  if (valid && change.rotation) valid = turned(id, *change.rotation);
  if (valid && change.angular_velocity) valid = can_spin(id, *change.angular_velocity);
  if (!valid || !(is_of_moving || change.sensor_class)) return valid;
  BodyDefinition changed = engine_->bodies().definition_of(id.index);
  const Body& body = engine_->bodies()[id.index];
  if ((change.radius || change.radius_rate) && (body.is_shaped() || body.is_rigid))
    return error_about(ErrorCode::unsupported, id, "body must be a ball, but " + text_of(id) + " is not");
  if (change.radius_rate) valid = check_radius_rate(*change.radius_rate, id, call_);
  if (valid && change.radius) {
    changed.radius = *change.radius;
    valid = check_radius(changed, id, definition(), call_);
    if (valid) valid = growth(changed, id, "radius");
  }
  if (valid && change.motion_limits) {
    changed = with_motion_limits(changed, *change.motion_limits);
    valid = check_limits(changed, id, definition(), call_);
    if (valid) valid = growth(changed, id, "position_error");
  }
  if (valid && change.sensor_class) {
    changed.sensor_class = *change.sensor_class;
    valid = reach(changed, id, "sensor_class");
  }
  if (valid && change.mass)
    valid = InputCheck(call_).not_negative_or_infinite({"mass", id}, *change.mass).result();
  return valid;
}

Result<void> World::Preconditions::growth(const BodyDefinition& changed, BodyId id,
                                          std::string_view argument) const {
  if (auto valid = reach(changed, id, argument); !valid) return valid;
  const Body& body = engine_->bodies().table()[id.index];
  const Bound bound = bound_with(engine_->bodies(), id.index, changed, engine_->time());
  if (definition().allow_overlap || !body.enabled || bound.radius <= body.bound.radius) return {};
  const CollisionShape shape = collision_shape_of(engine_->bodies(), id.index, bound);
  if (const auto wall =
          body.has_shape() ? std::nullopt : engine_->overlaps().of_wall(shape, changed.filter)) {
    return Error{ErrorCode::outside_domain, std::string(argument), id,
                 std::string(call_) + ": " + std::string(argument) + " of " + text_of(id) +
                     " must keep the whole sphere in the box, but it would overlap the wall " +
                     std::string(name_of(*wall))};
  }
  return no_overlap(shape, changed, id, argument);
}

Result<void> World::Preconditions::reach(const BodyDefinition& changed, BodyId id,
                                         std::string_view argument) const {
  const double reach = engine_->bodies().sensors.reach(changed.sensor_class);
  return check_reach(reach, changed, id, argument, definition(), call_);
}

Result<void> World::Preconditions::new_body(const BodyDefinition& body, BodyId id) const {
  auto valid = check_body(body, definition(), call_);
  if (valid) valid = reach(body, no_body, "sensor_class");
  return valid ? no_overlap(body, id) : valid;
}

Result<StaticDefinition> World::Preconditions::new_static(const StaticDefinition& added, BodyId id) const {
  auto valid = check_shape(added.shape, definition(), call_);
  if (valid) valid = reach(body_of(added), no_body, "shape");
  if (!valid) return valid.error();
  StaticDefinition accepted = added;
  accepted.shape = normalized(added.shape, engine_->definition());
  if (auto space = no_static_overlap(accepted, id); !space) return space.error();
  return accepted;
}

Result<MovingShape> World::Preconditions::new_moving_shape(const MovingShape& added, BodyId id) const {
  auto accepted = accepted_moving_shape(added, definition(), call_);
  if (!accepted) return accepted;
  if (auto space = no_overlap(*accepted, id); !space) return space.error();
  return accepted;
}

Result<Shape> World::Preconditions::reshaped(BodyId id, const Shape& shape) const {
  if (auto valid = changeable(id); !valid) return valid.error();
  const Body& body = engine_->bodies().table()[id.index];
  if (!body.has_shape())
    return error_about(ErrorCode::unsupported, id,
                       "body must have a shape, but " + text_of(id) +
                           (body.is_rigid ? " is rigid" : " is a ball; set_radius() changes it"));
  if (body.carries_shape) {
    BodyDefinition carrier = engine_->bodies().definition_of(id.index);
    carrier.position = body.bound.centre_at(engine_->time());
    const auto accepted = new_moving_shape({carrier, shape}, id);
    if (!accepted) return accepted.error();
    return accepted->shape;
  }
  StaticDefinition changed = static_definition(engine_->bodies(), id);
  changed.shape = shape;
  const auto accepted = new_static(changed, id);
  if (!accepted) return accepted.error();
  return accepted->shape;
}

}  // namespace kinesphere
