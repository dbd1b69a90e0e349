// Distribution assigns bodies to ranks: it divides space, sends each body to the rank whose region of space
// contains it, and ghosts of bodies to all ranks that need them.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "distributed/body_record.hpp"
#include "distributed/communicator.hpp"
#include "distributed/error_consensus.hpp"
#include "distributed/halo_region.hpp"
#include "distributed/part.hpp"
#include "distributed/partition.hpp"
#include "kinesphere/motion/motion.hpp"

namespace kinesphere {

/// A slab of time that all ranks simulate before they agree.
struct Slab {
  double begin = 0.0;
  double stop = 0.0;      ///< what is due then belongs to the next slab
  bool is_least = false;  ///< it contains one instant
};

/// How far around its region of space a rank knows bodies.
struct Halo {
  double width = 0.0;   ///< the safe regions of its own bodies reach so far beyond it (length)
  double margin = 0.0;  ///< it has ghosts of what is so far around these (length)
};

/// Functions that return a Result are collective. Errors, equal on all ranks: those of Motion::write_body,
/// Motion::read_body and Motion::remove.
class Distribution {
 public:
  Distribution(Communicator& communicator, ErrorConsensus& consensus, const WorldDefinition& definition,
               Motion& motion)
      : communicator_(communicator),
        consensus_(consensus),
        space_(definition),
        primary_(definition.box.value_or(Box{})),
        motion_(motion),
        partition_(communicator.ranks()),
        known_(communicator.ranks(), communicator.rank(), space_) {}

  /// Divides space anew by the work of bodies if it was never divided, or if the imbalance exceeds its limit.
  /// Sends each body to the rank whose region contains it. `own`: the bodies of this rank, which are by name
  /// then. Those that come from a checkpoint have their motions in their records, and get a number in this
  /// rank's.
  Result<void> assign(std::vector<BodyRecord>& own, double time);
  /// Sends ghosts to all ranks that may need them during the slab. Returns those that arrive, in any order,
  /// whose motions have been read.
  Result<std::vector<BodyRecord>> send_ghosts(std::span<const BodyRecord> own, const Slab& slab,
                                              const Halo& halo);
  /// Removes the motions of ghosts.
  void drop(std::span<const BodyRecord> ghosts);
  /// Collective. Returns how many ranks may lack a ghost, or have one that has or should have been a
  /// neighbour of an own body and of which its owner tells another course: in the part that they have
  /// simulated since send_ghosts().
  std::uint64_t count_disagreeing(const Part& part);

  /// Number of times that space has been divided.
  std::uint64_t divisions() const { return divisions_; }

 private:
  Vec3 place_of(const BodyRecord& body, double time) const;
  Box way_of(const BodyRecord& body, const Slab& slab) const;
  void divide(std::span<BodyRecord> own, double time);
  Box region_around(double distance) const;
  void know(std::span<const Box> ways, double width);
  Result<std::vector<BodyRecord>> receive(std::vector<Communicator::Bytes> bytes);
  Box box_of(const core::Ghosts::Region& region) const;
  bool lacks_ghosts(const Part& part) const;
  bool concerns_own(const Part& part, std::uint32_t ghost, const Box& box) const;
  std::vector<Communicator::Bytes> tell_courses(const Part& part);

  Communicator& communicator_;
  ErrorConsensus& consensus_;
  Space space_;
  Box primary_;  ///< in which periodic space repeats
  Motion& motion_;
  Partition partition_;
  HaloRegions known_;  ///< where the safe regions of the bodies of each rank are
  std::uint64_t divisions_ = 0;
  /// Ranks to which the bodies of this rank were sent as ghosts, by name.
  std::vector<std::pair<std::uint32_t, int>> sent_;
};

}  // namespace kinesphere
