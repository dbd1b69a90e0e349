// RigidBodies stores the parts and the rotations of rigid bodies.
#pragma once

#include <utility>

#include "bodies/record_pool.hpp"
#include "bound/rigid_record.hpp"

namespace kinesphere {

class RigidBodies : public RecordPool<RigidRecord> {
 public:
  /// Makes empty() return false, since another process of this world has bodies that are no balls.
  void note_elsewhere() {
    if (!empty()) return;
    Body body;
    RecordPool::add(body, {});
    RecordPool::remove(body);
  }
  /// Returns nullptr if the body is not rigid.
  const RigidRecord* find(const Body& body) const { return body.is_rigid ? &(*this)[body] : nullptr; }
  void add(Body& body, RigidRecord record) {
    body.is_rigid = true;
    RecordPool::add(body, std::move(record));
  }
  /// Removes the record of a body that is being removed, if it has one.
  void remove(const Body& body) {
    if (!body.is_rigid) return;
    (*this)[body] = {};
    RecordPool::remove(body);
  }
  bool is_valid(const BodyTable& bodies) const {
    return RecordPool::is_valid(bodies, [](const Body& body) { return body.is_rigid; });
  }

  /// Gives the rotations of bodies whose rotation is not known without; empty if there is none. Not archived.
  RotationProbe probe{};
};

}  // namespace kinesphere
