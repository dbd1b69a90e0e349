// Rigid bodies of a world: the public calls.
#include <utility>

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

Result<void> World::set_rotation_probe(RotationProbe probe) {
  auto valid = Preconditions(*this, "set_rotation_probe").idle();
  if (!valid) return valid;
  if (recorder_) {
    recorder_->note(*this, step::SetRotationProbe{static_cast<bool>(probe)});
    probe = recorder_->listen_to(std::move(probe));
  }
  changeable().changes().set_rotation_probe(std::move(probe));
  return {};
}

}  // namespace kinesphere
