// DistributedWorld is one world simulated by several MPI processes, for more bodies than one machine can hold
// or simulate in time.
//
//   MpiSession mpi(argc, argv);
//   Ballistic motion = ...;                                  // the bodies that this process adds
//   DistributedWorld world = DistributedWorld::create({}, motion).value();
//   for (std::uint32_t k = 0; k < motion.size(); ++k)
//     world.add(first + k, motion.definition(k, 0.0), k).value();
//   world.run(60.0, respond, sink).value();
//
// The processes are the ranks of MPI_COMM_WORLD, started by mpirun, or of a communicator of the caller's.
// Each rank owns the bodies in its region of space and holds ghosts of bodies nearby. Events are bitwise
// equal to those of one World with equal bodies and indices, for any number of ranks and any assignment of
// bodies to the ranks that add them. Small worlds gain nothing from ranks (docs/distributed.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "kinesphere/callback.hpp"
#include "kinesphere/counters.hpp"
#include "kinesphere/event_hash.hpp"
#include "kinesphere/motion/motion.hpp"
#include "kinesphere/result.hpp"
#include "kinesphere/rigid_body.hpp"
#include "kinesphere/run.hpp"
#include "kinesphere/sensor.hpp"
#include "kinesphere/shape.hpp"
#include "kinesphere/workers.hpp"
#include "kinesphere/world_definition.hpp"

namespace kinesphere {

/// An event with the round in which it occurred within its instant. Consequences of an event, such as the
/// contact after a bounce, occur in a later round.
struct OrderedEvent {
  Event event{};
  std::uint32_t round = 0;

  /// Orders events as one World reports them: by time, round, kind, bodies, wall and distance.
  friend bool operator<(const OrderedEvent& a, const OrderedEvent& b);

  friend constexpr bool operator==(const OrderedEvent&, const OrderedEvent&) = default;
};

/// Any callable `void(const OrderedEvent&)`.
using OrderedEventFn = Callback<void(const OrderedEvent& event)>;

/// Work, memory and traffic of one rank.
struct RankFigures {
  std::uint64_t bodies = 0;       ///< bodies owned by this rank
  std::uint64_t ghosts = 0;       ///< of bodies owned by other ranks, in the last slab of time
  std::uint64_t bytes = 0;        ///< sent to other ranks so far
  std::uint64_t messages = 0;     ///< point-to-point messages sent
  std::uint64_t collectives = 0;  ///< collective calls
  std::uint64_t batches = 0;      ///< slabs of time, each of which ends in an agreement of all ranks
  std::uint64_t rounds = 0;       ///< tries of slabs; a slab that fails is tried again
  std::uint64_t partitions = 0;   ///< number of times that space was partitioned
  double seconds_in_mpi = 0.0;    ///< processor time in MPI, including time spent waiting for other ranks

  friend constexpr bool operator==(const RankFigures&, const RankFigures&) = default;
};

/// One rank's handle to a distributed world. Collective functions have to be called on all ranks, in an equal
/// order and with equal arguments, except for arguments that are per rank. A collective function returns an
/// equal error on all ranks; its message begins with the rank on which the error occurred. After an error of
/// run() the world cannot continue: every later call fails with rank_failed.
///
/// Features of World that DistributedWorld lacks: static bodies, rotation probes, sleep, changes and removals
/// between events, timers, pair filters, queries, recordings. `allow_overlap` must be true.
class DistributedWorld {
 public:
  /// Collective. Creates an empty world. `motion` moves the bodies of this rank and must outlive the world.
  /// Bodies migrate between ranks with Motion::write_body and read_body, so all ranks need motions of equal
  /// definition; responses need origin() and set_origin(), too.
  /// `communicator`: the ranks that share the world, as the Fortran handle of an MPI communicator:
  /// MPI_Comm_c2f(comm), in mpi4py comm.py2f(). It is duplicated, so a coupled program may use it meanwhile.
  /// Only its ranks make the collective calls. Default: MPI_COMM_WORLD.
  /// Errors: those of World::create; unsupported (allow_overlap); on this rank alone, unsupported
  /// (communicator: it is MPI_COMM_NULL or an intercommunicator).
  [[nodiscard]] static Result<DistributedWorld> create(const WorldDefinition& definition, Motion& motion,
                                                       std::optional<int> communicator = std::nullopt);
  DistributedWorld(DistributedWorld&&) noexcept;
  DistributedWorld& operator=(DistributedWorld&&) noexcept;
  ~DistributedWorld();

