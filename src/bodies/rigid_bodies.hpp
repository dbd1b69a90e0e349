// RigidBodies stores the parts and the rotations of rigid bodies.
#pragma once

#include <utility>

#include "bodies/record_pool.hpp"
#include "bound/rigid_record.hpp"

namespace kinesphere {

class RigidBodies : public RecordPool<RigidRecord> {
 public:
  /// Makes with_parts() return true, since another process of this world has bodies that are no balls.
  void note_elsewhere() { with_parts_ = true; }
  /// Returns true if there has ever been one that is not round (Body::is_round).
  bool with_parts() const { return with_parts_; }
  /// Returns nullptr if the body is not rigid.
  const RigidRecord* find(const Body& body) const { return body.is_rigid ? &(*this)[body] : nullptr; }
  void add(Body& body, RigidRecord record) {
    body.is_rigid = true;
    body.is_round = record.is_round();
    with_parts_ = with_parts_ || !body.is_round;
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
  static void serialize(auto& self, auto& archive) {
    RecordPool::serialize(self, archive);
    archive(self.with_parts_);
  }

  /// Gives the rotations of bodies whose rotation is not known without; empty if there is none. Not archived.
  RotationProbe probe{};

 private:
  bool with_parts_ = false;
};

}  // namespace kinesphere
