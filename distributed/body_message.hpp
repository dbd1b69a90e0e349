// BodyMessage carries one body from rank to rank, with its state, contacts, certificates and motion.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "archive/fields.hpp"
#include "broadphase/certificate_queue.hpp"
#include "contact/contact_checkpoint.hpp"
#include "processor/world_state.hpp"

namespace kinesphere {

/// One serialized body. Bodies are identified by name, the index of their id.
struct BodyMessage {
  /// Pair certificate of the body. `other` is a name, PairCertificate::walls or PairCertificate::window_end.
  struct Due {
    double time;
    std::uint32_t other;
    /// Made in a batch by a cluster without the other body, from that body's state when the batch began.
    bool is_of_batch_start = false;
  };

  std::uint32_t name = 0;
  std::int32_t owner = 0;  ///< rank that owns the body
  Body body{};
  PeriodicImage image{};
  Filter filter{};
  double mass = 1.0;
  ChangingRadius radius{};
  std::optional<Shape> shape{};        ///< of a moving shape
  std::optional<RigidRecord> rigid{};  ///< of a rigid body
  ContactCheckpoint contacts{};
  /// Registration in the broad phase and, if registered, the window (`rung`, `end`). `enters`: the receiver
  /// inserts it now, with a new swept sphere. `starts`: it takes part in the bulk window start that is in
  /// progress.
  bool is_registered = false;
  bool enters = false;
  bool starts = false;
  std::int32_t rung = 0;
  double end = 0.0;
  /// True if certificates that the receiver holds for the body are stale.
  bool is_stale = false;
  std::vector<Due> due{};
  std::vector<Event> pending{};  ///< events of the body that have not been reported yet
  std::vector<std::byte> motion{};

  Window window() const { return {rung, end}; }

  static void serialize(auto& self, auto& archive) {
    auto& [name, owner, body, image, filter, mass, radius, shape, rigid, contacts, is_registered, enters,
           starts, rung, end, is_stale, due, pending, motion] = self;
    archive(name, owner, body, image, filter, mass, radius, shape, rigid, contacts, is_registered, enters,
            starts, rung, end, is_stale, due, pending, motion);
  }
};

}  // namespace kinesphere
