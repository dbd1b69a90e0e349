// EventProcessor processes the events of a world, or of a rank's part of one, in the order of time. It has
// the clock and the events of the present instant, and is the host of the core (core/core.hpp): the core
// knows what is due, and the processor what bodies that come near each other are to each other.
//
// The invariants of the core hold whenever time advances. They concern the true bodies, so later probes do
// not invalidate them. Only a discontinuity does: a velocity change, a report that violates its bound, or a
// change by the caller. It increments the body's revision, so that nothing is known of its pairs, and marks
// the body dirty. Before time advances, the core is told of all dirty bodies.
#pragma once

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "contact/contact_predictor.hpp"
#include "contact/pending_events.hpp"
#include "core/host.hpp"
#include "kinesphere/result.hpp"
#include "number/infinity.hpp"
#include "processor/dirty_list.hpp"
#include "processor/pace.hpp"
#include "processor/pair_certifier.hpp"
#include "processor/pair_times.hpp"
#include "processor/reports.hpp"
#include "processor/world_state.hpp"

namespace kinesphere {

class alignas(128) EventProcessor final : public core::Host {
 public:
  EventProcessor(WorldState& state, double time) : state_(&state), time_(time) {}
  /// Copies a processor, to work on `state`, a copy of the other's world state.
  EventProcessor(EventProcessor other, WorldState& state) : EventProcessor(std::move(other)) {
    state_ = &state;
    workers_ = nullptr;
    reports_.set_profile(nullptr);
  }

  double time() const { return time_; }
  const Counters& counters() const { return counters_; }
  const PendingEvents& events() const { return events_; }
  PendingEvents& events() { return events_; }
  /// Returns the bodies to recertify before time advances.
  const DirtyList& dirty() const { return dirty_; }
  DirtyList& dirty() { return dirty_; }

  /// Returns true if the invariant holds and no event is waiting for delivery.
  bool is_certified() const {
    return !gathering_ && dirty_.empty() && events_.is_quiet() && events_.changed().empty();
  }

  // Time.
  /// Returns true if the work of this instant has begun and is incomplete. It stays true when an invalid
  /// report interrupts it; the next call then continues.
  bool is_gathering() const { return gathering_; }
  /// Returns the earliest time at which something is due; +infinity if nothing is, or if it is later than
  /// `until`.
  double next_time(double until = infinity) { return core().next_due(until); }
  void advance_clock(double time) {
    if (time > time_) events_.start();
    time_ = time;
    core().set_time(time);
  }
  /// Advances the clock to an instant at which work is due.
  void begin_instant(double time) {
    advance_clock(std::max(time, time_));
    gathering_ = true;
  }
  /// Measures how far time goes in a call that advances to `until`, or from an event on.
  void begin_call(double until) { pace_.begin_call(time_, until); }
  void restart_pace() { pace_.restart(time_); }
  /// Counts an instant. Errors: out_of_range if time will practically never reach the end of the call.
  Result<void> note_instant() { return pace_.note_instant(bodies(), time_); }
  /// Handles all that is due, so that every event of this instant is known before the first is delivered.
  /// While no event is known, continues with the next instants, up to `until` and before the next spot check.
  /// Errors: those of probe() and note_instant().
  Result<void> gather(double until);
  /// Recertifies all changed pairs and dirty bodies; afterwards the invariant holds. Errors: those of
  /// probe().
  Result<void> recertify() { return is_recertified() ? Result<void>() : recertify_all(); }
  /// Returns true if recertify() would do nothing.
  bool is_recertified() const {
    return events_.changed().empty() && dirty_.empty() && !events_.awaits_response();
  }
  /// Returns the next event of this instant, or nullopt if there is none.
  std::optional<Event> pop();
  /// Takes note of the response to the last event.
  void note_response();

