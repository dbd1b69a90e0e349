// One rank's part of a distributed world: own bodies and copies of others nearby, and what ranks tell each
// other so that each runs its islands as one world would.
//
// Whenever time moves on, for each rank:
//   - known space contains the capsules of all its own bodies;
//   - the rank has an exact copy of each body whose capsule may come into known space, with all hot pairs and
//     links that it has with bodies that are known here.
// So all that can happen to an own body before windows end is known where it is owned. A part of a phase
// (phase_part.hpp) ends when all ranks that own a body of an island have run the same island, with the same
// bodies: then each has what one world would have (docs/distributed.md has the proof).
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <span>
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
#include "engine/speculative_runner.hpp"
#include "kinesphere/distributed/distributed_world.hpp"

namespace kinesphere {

struct Checkpoint;

class DistributedWorld::RankEngine {
 public:
  RankEngine(const WorldDefinition& definition, Motion& motion);

  Communicator& communicator() { return communicator_; }
  const WorldDefinition& definition() const { return local_.bodies().definition(); }
  double time() const { return local_.time(); }
  /// Collective: as Agreement::agree().
  Result<void> agree(const Result<void>& here) { return agreement_.agree(here); }

  Result<void> add(std::uint32_t name, const BodyDefinition& body, std::uint32_t number_in_motion);
  Result<void> set_sensor(SensorClass sensor_class, const Sensor& sensor);
  Result<void> run(double until, const ResponseFn* respond, const OrderedEventFn& sink, Workers* workers);

  // domain_checkpoint.cpp
  Result<std::vector<std::byte>> save();
  static Result<std::unique_ptr<RankEngine>> restore(std::span<const std::vector<std::byte>> parts,
                                                     Motion& motion);

  std::uint64_t own_bodies() const { return local_.directory.own_count(); }
  const Counters& counters() const { return local_.main.work().counters; }
  const EventHash& hash() const { return hash_; }
  RankFigures figures() const;

 private:
  Result<void> check_body_to_add(std::uint32_t name, const BodyDefinition& body,
                                 std::uint32_t number_in_motion) const;
  Result<void> check_run(double until, const PoolLease& shift) const;
  Result<void> go(double until, const OrderedEventFn& sink, PoolLease& shift, SpeculativeRunner& islands);
  Result<void> settle_arrivals(PoolLease& shift, SpeculativeRunner& islands);
  Result<double> run_part(double until, double latest, SpeculativeRunner& islands);
  void tell(const OrderedEventFn& sink);
  Result<void> resume(const Checkpoint& common, std::vector<Checkpoint>& parts);

  Communicator communicator_;
  ErrorConsensus agreement_;
  RankState local_;
  RankSource mover_;
  Migration transit_;
  HaloRegions known_;
  Distribution distribution_;
  WindowStarts starts_;
  UniqueNames names_;
  std::deque<OrderedEvent> events_;  ///< that are to be told
  EventHash hash_;                   ///< of all that have come of islands
  std::uint64_t parts_ = 0;
  std::uint64_t rounds_ = 0;
};

}  // namespace kinesphere
