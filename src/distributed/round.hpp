// What ranks tell each other in a round of a part of a phase (phase_part.hpp).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "archive/archive.hpp"
#include "archive/fields.hpp"
#include "distributed/body_message.hpp"
#include "engine/speculation_log.hpp"

namespace kinesphere {

/// Bodies that a rank has in one island, so that others join them too.
struct JoinList {
  struct Member {
    std::uint32_t name;
    std::int32_t owner;
    bool is_registered;
    Box box;  ///< around its capsule, if it is registered

    template <class Self, class Archive>
    static void serialize(Self& self, Archive& archive) {
      auto& [named, whose, registered, place] = self;
      archive(named, whose, registered, place);
    }
  };
  std::vector<Member> together{};
  /// Names of those that the island takes for granted to be in none.
  std::vector<std::uint32_t> counted_on{};

  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    auto& [members, relied_upon] = self;
    archive(members, relied_upon);
  }
};

/// A kick of a body, whose number is each rank's own.
struct NamedUpdate {
  std::uint32_t name;
  SweptSphereUpdate update;

  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    auto& update = self.update;
    archive(self.name, update.time, update.window.rung, update.window.end, update.bound, update.middle);
  }
};

/// From one rank to another.
struct RoundMessage {
  std::vector<BodyMessage> bodies{};
  std::vector<JoinList> lists{};
  /// Names of bodies of the other rank of which copies are asked for.
  std::vector<std::uint32_t> wanted{};
  std::vector<NamedUpdate> updates{};

  bool is_empty() const { return bodies.empty() && lists.empty() && wanted.empty() && updates.empty(); }
  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    auto& [bodies, islands, names, kicked] = self;
    archive(bodies, islands, names, kicked);
  }
};

/// What a rank has to say to the others.
struct Round {
  struct ToRank {
    RoundMessage message{};               ///< but for parcels
    std::vector<std::uint32_t> bodies{};  ///< numbers of those that are sent as parcels
  };

  explicit Round(int ranks) : to_ranks(static_cast<std::size_t>(ranks)) {}
  ToRank& to(int rank) { return to_ranks[static_cast<std::size_t>(rank)]; }
  bool is_empty() const {
    return asks.empty() && std::all_of(to_ranks.begin(), to_ranks.end(), [](const ToRank& to) {
             return to.message.is_empty() && to.bodies.empty();
           });
  }

  std::vector<Box> asks{};  ///< to all of them: boxes in which all bodies have to be known
  std::vector<ToRank> to_ranks;
};

}  // namespace kinesphere
