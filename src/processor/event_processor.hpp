// EventProcessor processes the events of a set of bodies in the order of time.
//
// World::advance() uses one processor with all bodies, main_. World::run() executes clusters of bodies with
// several processors concurrently (speculative_runner.hpp). A processor has a clock, a certificate queue and
// the events of the current instant, and rechecks the certificates that are due.
//
// With a core, the invariants of core/core.hpp hold whenever time advances, and the core knows what is due.
// Invariant without one: whenever time advances, each pair of bodies satisfies one of these conditions:
// - Their swept spheres do not touch before the earlier window end, and each body stays in its swept sphere
//   until its own window ends.
// - They neither change between touching and not touching nor cross a sensor distance before the earlier
//   window end.
// - They do neither before the failure time of a certificate in the queue.
// - The filters prevent them from touching and sensing each other.
//
// A swept sphere includes the sensor reach of its body. The conditions concern the true bodies, so later
// probes do not invalidate them. Only a discontinuity does: a velocity change, a report that violates its
// bound, or a change by the caller. It increments the body's revision, which makes its certificates stale,
// and marks the body dirty. Before time advances, each dirty body gets a new swept sphere and new
// certificates, as does each body whose window has ended. A disabled body leaves the broad phase instead.
#pragma once

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "broadphase/certificate_queue.hpp"
#include "contact/contact_predictor.hpp"
#include "contact/pending_events.hpp"
#include "core/host.hpp"
#include "kinesphere/result.hpp"
#include "number/infinity.hpp"
#include "parallel/thread_pool.hpp"
#include "processor/dirty_list.hpp"
#include "processor/pace.hpp"
#include "processor/pair_certifier.hpp"
#include "processor/pair_times.hpp"
#include "processor/reports.hpp"
#include "processor/speculation_log.hpp"
#include "processor/window_choice.hpp"
#include "processor/world_state.hpp"

namespace kinesphere {

class alignas(128) EventProcessor final : public core::Host {
 public:
  EventProcessor(WorldState& state, double time) : state_(&state), time_(time) {}
  /// Copies a processor, to work on `state`, a copy of the other's world state.
  EventProcessor(EventProcessor other, WorldState& state) : EventProcessor(std::move(other)) {
    state_ = &state;
    reports_.set_profile(nullptr);
  }

