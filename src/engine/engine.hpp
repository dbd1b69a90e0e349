// World::Engine is the implementation of World: the clock, windows, and changes by the caller. The invariant
// that holds for every pair of bodies is stated in event_processor.hpp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "bodies/call_state.hpp"
#include "engine/prepared_start.hpp"
#include "engine/world_editor.hpp"
#include "kinesphere/world.hpp"
#include "processor/bodies_in.hpp"
#include "processor/event_processor.hpp"
#include "processor/overlaps.hpp"
#include "processor/world_state.hpp"
#include "speculation/speculative_runner.hpp"

namespace kinesphere {

class World::Engine {
 public:
  /// `uses_core`: the core finds what is due; otherwise windows do.
  explicit Engine(const WorldDefinition& definition, bool uses_core = true);
  Engine(const Engine& other);

  // Time.
  /// Begins a call that advances to `until`, with any number of calls of the functions below. Without it, no
  /// call fails because its end is out of reach.
  void begin_call(double until) { main_.begin_call(until); }
  /// Notes that the call has delivered an event.
  void note_delivery() { main_.restart_pace(); }
  Result<std::optional<Event>> advance(double until, const Probe& probe, PoolLease& lease);
  /// Does what is due before a batch (speculative_runner.hpp): starts the windows that end now, and
  /// recertifies changed bodies. Returns false if no batch can begin now; the caller then uses advance().
  Result<bool> prepare_batch(const Probe& probe, PoolLease& lease);
  SpeculativeRunner runner(PoolLease& lease, const Probe& probe, ResponseHandler* handler) {
    return {state_, main_, lease, probe, handler};
  }
  double epoch_end() const { return main_.epoch_end(); }
  /// Returns true if there is work to do before time can advance.
  bool is_due() { return std::min(main_.pause(), main_.next_time(time())) <= time(); }
  double time() const { return main_.time(); }
  CallState activity() const;

  WorldEditor changes() { return {state_, main_}; }

  // State at the current time.
  const Bodies& bodies() const { return state_.bodies; }
  const ContactGraph& contacts() const { return state_.contacts; }
  const BroadPhase& broad_phase() const { return state_.broad_phase; }
  const EventProcessor& main() const { return main_; }
  const WorldState& state() const { return state_; }
  /// Returns true if the body is registered for searches.
  bool is_registered(std::uint32_t number) const {
    return state_.core ? state_.core->contains(number) : broad_phase().contains(number);
  }
  /// Returns the time until which the body stays in its box.
  double box_end(std::uint32_t number) const {
    return state_.core ? state_.core->stays_until(number) : broad_phase().end_of(number);
  }
  /// Returns all valid certificates, or those that involve the body `number`.
  std::vector<PairCertificate> certificates(std::optional<std::uint32_t> number = std::nullopt) const;
  /// Returns all bodies that may be in the box now, in ascending order.
  std::vector<std::uint32_t> bodies_in(const Box& box) const {
    return kinesphere::bodies_in(box, state_, main_.dirty(), time());
  }
  /// Returns the time before which the engine claims that nothing happens between two bodies, or a body and
  /// PairCertificate::walls, apart from the ends of their windows. `times` are those of its certificates.
  double claimed_until(std::uint32_t a, std::uint32_t b, const auto& times) const {
    if (!state_.core) return times.of(a, b);
    const core::Balls& balls = state_.core->balls();
    return b == PairCertificate::walls ? balls[a].own : std::min(balls[a].due, balls[b].due);
  }
  const WorldDefinition& definition() const { return bodies().definition(); }
  const Counters& counters() const { return main_.work().counters; }
  /// Returns the view of a body, with its last report moved into the primary box of a periodic space.
  BodyView view(std::uint32_t number) const;
  /// Returns a box that contains the body and its sensor reach from now until its window ends.
  Box box(std::uint32_t number) const;
  class Answers;
  class Queries;
  std::optional<AuditFinding> audit() const;
  Memory memory() const;
  /// Starts a new profile of probes, or stops the present one. Copies of the engine have none.
  void set_profiling(bool on);
  /// Returns the last profile, or nullptr if there was none.
  const ProbeProfile* profile() const { return profile_.get(); }

  Overlaps overlaps() const { return {state_, time()}; }
  /// Probes bodies as EventProcessor::probe_stale() does. Must not be called during advance().
  Result<bool> probe_stale(std::span<const std::uint32_t> numbers, const Probe& ask, std::string_view call);

  // snapshot.cpp: conversion of the whole state to bytes and back.
  std::vector<std::byte> save() const;
  static Result<std::unique_ptr<Engine>> restore(std::span<const std::byte> bytes, PairFilter pair_filter);

 private:
  class Audit;

  // epochs.cpp and engine.cpp
  Result<void> end_epoch(PoolLease& lease);
  std::vector<std::uint32_t> take_slow(std::vector<std::uint32_t>& numbers);
  void plan_next_start();
  void discard_prepared_start();
  bool may_prepare_starts() const { return definition().spread_window_starts && !bodies().space().repeats(); }
  Result<void> start_windows(PoolLease& lease, bool all, std::span<const std::uint32_t> joining = {});
  Result<void> start_with_arrivals(PoolLease& lease);
  Result<void> gather(double until, PoolLease& lease);
  Result<void> recertify(PoolLease& lease);

  // snapshot.cpp
  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive);
  const char* first_invalid_part() const;
  bool queue_is_valid() const;
  bool window_ends_are_valid() const;
  bool shape_contacts_are_valid() const;

  WorldState state_;
  EventProcessor main_;
  std::unique_ptr<ProbeProfile> profile_;
  std::optional<PreparedStart> prepared_;  ///< the next start of most bodies, if it is prepared
  std::vector<SearchResults> found_;       ///< by worker; a member only to reuse its memory
  /// certificates read from a snapshot, before they enter the queue
  std::vector<PairCertificate> read_pairs_;
};

}  // namespace kinesphere
