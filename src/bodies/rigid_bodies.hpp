// RigidBodies stores the parts and the rotations of rigid bodies; Body::shape_number is an index into it.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "bodies/body_table.hpp"
#include "bound/rigid_record.hpp"

namespace kinesphere {

class RigidBodies {
 public:
  /// Returns true if there has never been a rigid body.
  bool empty() const { return records_.empty(); }
  /// Makes empty() return false, since another process of this world has bodies that are no balls.
  void note_elsewhere() {
    if (!empty()) return;
    records_.emplace_back();
    free_.push_back(0);
  }
  /// Returns true if there is a rigid body now.
  bool any() const { return records_.size() > free_.size(); }
  const RigidRecord& operator[](const Body& body) const { return records_[body.shape_number]; }
  RigidRecord& operator[](const Body& body) { return records_[body.shape_number]; }
  /// Returns nullptr if the body is not rigid.
  const RigidRecord* find(const Body& body) const {
    return body.is_rigid ? &records_[body.shape_number] : nullptr;
  }
  void add(Body& body, RigidRecord record) {
    body.is_rigid = true;
    if (free_.empty()) {
      body.shape_number = static_cast<std::uint32_t>(records_.size());
      records_.push_back(std::move(record));
    } else {
      body.shape_number = free_.back();
      free_.pop_back();
      records_[body.shape_number] = std::move(record);
    }
  }
  /// Removes the record of a body that is being removed, if it has one.
  void remove(const Body& body) {
    if (!body.is_rigid) return;
    records_[body.shape_number] = {};
    free_.push_back(body.shape_number);
  }

  // For speculative execution.
  /// Keeps the rotation of the body, if it is rigid.
  void keep(const Body& body) {
    if (body.is_rigid) records_[body.shape_number].keep();
  }
  /// Gives the body the rotation that was kept.
  void go_back(const Body& body) {
    if (body.is_rigid) records_[body.shape_number].go_back();
  }

  /// Gives the rotations of bodies whose rotation is not known without; empty if there is none.
  RotationProbe probe{};

  /// Returns true if each record belongs to one body or is free. Call after reading.
  bool is_valid(const BodyTable& bodies) const;
  static void serialize(auto& self, auto& archive) {
    auto& [probe, records, free] = self;
    archive(records, free);
  }

 private:
  std::vector<RigidRecord> records_;
  std::vector<std::uint32_t> free_;
};

}  // namespace kinesphere
