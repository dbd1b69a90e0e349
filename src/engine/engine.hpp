// World::Engine is the implementation of World: the clock, and changes by the caller. The invariants that
// hold for all bodies are stated in core/core.hpp.
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
#include "engine/world_editor.hpp"
#include "kinesphere/world.hpp"
#include "parallel/thread_pool.hpp"
#include "processor/bodies_in.hpp"
#include "processor/event_processor.hpp"
#include "processor/overlaps.hpp"
#include "processor/world_state.hpp"

namespace kinesphere {

class World::Engine {
 public:
  explicit Engine(const WorldDefinition& definition);
  Engine(const Engine& other);

  // Time.
  /// Begins a call that advances to `until`, with any number of calls of the functions below. Without it, no
  /// call fails because its end is out of reach.
  void begin_call(double until) { main_.begin_call(until); }
  /// Notes that the call has delivered an event.
  void note_delivery() { main_.restart_pace(); }
  /// `lease`: threads that may all call the probe; nullptr if there are none.
  Result<std::optional<Event>> advance(double until, const Probe& probe, PoolLease* lease = nullptr);
  double time() const { return main_.time(); }
  CallState activity() const;

  /// Events that wait are described anew after a change.
  WorldEditor changes() {
    main_.events().outdate();
    return {state_, main_};
  }

  // State at the current time.
  const Bodies& bodies() const { return state_.bodies; }
  const ContactGraph& contacts() const { return state_.contacts; }
  const core::Core& core() const { return state_.core; }
  const EventProcessor& main() const { return main_; }
  /// Sets threads that share what concerns many bodies at once (EventProcessor::use_workers()). Copies of the
  /// engine have none.
  void use_workers(Workers* workers, bool call_probe) {
    main_.use_workers(workers);
    probing_workers_ = call_probe ? workers : nullptr;
  }
  /// Returns the threads that may all call the probe; nullptr if there are none.
  Workers* probing_workers() const { return probing_workers_; }
  /// Returns true if the body is registered for searches.
  bool is_registered(std::uint32_t number) const { return core().contains(number); }
  /// Returns the time until which the body stays in its box.
  double box_end(std::uint32_t number) const { return core().stays_until(number); }
  /// Returns all bodies that may be in the box now, in ascending order.
  std::vector<std::uint32_t> bodies_in(const Box& box) const {
    return kinesphere::bodies_in(box, state_, main_.dirty());
  }
  /// Returns the time before which the engine claims that nothing happens between two bodies.
  double claimed_until(std::uint32_t a, std::uint32_t b) const {
    return std::min(core().balls()[a].due, core().balls()[b].due);
  }
  const WorldDefinition& definition() const { return bodies().definition(); }
  const Counters& counters() const { return main_.counters(); }
  /// Returns the view of a body, with its last report moved into the primary box of a periodic space.
  BodyView view(std::uint32_t number) const;
  /// Returns a box that contains the body and its sensor reach until box_end().
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

  // engine.cpp
  Result<void> gather(double until);
  Result<void> spot_check();

  // snapshot.cpp
  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive);
  const char* first_invalid_part() const;
  bool shape_contacts_are_valid() const;

  WorldState state_;
  EventProcessor main_;
  std::unique_ptr<ProbeProfile> profile_;
  Workers* probing_workers_ = nullptr;
};

}  // namespace kinesphere
