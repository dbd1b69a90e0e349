// A world that is spread over several processes: for more bodies than one machine has memory or time for.
//
//   MpiSession mpi(argc, argv);
//   Ballistic motion = ...;                                  // the bodies that this process brings
//   DistributedWorld world = DistributedWorld::create({}, motion).value();
//   for (std::uint32_t k = 0; k < motion.size(); ++k)
//     world.add(first + k, motion.definition(k, 0.0), k).value();
//   world.run(60.0, respond, sink).value();
//
// The processes are the ranks of MPI_COMM_WORLD, started by mpirun. Each has the bodies in a part of space,
// and copies of those nearby. What comes out, to the last bit, is what one World::run would tell with the
// same bodies under the same indices: for any number of ranks and threads, and whoever brings which body.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "kinesphere/callback.hpp"
#include "kinesphere/counters.hpp"
#include "kinesphere/event_hash.hpp"
#include "kinesphere/motion/motion.hpp"
#include "kinesphere/result.hpp"
#include "kinesphere/run.hpp"
#include "kinesphere/sensor.hpp"
#include "kinesphere/workers.hpp"
#include "kinesphere/world_definition.hpp"

namespace kinesphere {

/// An event, and its place among those of the same instant: what an event brings about, such as the contact
/// after a bounce, comes in a later round.
struct OrderedEvent {
  Event event{};
  std::uint32_t round = 0;

  /// The order in which one World tells them: by time, round, kind, bodies, wall and distance.
  friend bool operator<(const OrderedEvent& a, const OrderedEvent& b);
};

/// Any callable `void(const OrderedEvent&)`.
using OrderedEventFn = Callback<void(const OrderedEvent& event)>;

/// Where work and memory of this rank went.
struct RankFigures {
  std::uint64_t bodies = 0;       ///< that are this rank's
  std::uint64_t ghosts = 0;       ///< of bodies of others
  std::uint64_t bytes = 0;        ///< sent to other ranks so far
  std::uint64_t messages = 0;     ///< from rank to rank
  std::uint64_t collectives = 0;  ///< calls in which all ranks took part
  std::uint64_t batches = 0;      ///< stretches of time after which ranks have agreed
  std::uint64_t rounds = 0;       ///< times that they have told each other what has to be done again
  std::uint64_t partitions = 0;   ///< times that space was divided
  double seconds_in_mpi = 0.0;    ///< processor time, with that spent waiting for others
};

/// Functions that are marked as collective have to be called on all ranks, in the same order, with the same
/// arguments but for what belongs to a rank. Their errors are the same on all ranks: the message begins with
/// the rank on which the error is. After an error of run() the world cannot go on: all that follows fails
/// with rank_failed.
///
/// What a World has and this does not: fixed bodies, rest, changes and removals between events, pair filters,
/// queries, recordings. `allow_overlap` must be true.
class DistributedWorld {
 public:
  /// Collective. `motion` moves the bodies of this rank and must outlive the world; the world moves bodies
  /// from rank to rank with Motion::write_body and read_body, so all ranks need motions of the same
  /// definition. Errors: those of World::create; unsupported (allow_overlap).
  [[nodiscard]] static Result<DistributedWorld> create(const WorldDefinition& definition, Motion& motion);
  DistributedWorld(DistributedWorld&&) noexcept;
  DistributedWorld& operator=(DistributedWorld&&) noexcept;
  ~DistributedWorld();

  /// Adds a body of this rank's motion, in the state that `body` says, at the world's present time. `index`
  /// is that of its id in events: as the bodies of all ranks are one world, no two may have the same. Not
  /// collective. Errors: those of World::add; out_of_range (an index that is that of a body which this rank
  /// knows); unknown_body (in the motion).
  Result<void> add(std::uint32_t index, const BodyDefinition& body, std::uint32_t number_in_motion);
  /// As World::set_sensor, before any rank adds bodies. Collective: all ranks have to call it alike. Errors,
  /// the same on all ranks: those of World::set_sensor; unsupported (sensor_class: there are bodies). The
  /// world goes on as it was.
  Result<void> set_sensor(SensorClass sensor_class, const Sensor& sensor);

  /// Collective. Goes on to `until` as World::run does. `respond` is asked on each rank that has a body of
  /// the event, or a copy, and must give the same answer everywhere; without it, events get no answer. `sink`
  /// is told, in order, the events whose first body is this rank's. `workers` may differ from rank to rank.
  /// Errors: those of World::run; callback_threw where World::run would have let an exception pass;
  /// out_of_range (index) where two ranks have added bodies with the same index.
  Result<void> run(double until, const ResponseFn& respond, const OrderedEventFn& sink,
                   Workers* workers = nullptr);
  Result<void> run(double until, const OrderedEventFn& sink, Workers* workers = nullptr);

  /// Collective. This rank's part of all that the world is, as bytes for a file; with all parts restore()
  /// goes on, on any number of ranks, as this world would have: what comes is the same, to the last bit.
  /// Errors: rank_failed; those of Motion::write_body.
  Result<std::vector<std::byte>> save();
  /// Collective. The world that save() has written. Each of its parts is handed in on one rank, whichever;
  /// ranks may hand in several, or none. `motion` has no bodies, and the definition of those that moved them
  /// before. Errors: bad_snapshot for parts that are damaged, missing, there twice or of different worlds;
  /// those of Motion::read_body.
  [[nodiscard]] static Result<DistributedWorld> restore(std::span<const std::vector<std::byte>> parts,
                                                        Motion& motion);

  double time() const;
  int rank() const;
  int ranks() const;
  const WorldDefinition& definition() const;
  /// Collective: bodies of all ranks.
  std::uint64_t size() const;
  /// Collective: of all ranks. What depends on how capsules are kept (searches, candidates, hot_pairs) is not
  /// what one world counts.
  Counters counters() const;
  /// Collective: of all events that have been told.
  EventHash hash() const;
  /// Of this rank.
  RankFigures figures() const;

 private:
  class RankEngine;
  explicit DistributedWorld(std::unique_ptr<RankEngine> domain);

  std::unique_ptr<RankEngine> engine_;
};

}  // namespace kinesphere
