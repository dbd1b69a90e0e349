// Migration moves bodies between ranks: own bodies to a new owner, ghosts to ranks that hold bodies they may
// meet.
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
#include "kinesphere/motion/motion.hpp"
#include "speculation/speculative_runner.hpp"

namespace kinesphere {

/// Packs bodies into messages and installs the messages that arrive.
///
/// While a batch runs, clusters have changed bodies that may be rolled back to the start of the batch. So a
/// body sent during a batch has to be packed, with its certificates, as it was when the batch began.
/// Functions that take `runner` do that; null means that no batch is running.
class Migration {
 public:
  Migration(Motion& motion, RankState& rank_state) : motion_(motion), rank_(rank_state) {}

  /// Packs the body in its current state, without its certificates. Throws what Motion::write_body throws,
  /// and BadResult with the errors of Motion::write_body.
  BodyMessage pack(std::uint32_t number) const;
  /// Packs the body as it was when the batch began, with its events that were pending then; without its
  /// certificates.
  BodyMessage pack_checkpoint(std::uint32_t number, SpeculativeRunner& runner);
  /// Adds the certificates of bodies numbers[k] to messages[k]. Cost: O(certificates of the rank).
  void add_due(std::vector<BodyMessage>& messages, std::span<const std::uint32_t> numbers,
               SpeculativeRunner* runner);
  /// Adds to `message` the certificates that the cluster has left for later and that involve the body.
  void add_late_pairs(BodyMessage& message, std::uint32_t number, const Cluster& cluster,
                      SpeculativeRunner& runner) const;

  /// Installs the bodies: adds unknown ones and replaces the state of known ones. Returns the initial work,
  /// whose certificates may fail at any time. Errors: those of Motion::read_body.
  Result<InitialWork> install(std::vector<BodyMessage>& messages, const SpeculativeRunner* runner);
  /// Collective; with `runner` after the clusters of its batch have been committed, otherwise not during a
  /// batch. Sends the messages in the outbox and installs and returns those that arrive. Errors, equal on all
  /// ranks: those that a rank has noted, including those of Motion::read_body.
  Result<std::vector<BodyMessage>> exchange(Communicator& communicator, ErrorConsensus& consensus,
                                            SendBuffers& buffers, const SpeculativeRunner* runner = nullptr);
  /// Removes the body from this rank.
  void drop(std::uint32_t number);

  // Restore may send the two bodies of a certificate to different ranks, so that neither rank holds both
  // until ghosts have arrived. Until then the certificate is kept with the own body as a loose pair, and is
  // sent with ghosts of that body. Not during a batch.
  void keep_loose_pairs() { loose_.emplace(); }
  void forget_loose_pairs() { loose_.reset(); }

 private:
  BodyMessage::Due due_of(const PairCertificate& pair, std::uint32_t number) const;
  PairCertificate certificate(const BodyMessage::Due& due, std::uint32_t number, std::uint32_t other,
                              const SpeculativeRunner* runner) const;
  std::uint32_t revision_of(std::uint32_t number, const SpeculativeRunner* runner) const;
  void drop_stale_due(std::vector<BodyMessage>& messages, const SpeculativeRunner* runner) const;
  Result<std::uint32_t> install(BodyMessage& message);
  void link(const BodyMessage& message);

  Motion& motion_;
  RankState& rank_;
  PendingLinks pending_links_;
  std::optional<std::unordered_map<std::uint32_t, std::vector<BodyMessage::Due>>> loose_;  ///< by number
  /// By number: index of the body's message plus 1 while add_due() collects certificates; 0 otherwise.
  std::vector<std::uint32_t> positions_;
};

}  // namespace kinesphere