  double time() const { return time_; }
  /// Returns the work counted since the counters were last reset.
  const WorkCounters& work() const { return work_; }
  WorkCounters& work() { return work_; }
  const PendingEvents& events() const { return events_; }
  PendingEvents& events() { return events_; }
  const CertificateQueue& queue() const { return queue_; }
  CertificateQueue& queue() { return queue_; }
  /// Returns the bodies to recertify before time advances. Adding a body keeps its certificates.
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
  double next_time(double until = infinity) {
    if (uses_core()) return core().next_due(until);
    if (!queue_.is_open()) open_queue();
    return queue_.next_time();
  }
  void advance_clock(double time) {
    if (time > time_) events_.start();
    time_ = time;
    if (uses_core()) core().set_time(time);
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
  /// Rechecks all certificates that are due, so that every event of this instant is known before the first is
  /// delivered. While no event is known, continues with the next instants, up to `until` and before the epoch
  /// ends. Errors: those of probe() and note_instant().
  Result<void> gather(double until);
  /// Certifies again the pairs whose contacts were changed by delivered events. Pairs of dirty bodies are
  /// skipped, since recertify() finds them.
  void recertify_changed();
  /// Recertifies all changed pairs and dirty bodies; afterwards the invariant holds. Errors: those of
  /// probe().
  Result<void> recertify() { return is_recertified() ? Result<void>() : recertify_all(); }
  /// Returns true if recertify() would do nothing.
  bool is_recertified() const {
    return events_.changed().empty() && dirty_.empty() && linked_.empty() && !events_.awaits_response();
  }
  /// Gives bodies, none of which is dirty, new swept spheres and certificates in place of the present ones.
  void restart(std::span<const std::uint32_t> numbers);
  /// Returns the next event of this instant, or nullopt if there is none.
  std::optional<Event> pop();
  /// Takes note of the response to the last event. Call it before windows start.
  void note_response();

  /// Discards the initial work, which clusters have taken over.
  void discard_initial_work() {
    dirty_.clear();
    events_.clear();
    gathering_ = false;
  }

  // Discontinuities.
  /// Makes all certificates of the body stale and marks it dirty.
  void invalidate(std::uint32_t number);
  /// Sets the velocity of the body from the current time on.
  void set_velocity(BodyId body, const Vec3& velocity) {
    set_velocity(bodies().table().number_of(body), velocity);
  }
  void set_velocity(std::uint32_t number, const Vec3& velocity);
  /// Sets the angular velocity of a rigid body from the current time on.
  void set_angular_velocity(std::uint32_t number, const Vec3& angular_velocity);
  /// Ends the contacts of the body, makes all its certificates stale and takes it out of the broad phase:
  /// the body is about to be removed or disabled.
  void detach(std::uint32_t number);

  /// Returns a certifier at the current time.
  PairCertifier certifier() const { return {*state_, time_, log_}; }

  // Reports.
  Reports& reports() { return reports_; }
  const Reports& reports() const { return reports_; }
  Result<void> probe(std::span<const std::uint32_t> numbers, ProbeCause cause);
  /// Probes as above; several threads may call the probe concurrently.
  Result<void> probe(std::span<const std::uint32_t> numbers, ProbeCause cause, PoolLease& lease);
  /// Probes the enabled bodies whose state at the current time is unknown. Returns true if there were any.
  Result<bool> probe_stale(std::span<const std::uint32_t> numbers, ProbeCause cause, PoolLease& lease);
  /// Probes exact bodies, for which SpotChecks::may_check(). The reports change nothing, but a body whose
  /// report violates its bound becomes dirty, so that recertify() probes it.
  Result<void> spot_check(std::span<const std::uint32_t> numbers, PoolLease& lease);
  /// Checks as above those of `numbers` that are due. Returns those that spot checks concern, for
  /// SpotChecks::note_check(). `probes`: all that the world has made. Precondition: SpotChecks::next() has
  /// come.
  Result<SpotChecks::Census> spot_check_due(std::span<const std::uint32_t> numbers, std::uint64_t probes,
                                            PoolLease& lease);

  /// Starts the execution of a cluster at the start of its batch. Its initial work is certificates that are
  /// due, bodies to recertify first, and events that are known already.
  void begin(SpeculationLog& log, std::span<const PairCertificate> due, std::span<const std::uint32_t> dirty,
             std::span<const Event> pending);

  // Epoch.
  /// Returns the end of the epoch. No window ends earlier, except for those of bodies that were recertified
  /// one by one, for which the queue contains window_end certificates.
  double epoch_end() const { return epoch_end_; }
  void begin_epoch(double end) { epoch_end_ = end; }
  /// Time before which certificates are processed without a pause: the end of the epoch, the next slice of a
  /// prepared start or the next spot check, whichever is earliest.
  double pause() const { return std::min({epoch_end_, next_slice_, state_->spot_checks.next()}); }
  double next_slice() const { return next_slice_; }
  void set_next_slice(double time) { next_slice_ = time; }

  /// Serializes all fields of a snapshot except the queue, which is archived separately.
  static void serialize(auto& self, auto& archive) {
    archive(self.events_, self.time_, self.epoch_end_, self.dirty_, self.gathering_, self.work_.counters,
            self.work_.recertified);
    if (self.uses_core()) archive(self.known_, self.linked_);
  }
  /// Validates what was read from bytes of pairs that are near.
  bool knows_valid_times() const {
    const auto is_known = [this](std::uint32_t number) { return number < bodies().numbers(); };
    return known_.is_valid(bodies().numbers()) && std::all_of(linked_.begin(), linked_.end(), is_known);
  }
  std::size_t bytes() const;

  /// Enters a body that is known by the core from now on, but has no neighbours before it is recertified.
  void enter_core(std::uint32_t number);
  /// The same of a body that others have to find at once.
  void show_in_core(std::uint32_t number) {
    enter_core(number);
    core().show(number);
  }
  /// Returns what is known of pairs that are near. With a core only.
  PairTimes& pair_times() { return known_; }
  const PairTimes& pair_times() const { return known_; }
  /// Makes anew what a snapshot does not contain of a core. Returns false if no core could have been so.
  bool rebuild_core();
  bool uses_core() const { return state_->core.has_value(); }
  /// Goes on without the core. All bodies have to be made dirty.
  void leave_core();

 private:
  // core_host.cpp
  core::Core& core() { return *state_->core; }
  const core::Core& core() const { return *state_->core; }
  Bound extent_of(std::uint32_t number) const;
  void set_kind_in_core(std::uint32_t number);
  void note_rotation(std::uint32_t number);
  void settle_core();
  void note_reports(std::span<const std::uint32_t> numbers);
  void note_link_change(std::uint32_t a, std::uint32_t b);
  double keep_time(std::uint32_t a, std::uint32_t b, const std::optional<double>& until, double end);
  std::span<const std::uint32_t> linked_with(std::uint32_t ball) override;
  std::size_t keep_partners(std::uint32_t ball, std::span<std::uint32_t> others) override;
  double unchanged_until(std::uint32_t a, std::uint32_t b) override;
  Result<double> recheck(std::uint32_t a, std::uint32_t b) override;
  double walls_unchanged_until(std::uint32_t ball) override;
  Result<double> recheck_walls(std::uint32_t ball) override;
  Result<bool> report(std::span<const std::uint32_t> balls, Reason reason) override;
  void note_image(std::uint32_t ball, const Vec3& centre) override;
  Counters& work_counters(std::uint32_t ball) override { return counters_of(ball); }
  /// Where work on a body is counted: that on ghosts is not counted with that on others.
  Counters& counters_of(std::uint32_t number) {
    return uses_core() && core().is_ghost(number) ? of_ghosts_ : work_.counters;
  }

  void open_queue();
  Result<void> recertify_all();
  WindowChoice window_choice() const { return {*state_, time_}; }
  Bodies& bodies() { return state_->bodies; }
  const Bodies& bodies() const { return state_->bodies; }
  ContactGraph& contacts() { return state_->contacts; }
  const ContactGraph& contacts() const { return state_->contacts; }

  void note_probes(std::span<const std::uint32_t> numbers, ProbeCause cause);
  void turn_reported(std::uint32_t number);
  void recertify_changed(std::uint32_t a, std::uint32_t b);
  Result<void> recertify_dirty();
  void recertify(std::span<const std::uint32_t> numbers);
  Result<void> renew(std::uint32_t number);
  void search(std::span<const std::uint32_t> numbers);
  void enter(std::uint32_t number, const Window& window);
  std::span<const std::uint32_t> near(std::uint32_t number, const InflatedBound& bound);

  // speculation_log.cpp
  void note_linked_conflicts(std::uint32_t number);
  void certify_speculatively(std::uint32_t number, std::uint32_t other);

  // rechecks.cpp
  Result<void> recheck(const PairCertificate& pair);
  Result<std::optional<double>> check_pair(std::uint32_t a, std::uint32_t b);
  Result<std::optional<double>> check_walls(std::uint32_t number);
  double note_rates(RelativeLimits& limits, std::initializer_list<std::uint32_t> numbers, double end) const;
  std::optional<double> decide_pair(std::uint32_t a, std::uint32_t b);
  std::optional<double> decide_walls(std::uint32_t number);
  template <class Partner, class EventNow>
  std::optional<double> decide(const ContactPredictor<Partner>& predictor, const Threshold& threshold,
                               const RelativeLimits& limits, Counters& work, EventNow event_now);
  template <class Partner>
  double defer(const ContactPredictor<Partner>& predictor, const Threshold& threshold, const Event& current,
               const RelativeLimits& limits, Counters& work);
  Result<void> probe_stale_of(std::uint32_t a, std::uint32_t b);
  Sphere sphere(std::uint32_t number) const { return sphere_at(bodies(), time_, number); }
  Event contact(EventKind kind, std::uint32_t a, std::uint32_t b) const;
  Event wall_contact(EventKind kind, std::uint32_t number, Wall wall) const;
  Senses senses_in(const Event& event) const;

  WorldState* state_;
  double time_;
  double epoch_end_ = infinity;
  double next_slice_ = infinity;
  CertificateQueue queue_;
  PendingEvents events_;
  DirtyList dirty_;
  bool gathering_ = false;
  Pace pace_;
  WorkCounters work_;
  Counters of_ghosts_;
  Reports reports_;
  PairTimes known_;                    ///< with a core: of pairs that are near
  std::vector<std::uint32_t> linked_;  ///< with a core: bodies whose contacts have changed
  SpeculationLog* log_ = nullptr;      ///< nullptr for the processor with all bodies
  // Members only to reuse their memory.
  std::vector<std::uint32_t> round_, partners_;
  std::vector<InflatedBound> entered_;  ///< bounds with which the bodies of the next search() entered
  SearchResults found_;
};

}  // namespace kinesphere
