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

#include "contact/instant.hpp"
#include "contact/outlook.hpp"
#include "engine/beside.hpp"
#include "engine/facts.hpp"
#include "engine/pacing.hpp"
#include "engine/reports.hpp"
#include "engine/tables.hpp"
#include "engine/unsettled.hpp"
#include "kinesphere/result.hpp"
#include "number/infinity.hpp"
#include "parallel/crew.hpp"
#include "window/agenda.hpp"

namespace kinesphere {

class alignas(128) Island {
 public:
  Island(Tables& tables, double time) : tables_(&tables), time_(time) {}
  /// The same with a copy of the other's tables.
  Island(Island other, Tables& tables) : Island(std::move(other)) { tables_ = &tables; }

  double time() const { return time_; }
  /// Until somebody takes it away.
  const Work& work() const { return work_; }
  Work& work() { return work_; }
  const Instant& instant() const { return instant_; }
  Instant& instant() { return instant_; }
  const Agenda& agenda() const { return agenda_; }
  Agenda& agenda() { return agenda_; }
  /// Bodies that have to be settled before time moves on. Facts about one that is added stay.
  const Unsettled& unsettled() const { return unsettled_; }
  Unsettled& unsettled() { return unsettled_; }

  /// All facts are as they should be, and nothing is to be delivered.
  bool is_settled() const {
    return !gathering_ && unsettled_.empty() && instant_.is_quiet() && instant_.changed().empty();
  }

  // The clock.
  /// Collecting what is due at this instant has begun: if a bad answer interrupts it, the next call goes on
  /// with it.
  bool is_gathering() const { return gathering_; }
  /// When the next pair is due; +infinity when nothing is.
  double next_time() {
    agenda_.open([facts = facts()](const HotPair& pair) { return facts.is_void(pair); });
    return agenda_.next_time();
  }
  void move_on_to(double time) {
    if (time > time_) instant_.start();
    time_ = time;
  }
  /// The same, to an instant at which something is due.
  void come_to(double time) {
    move_on_to(std::max(time, time_));
    gathering_ = true;
  }
  /// Looks at all pairs that are due, so that every event of this instant is known before the first is
  /// delivered.
  Result<void> gather();
  /// Pairs that delivered events have changed are to be looked at anew, but for those of dirty bodies, which
  /// will be found.
  void settle_changed();
  /// After it, all facts are as they should be.
  Result<void> settle();
  /// The next event of this instant.
  std::optional<Event> deliver();

  /// What the island has to begin with is left to others.
  void leave_unsettled() {
    unsettled_.clear();
    instant_.clear();
    gathering_ = false;
  }

  // Discontinuities.
  /// Nothing that was certified about the body holds any more.
  void void_facts(std::uint32_t number);
  /// The body has another velocity from now on.
  void kick(BodyId body, const Vec3& velocity) { kick(bodies().table().number_of(body), velocity); }
  void kick(std::uint32_t number, const Vec3& velocity);

  /// At this time.
  Facts facts() const { return {*tables_, time_, beside_}; }

  // Reports.
  Reports& reports() { return reports_; }
  const Reports& reports() const { return reports_; }
  Result<void> probe(std::span<const std::uint32_t> numbers);
  /// The same, where several threads may be asked.
  Result<void> probe(std::span<const std::uint32_t> numbers, Shift& shift);
  /// Those of them whose reports are not of this time, except for disabled ones. True when there were any.
  Result<bool> probe_stale(std::span<const std::uint32_t> numbers, Shift& shift);

  /// From now on the island is one of those of a phase, from where its part begins. It begins with pairs that
  /// are due, bodies that have to be settled before anything else, and events that are known already.
  void begin(Beside& beside, std::span<const HotPair> due, std::span<const std::uint32_t> unsettled,
             std::span<const Event> pending);

  // The phase.
  /// All windows that hold a body now end at this time or later; those that end before it, of bodies that
  /// were kicked, are renewed one by one.
  double phase_end() const { return phase_end_; }
  void begin_phase(double end) { phase_end_ = end; }

  /// What a snapshot holds of it: the agenda comes apart.
  template <class Self, class Archive>
  static void transfer(Self& self, Archive& archive) {
    archive(self.instant_, self.time_, self.phase_end_, self.unsettled_, self.gathering_, self.work_.counters,
            self.work_.settled);
  }
  std::size_t bytes() const;

 private:
  class StillDue;
  Pacing pacing() const { return {*tables_, time_}; }
  Bodies& bodies() { return tables_->bodies; }
  const Bodies& bodies() const { return tables_->bodies; }
  ContactBook& book() { return tables_->book; }
  const ContactBook& book() const { return tables_->book; }

  void settle_changed(std::uint32_t a, std::uint32_t b);
  Result<void> settle_dirty();
  void settle(std::span<const std::uint32_t> numbers);
  Result<void> renew(std::uint32_t number);
  void search(std::span<const std::uint32_t> numbers);
  void enter(std::uint32_t number, const Window& window);
  std::span<const std::uint32_t> near(std::uint32_t number);

  // beside.cpp
  void claim_linked(std::uint32_t number);
  void find_hot_pair_beside(std::uint32_t number, std::uint32_t other);

  // looking.cpp
  Result<void> look(const HotPair& pair);
  Result<void> look_at_pair(std::uint32_t a, std::uint32_t b);
  Result<void> look_at_walls(std::uint32_t number);
  std::optional<double> judge_pair(std::uint32_t a, std::uint32_t b);
  std::optional<double> judge_walls(std::uint32_t number);
  template <class Partner>
  std::optional<double> judge(const Outlook<Partner>& outlook, const Threshold& threshold, Event current,
                              const Promise& promise);
  Result<void> probe_staler(std::uint32_t a, std::uint32_t b);
  Sphere sphere(std::uint32_t number) const { return sphere_at(bodies(), time_, number); }
  Event contact(EventKind kind, std::uint32_t a, std::uint32_t b) const;
  Event wall_contact(EventKind kind, std::uint32_t number, Wall wall) const;
  Senses senses_in(const Event& event) const;

  Tables* tables_;
  double time_;
  double phase_end_ = infinity;
  Agenda agenda_;
  Instant instant_;
  Unsettled unsettled_;
  bool gathering_ = false;
  Work work_;
  Reports reports_;
  Beside* beside_ = nullptr;  ///< unless it has all bodies
  // Kept for their memory only.
  std::vector<std::uint32_t> round_;
  FoundPairs found_;
};

}  // namespace kinesphere