  /// Adds body `number_in_motion` of this rank's motion, in the state given by `body`, at the current time().
  /// `index` is the index of the body's id in events and must be unique over all ranks. Not collective.
  /// Errors: those of World::add; out_of_range (`index` belongs to a body that this rank holds); unknown_body
  /// (the motion has no such body); unsupported (sensor_class: the world has run, and this body would sense
  /// less far than all its bodies do).
  Result<void> add(std::uint32_t index, const BodyDefinition& body, std::uint32_t number_in_motion);
  /// Adds a rigid body in the same way, which keeps its angular velocity between contacts. It moves and turns
  /// as one of World::add_rigid_body(). Errors: those of add() and World::add_rigid_body(); unsupported
  /// (angular_acceleration_limit: a distributed world has no RotationProbe).
  Result<void> add_rigid_body(std::uint32_t index, const RigidBody& body, std::uint32_t number_in_motion);
  /// Adds a moving shape in the same way. Errors: those of add() and World::add_moving_shape().
  Result<void> add_moving_shape(std::uint32_t index, const MovingShape& body, std::uint32_t number_in_motion);
  /// Collective. Sets a sensor class as World::set_sensor does; all ranks pass equal arguments. Precondition:
  /// no rank has added bodies. Errors, equal on all ranks: those of World::set_sensor; unsupported
  /// (sensor_class: there are bodies). After an error the world is unchanged and can continue.
  Result<void> set_sensor(SensorClass sensor_class, const Sensor& sensor);
  /// Sets the state of the pair of bodies with these indices, as World::set_pair_state does. Not collective,
  /// but to be called on all ranks between two runs, with equal arguments: each keeps it that holds one of
  /// the two; a pair of which no rank holds both has none. Errors: out_of_range for one body twice. Cost:
  /// O(log n), and O(n log n) once after bodies have been added.
  Result<void> set_pair_state(std::uint32_t first, std::uint32_t second, std::int32_t state);

  /// Collective. Advances to `until` as World::run does. `respond` may be called several times for one event,
  /// and on several ranks, and must be a pure function, with equal responses everywhere; without it, events
  /// get no response. `sink` receives, in order, the events whose first body is owned by this rank, each
  /// once. `workers` have no effect. Errors: those of World::run; callback_threw where World::run would
  /// propagate an exception; out_of_range (index) where two ranks have added bodies of equal index.
  Result<void> run(double until, const ResponseFn& respond, const OrderedEventFn& sink,
                   Workers* workers = nullptr);
  Result<void> run(double until, const OrderedEventFn& sink, Workers* workers = nullptr);

  /// Collective. Serializes this rank's part of the world to bytes. restore() with all parts continues on any
  /// number of ranks, with bitwise equal results. Errors: rank_failed; those of Motion::write_body.
  Result<std::vector<std::byte>> save();
  /// Collective. Restores a world from the parts written by save(). Each part is passed on exactly one rank,
  /// no matter which; a rank may pass several parts or none. `motion` must be empty and have the definition
  /// of the motions that were saved. Errors: bad_snapshot if a part is damaged, missing, duplicated or of
  /// another world; those of Motion::read_body; of `communicator` as for create().
  [[nodiscard]] static Result<DistributedWorld> restore(std::span<const std::vector<std::byte>> parts,
                                                        Motion& motion,
                                                        std::optional<int> communicator = std::nullopt);

  /// Return the current time, the number of this rank and of all ranks, and the definition. Not collective.
  double time() const;
  int rank() const;
  int ranks() const;
  const WorldDefinition& definition() const;
  /// Collective. Returns the number of bodies of all ranks.
  std::uint64_t size() const;
  /// Collective. Returns the counters summed over all ranks, which count work on the bodies that each owns.
  Counters counters() const;
  /// Collective. Returns the hash of all events reported so far, over all ranks.
  EventHash hash() const;
  /// Returns work, memory and traffic of this rank. Not collective.
  RankFigures figures() const;

 private:
  class RankEngine;
  explicit DistributedWorld(std::unique_ptr<RankEngine> domain);

  std::unique_ptr<RankEngine> engine_;
};

}  // namespace kinesphere
