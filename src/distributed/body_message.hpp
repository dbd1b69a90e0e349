// BodyMessage carries one body from rank to rank, with its state, contacts, certificates and motion.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "archive/fields.hpp"
#include "broadphase/certificate_queue.hpp"
#include "contact/contact_checkpoint.hpp"
#include "engine/world_state.hpp"

namespace kinesphere {

/// One serialized body. Bodies are identified by name, the index of their id.
struct BodyMessage {
  /// Pair certificate of the body. `other` is a name, PairCertificate::walls or PairCertificate::window_end.
  struct Due {
    double time;
    std::uint32_t other;

    template <class Self, class Archive>
    static void serialize(Self& self, Archive& archive) {
      auto& [when, with] = self;
      archive(when, with);
    }
  };

  std::uint32_t name = 0;
  std::int32_t owner = 0;  ///< rank that owns the body
  Body body{};
  PeriodicImage image{};
  Filter filter{};
  ContactCheckpoint contacts{};
  /// Registration in the broad phase and, if registered, the window (`tier`, `end`). `enters`: the receiver
  /// inserts it now, with a new swept sphere. `starts`: it takes part in the bulk window start that is in
  /// progress.
  bool is_registered = false;
  bool enters = false;
  bool starts = false;
  std::int32_t tier = 0;
  double end = 0.0;
  /// True if certificates that the receiver holds for the body are stale.
  bool is_void = false;
  std::vector<Due> due{};
  std::vector<Event> pending{};  ///< events of the body that have not been reported yet
  std::vector<std::byte> motion{};

  Window window() const { return {tier, end}; }

  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    auto& [named, whose, itself, at_home, meets, touches, registered, entering, starting, power, until, voids,
           pairs, news, moves] = self;
    archive(named, whose, itself, at_home, meets, touches, registered, entering, starting, power, until,
            voids, pairs, news, moves);
  }
};

}  // namespace kinesphere
