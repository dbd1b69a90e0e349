// The engine behind World: the clock, windows, and what the caller changes. What must always hold of any two
// bodies stands in island.hpp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/activity.hpp"
#include "engine/island.hpp"
#include "engine/islands.hpp"
#include "engine/pacing.hpp"
#include "engine/tables.hpp"
#include "kinesphere/shape.hpp"
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

  // Changes (changes.cpp). Their input has been checked.
  void reserve(std::size_t bodies);
  BodyId add(const BodyDefinition& definition);
  BodyId add_fixed(const FixedDefinition& definition);
  void remove(BodyId id);
  void set_velocity(BodyId id, const Vec3& velocity) { everybody_.kick(id.index, velocity); }
  void teleport(BodyId id, const State& state);
  void set_radius(BodyId id, double radius);
  void set_motion_limits(BodyId id, const MotionLimits& promise);
  void disable(BodyId id);
  void enable(BodyId id, const State& state);
  void rest(BodyId id) { everybody_.rest(id.index); }
  void wake_up(BodyId id) {
    if (bodies()[id.index].is_resting()) everybody_.wake(id.index);
  }
  void set_filter(BodyId id, const Filter& filter);
  void set_pair_filter(PairFilter filter);
  void refilter(BodyId id);
  void set_solid(BodyId id, bool solid);
  void set_sensor(SensorClass sensor_class, const Sensor& sensor);
  void set_sensor_class(BodyId id, SensorClass sensor_class);
  void set_user_data(BodyId id, std::uint64_t data) { tables_.bodies[id.index].user_data = data; }

  // What is known at the current time.
  const Bodies& bodies() const { return tables_.bodies; }
  const ContactBook& book() const { return tables_.book; }
  const Windows& windows() const { return tables_.windows; }
  const Island& everybody() const { return everybody_; }
  const WorldDefinition& definition() const { return bodies().definition(); }
  const Counters& counters() const { return everybody_.counters(); }
  BodyView view(std::uint32_t number) const;
  /// Contains the body, and all that it senses, from now until its window ends.
  Box box(std::uint32_t number) const { return windows().box_of(number, time()); }
  /// About the size of the smallest bodies (length).
  double finest_length() const;
  class Answers;
  class Queries;
  std::optional<AuditFinding> audit() const;
  Memory memory() const;
  std::vector<Certificate> certificates() const;
  Result<bool> probe_stale(std::span<const std::uint32_t> numbers, const Probe& ask, std::string_view call);

  // overlaps.cpp: bodies that certainly overlap by more than the tolerance now, wherever in their bounds they
  // are.
  /// The first other body that certainly overlaps body `id` with this extent and definition, and may touch
  /// it.
  std::optional<BodyId> certain_overlap(BodyId id, const Extent& extent,
                                        const BodyDefinition& definition) const;
  std::optional<Wall> certain_overlap_of_wall(const Bound& bound) const;
  /// The first of new bodies that certainly overlaps one before it, and may touch it: as the second of a
  /// pair, beside the first that it overlaps. Cost: a search for each.
  std::optional<std::pair<std::size_t, std::size_t>> first_overlap(
      std::span<const BodyDefinition> added) const;
  /// Where a body with this definition would be now.
  Bound bound_now(const BodyDefinition& body) const;
  /// The body's bound, if its radius and errors were those of `changed`.
  Bound bound_with(BodyId id, const BodyDefinition& changed) const;

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

  // changes.cpp
  void appear(std::uint32_t number, const Bound& bound);
  void withdraw(std::uint32_t number);
  void replace(std::uint32_t number, const Bound& bound);
  void end_contacts(std::uint32_t number, const std::function<bool(const Event&)>& ends);
  bool may_hold(const Event& event) const;

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
