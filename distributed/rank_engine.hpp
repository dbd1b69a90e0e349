// RankEngine is one rank's part of a distributed world.
//
// Between slabs of time it is a list of records of the bodies that it owns. For a slab, each rank makes a
// part (part.hpp) of its own bodies and of ghosts, copies of those around them, and simulates it to the end
// of the slab as a world of its own. Ghosts far out go wrong then, since what is beyond them is missing, and
// what goes wrong spreads inwards. So in the end all ranks compare the courses of ghosts with what their
// owners have found. If those agree that are near own bodies, and no body has come where a rank did not know
// of it, each rank has what one world would have computed (docs/distributed.md has the proof). Otherwise all
// go back, and try a shorter slab with more ghosts.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "distributed/communicator.hpp"
#include "distributed/distribution.hpp"
#include "distributed/error_consensus.hpp"
#include "distributed/part.hpp"
#include "distributed/unique_names.hpp"
#include "kinesphere/distributed/distributed_world.hpp"
#include "number/infinity.hpp"
#include "parallel/thread_pool.hpp"

namespace kinesphere {

struct Checkpoint;

class DistributedWorld::RankEngine {
 public:
  RankEngine(const WorldDefinition& definition, Motion& motion, std::optional<int> communicator);

  Communicator& communicator() { return communicator_; }
  const WorldDefinition& definition() const { return definition_; }
  double time() const { return time_; }
  /// Collective. See ErrorConsensus::agree().
  Result<void> agree(const Result<void>& here) { return consensus_.agree(here); }

  // arrivals.cpp
  Result<void> add(std::uint32_t name, const BodyDefinition& body, std::uint32_t number_in_motion);
  Result<void> add_rigid_body(std::uint32_t name, const RigidBody& added, std::uint32_t number_in_motion);
  Result<void> add_moving_shape(std::uint32_t name, const MovingShape& added, std::uint32_t number_in_motion);
  Result<void> set_sensor(SensorClass sensor_class, const Sensor& sensor);
  Result<void> set_pair_state(std::uint32_t first, std::uint32_t second, std::int32_t state);

  Result<void> run(double until, const ResponseFn* respond, const OrderedEventFn& sink, Workers* workers);

  // rank_engine_checkpoint.cpp
  Result<std::vector<std::byte>> save();
  static Result<std::unique_ptr<RankEngine>> restore(std::span<const std::vector<std::byte>> parts,
                                                     Motion& motion, std::optional<int> communicator);

  std::uint64_t own_bodies() const { return own_.size() + arriving_->bodies.numbers(); }
  const Counters& counters() const { return counters_; }
  const EventHash& hash() const { return hash_; }
  RankFigures figures() const;

 private:
  // arrivals.cpp
  Result<void> check_addition(std::uint32_t name, const BodyDefinition& body, std::uint32_t number_in_motion,
                              std::string_view call) const;
  std::uint32_t insert(std::uint32_t name, const BodyDefinition& body, std::uint32_t number_in_motion);
  void take_arrivals();
  Result<void> start_arrivals();
  void measure(std::uint64_t bodies);
  void choose_radii(std::span<BodyRecord* const> arrivals);

  // rank_engine.cpp
  Result<void> check_run(double until, const PoolLease& lease) const;
  Result<void> go(double until, const ResponseFn* respond, const OrderedEventFn& sink);
  double first_due();
  Halo usual_halo();
  double first_duration();
  Result<bool> run_slab(double until, const ResponseFn* respond);
  struct Outcome {
    bool is_done = false;
    double stop = 0.0;            ///< what was due before has been done
    double work = 0.0;            ///< how much has happened to a body
    double failed_at = infinity;  ///< when the first rank failed
  };
  Result<Outcome> try_slab(const Slab& slab, double until, const Halo& halo, const ResponseFn* respond);
  Result<void> spot_check(Part& part);
  double commit(Part& part, std::vector<OrderedEvent>& events);
  void deliver(const OrderedEventFn& sink);
  Result<void> resume(const Checkpoint& common, std::vector<Checkpoint>& parts);

  WorldDefinition definition_;
  Motion& motion_;
  Communicator communicator_;
  ErrorConsensus consensus_;
  Distribution distribution_;
  UniqueNames names_;
  SensorTable sensors_;
  WorldFacts facts_;
  double time_;
  std::vector<BodyRecord> own_;  ///< by name
  /// Bodies that have been added since the last run, and their numbers in the motion.
  std::unique_ptr<WorldState> arriving_;
  std::vector<std::uint32_t> arriving_in_motion_;
  double duration_ = 0.0;            ///< of the next slab (time); 0 until one has been chosen
  double margin_;                    ///< of ghosts around own bodies (widths of safe regions)
  std::deque<OrderedEvent> events_;  ///< events to be reported
  EventHash hash_;                   ///< hash of all committed events
  Counters counters_;
  std::uint64_t ghosts_ = 0;  ///< of the last slab
  std::uint64_t slabs_ = 0;
  std::uint64_t tries_ = 0;
};

}  // namespace kinesphere
