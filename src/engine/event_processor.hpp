// An island: bodies on their way through a window of time in which they meet nobody else.
//
// The loop over World::advance() has one island, all bodies; World::run() has many, side by side. An island
// has a clock, an agenda and the events of its present instant, and looks at the pairs that are due.
//
// For every pair of bodies one of these facts holds whenever its time moves on:
//   - their capsules do not touch before the window of either ends, and each body stays in its capsule until
//     its own window ends; or
//   - they cannot change between touching and not touching, nor cross a sensor distance, before the window of
//     either ends; or
//   - they cannot do so before the time of a hot pair in the agenda; or
//   - the filters keep them from touching and sensing each other.
// A capsule has room for all that its body can sense around it. A fact is about the true bodies, so later
// probes leave it true. Only a discontinuity (a kick, a broken promise, a change that the caller makes) ends
// it: the body gets another stamp, which voids its hot pairs, and becomes dirty. A dirty body gets a capsule
// and its hot pairs anew before time moves on (a disabled one has left the windows instead); so do all bodies
// whose window has ended.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "broadphase/certificate_queue.hpp"
#include "contact/contact_predictor.hpp"
#include "contact/pending_events.hpp"
#include "engine/dirty_list.hpp"
#include "engine/pair_certifier.hpp"
#include "engine/reports.hpp"
#include "engine/speculation_log.hpp"
#include "engine/window_choice.hpp"
#include "engine/world_state.hpp"
#include "kinesphere/result.hpp"
#include "number/infinity.hpp"
#include "parallel/thread_pool.hpp"

namespace kinesphere {

class alignas(128) EventProcessor {
 public:
  EventProcessor(WorldState& tables, double time) : state_(&tables), time_(time) {}
  /// The same with a copy of the other's tables.
  EventProcessor(EventProcessor other, WorldState& tables) : EventProcessor(std::move(other)) {
    state_ = &tables;
  }

  double time() const { return time_; }
  /// Until somebody takes it away.
  const WorkCounters& work() const { return work_; }
  WorkCounters& work() { return work_; }
  const PendingEvents& events() const { return events_; }
  PendingEvents& events() { return events_; }
  const CertificateQueue& queue() const { return queue_; }
  CertificateQueue& queue() { return queue_; }
  /// Bodies that have to be settled before time moves on. Facts about one that is added stay.
  const DirtyList& dirty() const { return dirty_; }
  DirtyList& dirty() { return dirty_; }

  /// All facts are as they should be, and nothing is to be delivered.
  bool is_certified() const {
    return !gathering_ && dirty_.empty() && events_.is_quiet() && events_.changed().empty();
  }

  // The clock.
  /// Collecting what is due at this instant has begun: if a bad answer interrupts it, the next call goes on
  /// with it.
  bool is_gathering() const { return gathering_; }
  /// When the next pair is due; +infinity when nothing is.
  double next_time() {
    queue_.open([facts = certifier()](const PairCertificate& pair) { return facts.is_stale(pair); });
    return queue_.next_time();
  }
  void advance_clock(double time) {
    if (time > time_) events_.start();
    time_ = time;
  }
  /// The same, to an instant at which something is due.
  void begin_instant(double time) {
    advance_clock(std::max(time, time_));
    gathering_ = true;
  }
  /// Looks at all pairs that are due, so that every event of this instant is known before the first is
  /// delivered.
  Result<void> gather();
  /// Pairs that delivered events have changed are to be looked at anew, but for those of dirty bodies, which
  /// will be found.
  void recertify_changed();
  /// After it, all facts are as they should be.
  Result<void> recertify();
  /// The next event of this instant.
  std::optional<Event> pop();

  /// What the island has to begin with is left to others.
  void discard_initial_work() {
    dirty_.clear();
    events_.clear();
    gathering_ = false;
  }

