// BodyRecord is all that a rank knows of one body between two slabs of time, and what it sends of it to
// others.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "archive/fields.hpp"
#include "bodies/bodies.hpp"
#include "contact/contact_graph.hpp"
#include "contact/contacts_of_body.hpp"
#include "contact/pair_notes.hpp"
#include "core/core.hpp"

namespace kinesphere {

/// One body. Others stand in its record by their names, the indices of their ids.
struct BodyRecord {
  /// Until when nothing happens between the body and another, or itself for the walls (PairTimes).
  struct PairTime {
    std::uint32_t other;
    double until;
  };

  std::uint32_t name = 0;
  std::int32_t owner = 0;  ///< rank that owns the body
  Body body{};
  PeriodicImage image{};
  Filter filter{};
  double mass = 1.0;
  ChangingRadius radius{};
  std::vector<Shape> shape{};        ///< one, of a moving shape; few bodies have one
  std::vector<RigidRecord> rigid{};  ///< one, of a rigid body
  ContactsOfBody contacts{};
  std::vector<PairNote> notes{};  ///< in ascending order of the others
  /// It has arrived, and has no part in what moves as yet. `first_radius`: of its first safe region (length);
  /// 0 if it looks how far others are.
  bool is_arriving = false;
  double first_radius = 0.0;
  core::Core::Record core{};
  // Its safe region (length).
  Vec3 region_centre{};
  double region_reach = 0.0;
  std::vector<PairTime> times{};
  std::vector<std::byte> motion{};  ///< Motion::write_body(); only where the record is sent

  // Not sent.
  std::uint32_t in_motion = 0;  ///< number in this rank's motion
  double cost = 0.0;            ///< work since space was divided last: how often something happened to it

  static void serialize(auto& self, auto& archive) {
    archive(self.name, self.owner, self.body, self.image, self.filter, self.mass, self.radius, self.shape,
            self.rigid, self.contacts, self.notes, self.is_arriving, self.first_radius, self.core,
            self.region_centre, self.region_reach, self.times, self.motion);
  }
};

/// Returns the record of a body, as far as these tell.
BodyRecord record_of(const Bodies& bodies, const ContactGraph& contacts, std::uint32_t number);
/// Adds the body of a record, without its links to others. Returns its number.
std::uint32_t install(const BodyRecord& record, Bodies& bodies, ContactGraph& contacts, double time);

}  // namespace kinesphere
