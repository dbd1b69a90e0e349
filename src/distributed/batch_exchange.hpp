// A part of a phase: each rank runs the islands that have a body of its own, and ranks tell each other what
// joins islands, until each has run its islands with all bodies that belong to them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "distributed/error_consensus.hpp"
#include "distributed/halo_region.hpp"
#include "distributed/migration.hpp"
#include "distributed/round.hpp"
#include "engine/speculative_runner.hpp"
#include "kinesphere/distributed/distributed_world.hpp"

namespace kinesphere {

/// One part, for which islands have been opened. run(), finish() and renew_copies() are called once each, in
/// this order.
class BatchExchange {
 public:
  BatchExchange(Communicator& communicator, ErrorConsensus& agreement, RankState& local, Migration& transit,
                HaloRegions& known, SpeculativeRunner& islands);

  /// Collective. Runs islands, and has rounds with the other ranks, until none has news. Errors: of the first
  /// rank in whose islands something has failed, the same on all.
  Result<void> run();
  /// What came of the islands becomes what came of everybody. Returns the events whose first body is this
  /// rank's, in their order.
  std::vector<OrderedEvent> finish();
  /// Collective. Bodies that have changed go to those who have copies but have not run their island, and to
  /// those to whose space they have been kicked. Errors: those of Transit::exchange().
  Result<void> renew_ghosts();

  /// How often ranks have told each other something.
  std::uint64_t rounds() const { return rounds_; }

 private:
  // phase_part.cpp: the rounds.
  Result<bool> share();
  void send_to(int rank, SendBuffers& outbox);
  void take_in(const std::vector<Communicator::Bytes>& incoming);
  void join_as_told();
  bool join_as_told(JoinList& list);
  void ask_for(const JoinList::Member& member);
  bool ask_for(const Box& box);
  void send(std::uint32_t number, int to);
  void note_news();
  void note_space(const Cluster& group);
  void note_list(const Cluster& group, std::optional<std::uint32_t> met);
  void note_updates(const Cluster& group);
  bool is_own(std::uint32_t number) const { return local_.directory.is_own(number); }
  bool is_ours(const Cluster& group) const;
  bool is_ready(const Cluster& group) const;
  std::vector<int> owners_of(const Cluster& group) const;

  // phase_part_end.cpp: what came of it.
  void add_costs();
  std::vector<std::uint32_t> own_updated(const Cluster& group) const;
  BodyMessage pack_changed(std::uint32_t number, bool is_kicked, const Cluster& group) const;
  void renew_ghosts(const Cluster& group, SendBuffers& outbox);

  Communicator& communicator_;
  ErrorConsensus& agreement_;
  RankState& local_;
  Migration& transit_;
  HaloRegions& known_;
  SpeculativeRunner& runner_;
  std::vector<JoinList> lists_;        ///< that wait for bodies to become known, or to be in an island
  std::vector<std::uint32_t> asking_;  ///< groups that have asked for space
  Round round_;                        ///< what is to be said next
  std::uint64_t rounds_ = 0;
};

}  // namespace kinesphere
