// The engine behind World: the clock, windows, and what the caller changes. What must always hold of any two
// bodies stands in island.hpp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/activity.hpp"
#include "engine/bodies_in.hpp"
#include "engine/changes.hpp"
#include "engine/island.hpp"
#include "engine/islands.hpp"
#include "engine/overlaps.hpp"
#include "engine/pacing.hpp"
#include "engine/tables.hpp"
#include "kinesphere/world.hpp"

namespace kinesphere {

class World::Engine {
 public:
  explicit Engine(const WorldDefinition& definition);
  Engine(const Engine& other);

  // The clock.
  Result<std::optional<Event>> advance(double until, const Probe& probe);
  /// The same for many events at once (islands.hpp), up to `until` or to the end of a part of the phase.
  /// Appends them to `events`. False where that cannot be done, or is not worth it, until the phase's end:
  /// advance() can.
  Result<bool> run_phase(double until, const Probe& probe, Shift& shift, Islands& islands,
                         std::deque<Event>& events);
  Islands islands(Shift& shift, const Probe& probe, Answerer* answerer) {
    return {tables_, everybody_, shift, probe, answerer};
  }
  double phase_end() const { return everybody_.phase_end(); }
  /// Something has to be done before time moves on.
  bool is_due() { return std::min(everybody_.phase_end(), everybody_.next_time()) <= time(); }
  double time() const { return everybody_.time(); }
  Activity activity() const;

  Changes changes() { return {tables_, everybody_}; }

  // What is known at the current time.
  const Bodies& bodies() const { return tables_.bodies; }
  const ContactBook& book() const { return tables_.book; }
  const Windows& windows() const { return tables_.windows; }
  const Island& everybody() const { return everybody_; }
  /// Those that hold, or those of them that a body has a part in.
  std::vector<HotPair> hot_pairs(std::optional<std::uint32_t> number = std::nullopt) const;
  /// All that may be in a box now, by number.
  std::vector<std::uint32_t> bodies_in(const Box& box) const {
    return kinesphere::bodies_in(box, tables_, everybody_.unsettled(), time());
  }
  const WorldDefinition& definition() const { return bodies().definition(); }
  const Counters& counters() const { return everybody_.work().counters; }
  /// Contains the body, and all that it senses, from now until its window ends.
  Box box(std::uint32_t number) const { return windows().box_of(number, time()); }
  class Answers;
  class Queries;
  std::optional<AuditFinding> audit() const;
  Memory memory() const;

  Overlaps overlaps() const { return {bodies(), windows(), time()}; }
  /// As Island::probe_stale(), while no advance() goes on.
  Result<bool> probe_stale(std::span<const std::uint32_t> numbers, const Probe& ask, std::string_view call);

  // snapshot.cpp: the whole state as bytes.
  std::vector<std::byte> save() const;
  static Result<std::unique_ptr<Engine>> restore(std::span<const std::byte> bytes, PairFilter pair_filter);

 private:
  class Audit;

  // phases.cpp
  Result<void> start_windows(Shift& shift, bool all, std::span<const std::uint32_t> joining = {});
  Result<void> start_with_arrivals(Shift& shift);
  Result<void> gather();
  Result<void> settle(Shift& shift);

  // snapshot.cpp
  template <class Self, class Archive>
  static void transfer(Self& self, Archive& archive);
  const char* contradiction() const;
  bool agenda_is_sound() const;
  bool renewals_are_sound() const;
  bool contacts_of_fixed_are_sound() const;

  Tables tables_;
  Island everybody_;
  std::vector<FoundPairs> found_;    ///< by worker; kept for its memory only
  std::vector<HotPair> read_pairs_;  ///< from a snapshot, until they are in the agenda
};

}  // namespace kinesphere
