// RankEngine is one rank's part of a distributed world: own bodies, ghosts of nearby bodies, and the exchange
// between ranks that makes each execute its clusters as one world would.
//
// Invariants on each rank whenever time advances:
//   - The halo region contains the swept spheres of all own bodies.
//   - The rank holds an exact ghost of each body whose swept sphere may enter the halo region, with all
//     certificates and links between it and bodies that the rank holds.
// So everything that can affect an own body before its window ends is known to its owner. A batch
// (batch_exchange.hpp) ends when all ranks that own a body of a cluster have executed the cluster with an
// equal set of members; each then has the results of one world (docs/distributed.md has the proof).
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "distributed/answering.hpp"
#include "distributed/communicator.hpp"
#include "distributed/distribution.hpp"
#include "distributed/error_consensus.hpp"
#include "distributed/halo_region.hpp"
#include "distributed/migration.hpp"
#include "distributed/rank_state.hpp"
#include "distributed/unique_names.hpp"
#include "distributed/window_starts.hpp"
#include "kinesphere/distributed/distributed_world.hpp"
#include "speculation/speculative_runner.hpp"

namespace kinesphere {

struct Checkpoint;

class DistributedWorld::RankEngine {
 public:
  RankEngine(const WorldDefinition& definition, Motion& motion);

  Communicator& communicator() { return communicator_; }
  const WorldDefinition& definition() const { return rank_.bodies().definition(); }
  double time() const { return rank_.time(); }
  /// Collective. See ErrorConsensus::agree().
  Result<void> agree(const Result<void>& here) { return consensus_.agree(here); }

  Result<void> add(std::uint32_t name, const BodyDefinition& body, std::uint32_t number_in_motion);
  Result<void> add_rigid_body(std::uint32_t name, const RigidBody& added, std::uint32_t number_in_motion);
  Result<void> add_moving_shape(std::uint32_t name, const MovingShape& added, std::uint32_t number_in_motion);
  Result<void> set_sensor(SensorClass sensor_class, const Sensor& sensor);
  Result<void> run(double until, const ResponseFn* respond, const OrderedEventFn& sink, Workers* workers);

  // rank_engine_checkpoint.cpp
  Result<std::vector<std::byte>> save();
  static Result<std::unique_ptr<RankEngine>> restore(std::span<const std::vector<std::byte>> parts,
                                                     Motion& motion);

  std::uint64_t own_bodies() const { return rank_.directory.own_count(); }
  const Counters& counters() const { return rank_.main.work().counters; }
  const EventHash& hash() const { return hash_; }
  RankFigures figures() const;

 private:
  Result<void> check_addition(std::uint32_t name, const BodyDefinition& body, std::uint32_t number_in_motion,
                              std::string_view call) const;
  /// Adds a body, which is a ball as yet. Returns its number.
  std::uint32_t insert(std::uint32_t name, const BodyDefinition& body, std::uint32_t number_in_motion);
  Result<void> check_run(double until, const PoolLease& lease) const;
  Result<void> go(double until, const OrderedEventFn& sink, PoolLease& lease, SpeculativeRunner& runner);
  Result<void> start_arrivals(PoolLease& lease, SpeculativeRunner& runner);
  Result<void> spot_check(PoolLease& lease);
  Result<double> run_batch(double until, double latest, SpeculativeRunner& runner);
  void deliver(const OrderedEventFn& sink);
  Result<void> resume(const Checkpoint& common, std::vector<Checkpoint>& parts);

  Communicator communicator_;
  ErrorConsensus consensus_;
  RankState rank_;
  RankSource source_;
  Migration migration_;
  HaloRegions known_;
  Distribution distribution_;
  WindowStarts starts_;
  UniqueNames names_;
  std::deque<OrderedEvent> events_;  ///< events to be reported
  EventHash hash_;                   ///< hash of all committed events
  std::uint64_t batches_ = 0;
  std::uint64_t rounds_ = 0;
};

}  // namespace kinesphere