  // Discontinuities.
  /// Nothing that was certified about the body holds any more.
  void invalidate(std::uint32_t number);
  /// The body has another velocity from now on.
  void set_velocity(BodyId body, const Vec3& velocity) {
    set_velocity(bodies().table().number_of(body), velocity);
  }
  void set_velocity(std::uint32_t number, const Vec3& velocity);

  /// At this time.
  PairCertifier certifier() const { return {*state_, time_, log_}; }

  // Reports.
  Reports& reports() { return reports_; }
  const Reports& reports() const { return reports_; }
  Result<void> probe(std::span<const std::uint32_t> numbers);
  /// The same, where several threads may be asked.
  Result<void> probe(std::span<const std::uint32_t> numbers, PoolLease& shift);
  /// Those of them whose reports are not of this time, except for disabled ones. True when there were any.
  Result<bool> probe_stale(std::span<const std::uint32_t> numbers, PoolLease& shift);

  /// From now on the island is one of those of a phase, from where its part begins. It begins with pairs that
  /// are due, bodies that have to be settled before anything else, and events that are known already.
  void begin(SpeculationLog& log, std::span<const PairCertificate> due,
             std::span<const std::uint32_t> unsettled, std::span<const Event> pending);

  // The phase.
  /// All windows that hold a body now end at this time or later; those that end before it, of bodies that
  /// were kicked, are renewed one by one.
  double epoch_end() const { return epoch_end_; }
  void begin_epoch(double end) { epoch_end_ = end; }

  /// What a snapshot holds of it: the agenda comes apart.
  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    archive(self.events_, self.time_, self.epoch_end_, self.dirty_, self.gathering_, self.work_.counters,
            self.work_.recertified);
  }
  std::size_t bytes() const;

 private:
  class RequeueGuard;
  WindowChoice window_choice() const { return {*state_, time_}; }
  Bodies& bodies() { return state_->bodies; }
  const Bodies& bodies() const { return state_->bodies; }
  ContactGraph& contacts() { return state_->contacts; }
  const ContactGraph& contacts() const { return state_->contacts; }

  void recertify_changed(std::uint32_t a, std::uint32_t b);
  Result<void> recertify_dirty();
  void recertify(std::span<const std::uint32_t> numbers);
  Result<void> renew(std::uint32_t number);
  void search(std::span<const std::uint32_t> numbers);
  void enter(std::uint32_t number, const Window& window);
  std::span<const std::uint32_t> near(std::uint32_t number);

  // beside.cpp
  void note_linked_conflicts(std::uint32_t number);
  void certify_speculatively(std::uint32_t number, std::uint32_t other);

  // looking.cpp
  Result<void> recheck(const PairCertificate& pair);
  Result<void> recheck_pair(std::uint32_t a, std::uint32_t b);
  Result<void> recheck_walls(std::uint32_t number);
  std::optional<double> decide_pair(std::uint32_t a, std::uint32_t b);
  std::optional<double> decide_walls(std::uint32_t number);
  template <class Partner>
  std::optional<double> decide(const ContactPredictor<Partner>& predictor, const Threshold& threshold,
                               Event current, const RelativeLimits& promise);
  Result<void> probe_staler(std::uint32_t a, std::uint32_t b);
  Sphere sphere(std::uint32_t number) const { return sphere_at(bodies(), time_, number); }
  Event contact(EventKind kind, std::uint32_t a, std::uint32_t b) const;
  Event wall_contact(EventKind kind, std::uint32_t number, Wall wall) const;
  Senses senses_in(const Event& event) const;

  WorldState* state_;
  double time_;
  double epoch_end_ = infinity;
  CertificateQueue queue_;
  PendingEvents events_;
  DirtyList dirty_;
  bool gathering_ = false;
  WorkCounters work_;
  Reports reports_;
  SpeculationLog* log_ = nullptr;  ///< unless it has all bodies
  // Kept for their memory only.
  std::vector<std::uint32_t> round_;
  SearchResults found_;
};

}  // namespace kinesphere
