// The engine behind World: what it keeps, and what must always hold.
//
// For every pair of living bodies one of these facts is recorded whenever time moves on:
//   - their boxes do not overlap, and each body stays in its box until its box_end; or
//   - one of the two watches the other: whether they touch cannot change before the watch's time; or
//   - both are apart until the earlier of the two box ends.
// A fact is about the true bodies, so later probes leave it true. Only a discontinuity (a kick, a broken
// promise, a removal) ends it: it raises the body's epoch, which voids the watches that others keep of it,
// and makes the body dirty. A dirty body gets a new box and looks for its neighbours again before time moves
// on; so does a body whose box has run out, which renews the first and the last kind of fact. Each body is
// scheduled at the earliest of its box end, its wall time and its watches.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "contact/contact_book.hpp"
#include "contact/outlook.hpp"
#include "kinesphere/world.hpp"
#include "schedule/schedule.hpp"
#include "space/hash_grid.hpp"
#include "world/horizon.hpp"

namespace kinesphere {

/// Whether the two touch cannot change before `time`, as long as the partner's epoch is still `epoch`.
struct Watch {
  double time;
  std::uint32_t partner;
  std::uint32_t epoch;
};

struct Body {
  BodyDefinition definition;  ///< with the state of the last report
  Bound bound;                ///< since the last report
  Box box;                    ///< contains the body until box_end
  double box_end = 0.0;
  double wall_time = 0.0;  ///< no wall contact begins or ends before this or, if it is infinite, box_end
  std::optional<Horizon> horizon;
  std::vector<Watch> watches;
  std::uint32_t generation = 0;
  std::uint32_t epoch = 0;
  bool alive = false;
  bool dirty = false;     ///< in the list of those to settle before time moves on
  bool searched = false;  ///< settled in the present round
  bool kicked_since_report = false;

  bool fresh(double time) const { return bound.time == time; }
  double largest_acceleration() const {
    return definition.acceleration_limit + norm(definition.planned_acceleration);
  }
};

class World::Engine {
 public:
  explicit Engine(const WorldDefinition& definition);

  // Changes. Their input has been checked.
  BodyId add(const BodyDefinition& definition);
  void remove(BodyId id);
  void kick(BodyId id, const Vec3& velocity);
  Result<std::optional<Event>> advance(double until, const Probe& probe);

  double time() const { return time_; }
  std::size_t size() const { return size_; }
  const WorldDefinition& definition() const { return definition_; }
  const Counters& counters() const { return counters_; }
  const std::vector<Body>& table() const { return bodies_; }
  BodyId id_of(std::uint32_t number) const { return {number, bodies_[number].generation}; }
  bool probing() const { return probing_; }
  /// Where a body with this definition would be now.
  Box box_of(const BodyDefinition& body) const;
  /// Whether two bodies with these definitions would overlap by more than the tolerance now.
  bool certainly_overlap(const BodyDefinition& a, const BodyDefinition& b) const;
  /// The first living body that certainly overlaps one with this definition.
  std::optional<BodyId> certain_overlap(const BodyDefinition& definition) const;
  std::optional<AuditFinding> audit() const;

 private:
  class Audit;
  class RoundInProgress;

  Bound bound_now(const BodyDefinition& body) const;
  bool certainly_overlap(const Bound& a, const Bound& b) const;

  // engine.cpp: the clock.
  void move_on_to(double time);
  Result<void> gather();
  Result<void> wake(std::uint32_t number);
  void reschedule(std::uint32_t number);

  // settling.cpp: facts.
  void mark_dirty(std::uint32_t number);
  void void_facts(std::uint32_t number);
  Result<void> settle_all();
  Result<void> settle_round(const std::vector<std::uint32_t>& round);
  void choose_first_horizons(const std::vector<std::uint32_t>& round);
  void register_box(std::uint32_t number);
  Result<void> search(std::uint32_t number);
  Result<void> settle_pair(std::uint32_t number, std::uint32_t partner);
  Result<void> settle_walls(std::uint32_t number);
  bool has_watch(std::uint32_t number, std::uint32_t partner) const;
  void watch(std::uint32_t number, std::uint32_t partner, double time);
  void unwatch(std::uint32_t number, std::uint32_t partner);
  template <class Partner>
  std::optional<double> judge(const Outlook<Partner>& outlook, bool touching, const Event& current,
                              const Promise& promise);

  // probing.cpp: reports.
  Result<void> probe(std::span<const std::uint32_t> numbers);
  Result<void> probe_staler(std::uint32_t a, std::uint32_t b);
  void apply_report(std::uint32_t number, const State& state);

  // contacts.cpp: events.
  Sphere sphere(std::uint32_t number) const;
  Event contact(EventKind kind, std::uint32_t a, std::uint32_t b) const;
  Event wall_contact(EventKind kind, std::uint32_t number, Wall wall) const;
  std::optional<Event> deliver();

  WorldDefinition definition_;
  ContactBook book_;
  double time_;
  std::size_t size_ = 0;
  std::vector<Body> bodies_;
  std::vector<std::uint32_t> free_;
  HashGrid grid_;
  HeapSchedule schedule_;
  std::vector<std::uint32_t> dirty_;
  Counters counters_;
  bool gathering_ = false;        ///< not all of them have been found: a probe gave a bad answer
  const Probe* probe_ = nullptr;  ///< during advance()
  bool probing_ = false;
  // Kept for their memory only.
  std::vector<BodyId> probe_ids_;
  std::vector<State> probe_states_;
  std::vector<std::uint32_t> partners_;
};

}  // namespace kinesphere
