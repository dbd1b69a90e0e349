// Part is what a rank simulates during a slab of time: its own bodies, and ghosts of those around.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/ghosts.hpp"
#include "distributed/answering.hpp"
#include "distributed/body_record.hpp"
#include "distributed/name_table.hpp"
#include "kinesphere/distributed/distributed_world.hpp"
#include "number/infinity.hpp"
#include "processor/event_processor.hpp"

namespace kinesphere {

/// What concerns all bodies of a distributed world, equal on all ranks.
struct WorldFacts {
  bool has_shapes = false;         ///< some body is no ball
  bool grows = false;              ///< the bound of some body grows
  bool drifts = false;             ///< that of some body has a planned acceleration or a growth speed
  double common_reach = infinity;  ///< up to which all bodies sense, if there are any (length)
  double first_radius = 0.0;       ///< of the first safe region of a body that arrives alone (length)
  std::uint64_t measured = 0;      ///< how many bodies there were when first_radius was chosen
  SpotChecks spot_checks{};

  static void serialize(auto& self, auto& archive) {
    archive(self.has_shapes, self.grows, self.drifts, self.common_reach, self.first_radius, self.measured,
            self.spot_checks);
  }
};

class Part {
 public:
  /// Makes the part of these bodies at a time. `records`: in ascending order of names; those owned by other
  /// ranks are ghosts.
  Part(const WorldDefinition& definition, const SensorTable& sensors, const WorldFacts& facts, double time,
       int rank, std::span<const BodyRecord* const> records, Motion& motion);
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;

  double time() const { return main_.time(); }
  WorldState& state() { return state_; }
  EventProcessor& main() { return main_; }
  const core::Ghosts& ghosts() const { return ghosts_; }
  std::uint32_t numbers() const { return state_.bodies.numbers(); }
  std::uint32_t name_of(std::uint32_t number) const { return state_.bodies.table().name_of(number); }
  int owner_of(std::uint32_t number) const { return owners_[number]; }
  /// Returns the number of a body by its name, which has to be in this part.
  std::uint32_t number_of(std::uint32_t name) const { return *numbers_.find(name); }

  /// Recertifies the bodies that have arrived or wait for a report. Errors: those of probes.
  Result<void> begin();
  /// Advances to `until`, or to `stop` without what is due at that time, or until there are `most` events,
  /// whichever is first. `respond` may be null. Appends the
  /// events whose first body is no ghost. Errors: those of probes and of responses; time() is then that of
  /// the failure.
  Result<void> run(double stop, double until, std::size_t most, const ResponseFn* respond,
                   std::vector<OrderedEvent>& events);
  /// Gives the bodies of the motion the origins back that they had before run().
  void undo();

  /// Brings records of bodies of this part up to date, without their motions. Returns how often something has
  /// happened to these bodies.
  std::uint64_t update(std::vector<BodyRecord>& records) const;

 private:
  void install(const BodyRecord& record);
  void link(std::uint32_t number, const BodyRecord& record);
  BodyRecord record_of(std::uint32_t number) const;
  void keep_notes(const BodyRecord& before, BodyRecord& now) const;
  core::Core::Record numbered(std::uint32_t number, const BodyRecord& record) const;
  Result<void> deliver(const Event& event, std::uint32_t round, RankResponder* responder,
                       std::vector<OrderedEvent>& events);

  int rank_;
  Motion& motion_;
  WorldState state_;
  core::Ghosts ghosts_;
  EventProcessor main_;
  NameTable numbers_;
  std::vector<std::uint32_t> in_motion_;  ///< by number
  std::vector<std::int32_t> owners_;      ///< by number
  RankSource source_;
  Probe probe_;
  /// Origins before the first response to each body.
  std::vector<std::pair<std::uint32_t, MotionOrigin>> before_;
  std::vector<bool> is_turned_;  ///< by number: in before_
};

}  // namespace kinesphere
