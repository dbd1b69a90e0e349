// Rigid bodies of a world: the public calls.
#include <utility>

#include "engine/shaped_body.hpp"
#include "engine/validation.hpp"
#include "world/changing.hpp"
#include "world/preconditions.hpp"

namespace kinesphere {

Result<BodyId> World::add_rigid_body(const RigidBody& body) {
  const Preconditions check(*this, "add_rigid_body");
  if (auto idle = check.idle(); !idle) return idle.error();
  if (auto valid = check.new_rigid_body(body, engine_->bodies().table().next_id()); !valid)
    return valid.error();
  return changing(step::AddRigidBody{body}).add_rigid_body(body);
}

Result<RigidBody> World::rigid_body(BodyId body) const {
  const Preconditions check(*this, "rigid_body");
  auto valid = check.known(body);
  if (valid) valid = check.is_rigid(body);
  if (!valid) return valid.error();
  const RigidRecord& record = engine_->bodies().rigid[engine_->bodies()[body.index]];
  return RigidBody{.body = engine_->bodies().definition_of(body.index),
                   .parts = record.parts,
                   .rotation = record.is_changed ? record.origin : record.rotation,
                   .angular_acceleration_limit = record.angular_acceleration_limit,
                   .largest_angular_speed = record.largest_angular_speed,
                   .inertia = record.inertia};
}

Result<void> World::set_angular_velocity(BodyId body, const Vec3& angular_velocity) {
  const Preconditions check(*this, "set_angular_velocity");
  auto valid = check.idle();
  if (valid) valid = check.can_spin(body, angular_velocity);
  if (valid)
    changing(step::SetAngularVelocity{body, angular_velocity}).set_angular_velocity(body, angular_velocity);
  return valid;
}

Result<void> World::set_rotation(BodyId body, const Rotation& rotation) {
  const Preconditions check(*this, "set_rotation");
  auto valid = check.idle();
  if (valid) valid = check.can_spin(body, rotation.angular_velocity);
  if (valid) valid = check_rotation(rotation, body, definition(), "set_rotation");
  if (valid) valid = check.turned(body, rotation);
  if (valid) changing(step::SetRotation{body, rotation}).set_rotation(body, rotation);
  return valid;
}

Result<void> World::set_rotation_probe(RotationProbe probe) {
  auto valid = Preconditions(*this, "set_rotation_probe").idle();
  if (!valid) return valid;
  if (recorder_)
    return Error{ErrorCode::unsupported, "world", no_body,
                 "set_rotation_probe: a recording contains no rotations, but the world is being recorded"};
  changeable().changes().set_rotation_probe(std::move(probe));
  return {};
}

}  // namespace kinesphere
