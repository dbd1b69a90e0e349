// BatchExchange runs one batch of an epoch: each rank executes the clusters that contain an own body, and
// ranks exchange which clusters have to be merged, until each has executed its clusters with all their
// members.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "distributed/error_consensus.hpp"
#include "distributed/halo_region.hpp"
#include "distributed/migration.hpp"
#include "distributed/round.hpp"
#include "kinesphere/distributed/distributed_world.hpp"
#include "speculation/speculative_runner.hpp"

namespace kinesphere {

/// Exchange of one batch, whose clusters have been formed with SpeculativeRunner::begin_batch(). Call run(),
/// finish() and renew_ghosts() once each, in this order.
class BatchExchange {
 public:
  BatchExchange(Communicator& communicator, ErrorConsensus& consensus, RankState& rank_state,
                Migration& migration, HaloRegions& known, SpeculativeRunner& runner);

  /// Collective. Executes clusters and exchanges rounds with the other ranks until no rank has news. Errors:
  /// the error of the first rank in which a cluster has failed, equal on all ranks.
  Result<void> run();
  /// Commits the results of all executed clusters. Returns, in order, the events whose first body is owned by
  /// this rank.
  std::vector<OrderedEvent> finish();
  /// Collective. Sends changed own bodies to ranks that hold ghosts of them but have not executed their
  /// cluster, and to ranks whose halo region the swept spheres of updated bodies meet. Errors: those of
  /// Migration::exchange().
  Result<void> renew_ghosts();

  /// Number of exchange rounds so far.
  std::uint64_t rounds() const { return rounds_; }

 private:
  // batch_exchange.cpp: the rounds.
  Result<bool> share();
  void send_to(int rank, SendBuffers& buffers);
  void take_in(const std::vector<Communicator::Bytes>& incoming);
  void join_requested();
  bool join_requested(JoinList& list);
  void ask_for(const JoinList::Member& member);
  bool ask_for(const Box& box);
  void send(std::uint32_t number, int to);
  void note_news();
  void note_space(const Cluster& cluster);
  void note_list(const Cluster& cluster, std::optional<std::uint32_t> met);
  void note_updates(const Cluster& cluster);
  bool is_own(std::uint32_t number) const { return rank_.directory.is_own(number); }
  bool is_ours(const Cluster& cluster) const;
  bool is_ready(const Cluster& cluster) const;
  std::vector<int> owners_of(const Cluster& cluster) const;

  // batch_exchange_end.cpp: committing results and renewing ghosts.
  void add_costs();
  std::vector<std::uint32_t> own_updated(const Cluster& cluster) const;
  BodyMessage pack_changed(std::uint32_t number, bool is_updated, const Cluster& cluster) const;
  void renew_ghosts(const Cluster& cluster, SendBuffers& buffers);

  Communicator& communicator_;
  ErrorConsensus& consensus_;
  RankState& rank_;
  Migration& migration_;
  HaloRegions& known_;
  SpeculativeRunner& runner_;
  std::vector<JoinList> lists_;        ///< lists that wait for a body to arrive or to join a cluster
  std::vector<std::uint32_t> asking_;  ///< indices of clusters that have requested boxes
  Round round_;                        ///< messages of the next round
  std::uint64_t rounds_ = 0;
};

}  // namespace kinesphere