  // Discontinuities.
  /// Nothing is known of the pairs of the body any longer. Marks it dirty. `turns`: its velocity alone
  /// changes.
  void invalidate(std::uint32_t number, bool turns = false) {
    events_.outdate();
    ++bodies()[number].revision;
    dirty_.add(bodies(), number, turns);
  }
  /// Sets the velocity of the body from the current time on.
  void set_velocity(BodyId body, const Vec3& velocity) {
    set_velocity(bodies().table().number_of(body), velocity);
  }
  void set_velocity(std::uint32_t number, const Vec3& velocity);
  /// The same of many bodies, one after the other. The threads of the lease share it.
  void set_velocities(std::span<const BodyId> ids, std::span<const Vec3> velocities, PoolLease& lease);
  /// Sets the angular velocity of a rigid body from the current time on.
  void set_angular_velocity(std::uint32_t number, const Vec3& angular_velocity);
  /// The two of this event, a crossing of a sensor distance that has been delivered, have not crossed it: a
  /// response has turned them back. No effect if they are not both there, no longer sense each other at this
  /// distance, or move on across it.
  void turn_back(const Event& crossing);
  /// Ends the contacts of the body and takes it out of the core: the body is about to be removed or disabled.
  void detach(std::uint32_t number);

  /// Returns a certifier at the current time.
  PairCertifier certifier() const { return {*state_, time_}; }

  // Threads.
  /// From now on, these share what concerns many bodies at once, but for calls of the probe; nullptr for
  /// none. They must outlive their use here. Copies have none.
  void use_workers(Workers* workers) { workers_ = workers; }
  /// Returns the workers if so many bodies are worth their while, otherwise nullptr.
  Workers* workers_for(std::size_t bodies) const { return bodies >= least_shared ? workers_ : nullptr; }

  // Reports.
  Reports& reports() { return reports_; }
  const Reports& reports() const { return reports_; }
  Result<void> probe(std::span<const std::uint32_t> numbers, ProbeCause cause) {
    PoolLease alone;
    return probe(numbers, cause, reports_.lease() != nullptr ? *reports_.lease() : alone);
  }
  /// Probes the enabled bodies whose state at the current time is unknown. Returns true if there were any.
  Result<bool> probe_stale(std::span<const std::uint32_t> numbers, ProbeCause cause);
  /// Probes exact bodies, for which SpotChecks::may_check(). The reports change nothing, but a body whose
  /// report violates its bound becomes dirty, so that recertify() probes it.
  Result<void> spot_check(std::span<const std::uint32_t> numbers);
  /// Checks as above those of `numbers` that are due. Returns those that spot checks concern, for
  /// SpotChecks::note_check(). `probes`: all that the world has made. Precondition: SpotChecks::next() has
  /// come.
  Result<SpotChecks::Census> spot_check_due(std::span<const std::uint32_t> numbers, std::uint64_t probes);

  /// Time before which what is due is handled without a pause: the next spot check or timer.
  double pause() const { return std::min(state_->spot_checks.next(), state_->timers.next()); }
  /// Takes the next timer out, whose time is the present one. Returns its event.
  Event take_timer();

  /// Serializes all fields of a snapshot.
  static void serialize(auto& self, auto& archive) {
    archive(self.events_, self.time_, self.dirty_, self.gathering_, self.counters_, self.known_);
  }
  /// Validates what was read from bytes of pairs that are near.
  bool knows_valid_times() const { return known_.is_valid(bodies().numbers()); }
  std::size_t bytes() const;

  /// Enters a body that is known by the core from now on, but has no neighbours before it is recertified.
  void enter_core(std::uint32_t number);
  /// The same of a body that others have to find at once.
  void show_in_core(std::uint32_t number) {
    enter_core(number);
    core().show(number);
  }
  /// Returns what is known of pairs that are near.
  PairTimes& pair_times() { return known_; }
  const PairTimes& pair_times() const { return known_; }
  /// Makes anew what a snapshot does not contain of a core. Returns false if no core could have been so.
  bool rebuild_core();

 private:
  /// Fewer bodies are not shared: waking the threads would take longer.
  static constexpr std::size_t least_shared = 4096;
  /// Least number of bodies that a thread takes at a time.
  static constexpr std::size_t least_part = 1024;

