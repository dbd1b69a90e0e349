// Bodies come to a rank and go from it: own ones to another owner, copies to those who may meet them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "distributed/body_message.hpp"
#include "distributed/error_consensus.hpp"
#include "distributed/pending_links.hpp"
#include "distributed/rank_state.hpp"
#include "distributed/send_buffers.hpp"
#include "engine/speculative_runner.hpp"
#include "kinesphere/motion/motion.hpp"

namespace kinesphere {

/// Packs bodies into parcels, and installs those that come.
///
/// While a part of a phase runs, islands have changed bodies that may have to run again from where the part
/// began. So a body that is sent then has to be as it was when the part began, and its hot pairs too.
/// Functions that take `islands` do that; null stands for the time between parts.
class Migration {
 public:
  Migration(Motion& motion, RankState& local) : motion_(motion), local_(local) {}

  /// The body as it is now, but for hot pairs. Throws what Motion::write_body throws, and BadResult with its
  /// errors.
  BodyMessage pack(std::uint32_t number) const;
  /// The body as it was when the part of the phase began, with events of it that waited to be told then; but
  /// for hot pairs.
  BodyMessage pack_checkpoint(std::uint32_t number, SpeculativeRunner& islands);
  /// Adds their hot pairs to the parcels of these bodies, numbers[k] to parcels[k]. Cost: O(hot
  /// pairs of the rank).
  void add_due(std::vector<BodyMessage>& messages, std::span<const std::uint32_t> numbers,
               SpeculativeRunner* islands);
  /// Adds those of the pairs that the body has a part in to its parcel.
  void add_due(BodyMessage& message, std::uint32_t number, std::span<const PairCertificate> pairs) const;

  /// The bodies are known from now on, or as the parcels have them; returns what has to be begun with, of
  /// which the pairs may be due at any time. Errors: those of Motion::read_body.
  Result<InitialWork> install(std::vector<BodyMessage>& messages, const SpeculativeRunner* islands);
  /// Collective, between parts. Sends the parcels that have been written to the outbox, and installs those
  /// that come, which are returned. Errors, the same on all ranks: what one of them has noted, also of
  /// Motion::read_body.
  Result<std::vector<BodyMessage>> exchange(Communicator& communicator, ErrorConsensus& agreement,
                                            SendBuffers& outbox);
  /// The body is not known here any more.
  void drop(std::uint32_t number);

  // A checkpoint may bring two bodies to different ranks that have a hot pair: neither of them knows both
  // until copies have come. In between the pair is loose, and goes with the own body to where copies of it
  // go. Between parts only.
  void keep_loose_pairs() { loose_.emplace(); }
  void forget_loose_pairs() { loose_.reset(); }

 private:
  BodyMessage::Due due_of(const PairCertificate& pair, std::uint32_t number) const;
  PairCertificate certificate(const BodyMessage::Due& due, std::uint32_t number, std::uint32_t other,
                              const SpeculativeRunner* islands) const;
  std::uint32_t revision_of(std::uint32_t number, const SpeculativeRunner* islands) const;
  Result<std::uint32_t> install(BodyMessage& message);
  void link(const BodyMessage& message);

  Motion& motion_;
  RankState& local_;
  PendingLinks dangling_;
  std::optional<std::unordered_map<std::uint32_t, std::vector<BodyMessage::Due>>> loose_;  ///< by number
  /// By number: of a body whose parcel gets its hot pairs, one more than the parcel's place; 0 of all others.
  std::vector<std::uint32_t> places_;
};

}  // namespace kinesphere
