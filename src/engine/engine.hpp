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

#include "engine/bodies_in.hpp"
#include "engine/call_state.hpp"
#include "engine/event_processor.hpp"
#include "engine/overlaps.hpp"
#include "engine/speculative_runner.hpp"
#include "engine/window_choice.hpp"
#include "engine/world_editor.hpp"
#include "engine/world_state.hpp"
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
  Result<bool> run_epoch(double until, const Probe& probe, PoolLease& shift, SpeculativeRunner& islands,
                         std::deque<Event>& events);
  SpeculativeRunner runner(PoolLease& shift, const Probe& probe, ResponseHandler* handler) {
    return {state_, main_, shift, probe, handler};
  }
  double epoch_end() const { return main_.epoch_end(); }
  /// Something has to be done before time moves on.
  bool is_due() { return std::min(main_.epoch_end(), main_.next_time()) <= time(); }
  double time() const { return main_.time(); }
  CallState activity() const;

  WorldEditor changes() { return {state_, main_}; }

  // What is known at the current time.
  const Bodies& bodies() const { return state_.bodies; }
  const ContactGraph& contacts() const { return state_.contacts; }
  const BroadPhase& broad_phase() const { return state_.broad_phase; }
  const EventProcessor& main() const { return main_; }
  /// Those that hold, or those of them that a body has a part in.
  std::vector<PairCertificate> certificates(std::optional<std::uint32_t> number = std::nullopt) const;
  /// All that may be in a box now, by number.
  std::vector<std::uint32_t> bodies_in(const Box& box) const {
    return kinesphere::bodies_in(box, state_, main_.dirty(), time());
  }
  const WorldDefinition& definition() const { return bodies().definition(); }
  const Counters& counters() const { return main_.work().counters; }
  /// Contains the body, and all that it senses, from now until its window ends.
  Box box(std::uint32_t number) const { return broad_phase().box_of(number, time()); }
  class Answers;
  class Queries;
  std::optional<AuditFinding> audit() const;
  Memory memory() const;

  Overlaps overlaps() const { return {bodies(), broad_phase(), time()}; }
  /// As EventProcessor::probe_stale(), while no advance() goes on.
  Result<bool> probe_stale(std::span<const std::uint32_t> numbers, const Probe& ask, std::string_view call);

  // snapshot.cpp: the whole state as bytes.
  std::vector<std::byte> save() const;
  static Result<std::unique_ptr<Engine>> restore(std::span<const std::byte> bytes, PairFilter pair_filter);

 private:
  class Audit;

  // phases.cpp
  Result<void> start_windows(PoolLease& shift, bool all, std::span<const std::uint32_t> joining = {});
  Result<void> start_with_arrivals(PoolLease& shift);
  Result<void> gather();
  Result<void> recertify(PoolLease& shift);

  // snapshot.cpp
  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive);
  const char* first_invalid_part() const;
  bool queue_is_valid() const;
  bool window_ends_are_valid() const;
  bool static_contacts_are_valid() const;

  WorldState state_;
  EventProcessor main_;
  std::vector<SearchResults> found_;         ///< by worker; kept for its memory only
  std::vector<PairCertificate> read_pairs_;  ///< from a snapshot, until they are in the agenda
};

}  // namespace kinesphere