  // core_host.cpp
  core::Core& core() { return state_->core; }
  const core::Core& core() const { return state_->core; }
  Bound extent_of(std::uint32_t number) const;
  void set_kind_in_core(std::uint32_t number);
  void note_rotation(std::uint32_t number);
  void settle_core(PoolLease& lease);
  bool tell_core_of_turn(std::uint32_t number);
  void tell_core_of_change(std::uint32_t number);
  void note_reports(std::span<const std::uint32_t> numbers);
  void note_changed_contacts();
  double keep_time(std::uint32_t a, std::uint32_t b, const std::optional<double>& until, double end);
  bool answers_threads() const override;
  void linked_with(std::uint32_t ball, std::vector<std::uint32_t>& linked) override;
  std::size_t keep_partners(std::uint32_t ball, std::span<std::uint32_t> others) override;
  double unchanged_until(std::uint32_t a, std::uint32_t b) override;
  Result<double> recheck(std::uint32_t a, std::uint32_t b) override;
  double walls_unchanged_until(std::uint32_t ball) override;
  Result<double> recheck_walls(std::uint32_t ball) override;
  Result<bool> report(std::span<const std::uint32_t> balls, Reason reason) override;
  void note_image(std::uint32_t ball, const Vec3& centre) override;
  Counters& work_counters(std::uint32_t ball) override { return counters_of(ball); }
  /// Where work on a body is counted: that on ghosts is not counted with that on others.
  Counters& counters_of(std::uint32_t number) { return core().is_ghost(number) ? of_ghosts_ : counters_; }

  Result<void> recertify_all();
  Result<void> probe(std::span<const std::uint32_t> numbers, ProbeCause cause, PoolLease& work);
  Bodies& bodies() { return state_->bodies; }
  const Bodies& bodies() const { return state_->bodies; }
  ContactGraph& contacts() { return state_->contacts; }
  const ContactGraph& contacts() const { return state_->contacts; }

  void note_probes(std::span<const std::uint32_t> numbers, ProbeCause cause);
  void turn(std::uint32_t number, const Vec3& velocity);
  void turn_reported(std::uint32_t number, bool turns = false);
  Result<void> recertify_dirty();
  Result<void> probe_dirty(PoolLease& lease);

  // rechecks.cpp
  Result<std::optional<double>> check_pair(std::uint32_t a, std::uint32_t b);
  Result<std::optional<double>> check_walls(std::uint32_t number);
  double note_rates(RelativeLimits& limits, std::initializer_list<std::uint32_t> numbers, double end) const;
  std::optional<double> decide_pair(std::uint32_t a, std::uint32_t b);
  std::optional<double> decide_walls(std::uint32_t number);
  bool note_return(const Threshold& turned, std::uint32_t a, std::uint32_t b);
  template <class Partner, class Describe>
  std::optional<double> decide(const ContactPredictor<Partner>& predictor, const Threshold& threshold,
                               const RelativeLimits& limits, Counters& work, Describe describe);
  template <class Partner>
  double defer(const ContactPredictor<Partner>& predictor, const Threshold& threshold, const Event& current,
               const RelativeLimits& limits, Counters& work);
  void note_link(const Event& current, const Threshold& threshold);
  Result<void> probe_stale_of(std::uint32_t a, std::uint32_t b);
  Sphere sphere(std::uint32_t number) const { return sphere_at(bodies(), time_, number); }
  DescribedEvent describe_pair(std::uint32_t a, std::uint32_t b) const;
  DescribedEvent describe_wall(std::uint32_t number, Wall wall) const;
  Senses senses_in(const Event& event) const;

  WorldState* state_;
  double time_;
  PendingEvents events_;
  DirtyList dirty_;
  bool gathering_ = false;
  Pace pace_;
  Counters counters_;
  Counters of_ghosts_;  ///< work on ghosts of a rank's part
  Reports reports_;
  PairTimes known_;  ///< of pairs that are near
  Workers* workers_ = nullptr;
  // Members only to reuse their memory.
  std::vector<std::uint32_t> round_;
};

}  // namespace kinesphere
