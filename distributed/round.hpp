// Messages that ranks exchange in a round of a batch (batch_exchange.hpp).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "archive/archive.hpp"
#include "archive/fields.hpp"
#include "distributed/body_message.hpp"
#include "processor/speculation_log.hpp"

namespace kinesphere {

/// Bodies that one rank has merged into one cluster; the receivers merge them as well.
struct JoinList {
  struct Member {
    std::uint32_t name;
    std::int32_t owner;
    bool is_registered;
    Box box;  ///< around its swept sphere; valid if it is registered
  };
  std::vector<Member> together{};
  /// Names of bodies in the cluster's read set, which the cluster assumes to belong to no cluster.
  std::vector<std::uint32_t> read_set{};
};

/// Update of a swept sphere. The body is identified by name, as its number differs between ranks.
struct NamedUpdate {
  std::uint32_t name;
  SweptSphereUpdate update;

  static void serialize(auto& self, auto& archive) {
    auto& update = self.update;
    archive(self.name, update.time, update.window.rung, update.window.end, update.bound, update.middle);
  }
};

/// Message from one rank to another in one round.
struct RoundMessage {
  std::vector<BodyMessage> bodies{};
  std::vector<JoinList> lists{};
  /// Names of bodies of the receiver of which the sender requests ghosts.
  std::vector<std::uint32_t> wanted{};
  std::vector<NamedUpdate> updates{};

  bool is_empty() const { return bodies.empty() && lists.empty() && wanted.empty() && updates.empty(); }
};

/// All messages that a rank has collected for the next round.
struct Round {
  struct ToRank {
    RoundMessage message{};               ///< without its BodyMessages
    std::vector<std::uint32_t> bodies{};  ///< numbers of own bodies to be sent as BodyMessages
  };

  explicit Round(int ranks) : to_ranks(static_cast<std::size_t>(ranks)) {}
  ToRank& to(int rank) { return to_ranks[static_cast<std::size_t>(rank)]; }
  bool is_empty() const {
    return asks.empty() && std::all_of(to_ranks.begin(), to_ranks.end(), [](const ToRank& to) {
             return to.message.is_empty() && to.bodies.empty();
           });
  }

  std::vector<Box> asks{};  ///< sent to all ranks: boxes added to this rank's halo region
  std::vector<ToRank> to_ranks;
};

}  // namespace kinesphere
