// The engine behind World: what it keeps, and what must always hold.
//
// For every pair of living bodies one of these facts holds whenever time moves on:
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
// whose window has ended. A fixed body has a shape in a table of its own and a capsule for ever; it is never
// probed. A body that rests has a bound that stands still (rest.cpp), and is otherwise like any other.
//
// Where space repeats, the image in which two bodies can meet is the one in which the middles of their
// capsules are nearest (space/space.hpp). A body's bound is in one image: reports are moved to that nearest
// to the bound, and a new capsule brings both home to the primary box. Of fixed bodies there are only balls
// there, which are bounds at rest.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "bound/encounter.hpp"
#include "contact/contact_book.hpp"
#include "contact/outlook.hpp"
#include "contact/sensor_table.hpp"
#include "kinesphere/shape.hpp"
#include "kinesphere/world.hpp"
#include "space/space.hpp"
#include "window/agenda.hpp"
#include "window/windows.hpp"
#include "world/activity.hpp"
#include "world/body.hpp"
#include "world/extent.hpp"

namespace kinesphere {

class World::Engine {
 public:
  explicit Engine(const WorldDefinition& definition);

  void reserve(std::size_t bodies);
  // Changes. Their input has been checked.
  BodyId add(const BodyDefinition& definition);
  BodyId add_fixed(const FixedDefinition& definition);
  void remove(BodyId id);
  void set_velocity(BodyId id, const Vec3& velocity);
  Result<std::optional<Event>> advance(double until, const Probe& probe);
  // changes.cpp: further ones.
  void teleport(BodyId id, const State& state);
  void set_radius(BodyId id, double radius);
  void set_motion_limits(BodyId id, const MotionLimits& promise);
  void disable(BodyId id);
  void enable(BodyId id, const State& state);
  void set_filter(BodyId id, const Filter& filter);
  void set_pair_filter(PairFilter filter);
  void refilter(BodyId id);
  void set_solid(BodyId id, bool solid);
  void set_sensor(SensorClass sensor_class, const Sensor& sensor);
  void set_sensor_class(BodyId id, SensorClass sensor_class);
  // rest.cpp: bodies that rest until something wakes them.
  void rest(BodyId id);
  void wake_up(BodyId id) {
    if (bodies_[id.index].is_resting()) wake_island(id.index);
  }
  void set_user_data(BodyId id, std::uint64_t data) { bodies_[id.index].user_data = data; }

  double time() const { return time_; }
  std::size_t size() const { return size_; }
  const WorldDefinition& definition() const { return definition_; }
  const Counters& counters() const { return counters_; }
  const std::vector<Body>& table() const { return bodies_; }
  bool is_alive(BodyId id) const {
    return id.index < bodies_.size() && bodies_[id.index].alive &&
           bodies_[id.index].generation == id.generation;
  }
  /// Of BodyId::world.
  std::uint32_t tag() const { return tag_; }
  BodyId id_of(std::uint32_t number) const { return {number, bodies_[number].generation, tag_}; }
  Activity activity() const {
    if (probing_) return Activity::probing;
    return pair_filter_ && FilterQuestion::is_asked_by(this) ? Activity::filtering : Activity::idle;
  }
  /// The ids that the next bodies added will have, in their order.
  BodyId next_id(std::size_t additions_before = 0) const;
  BodyView view(std::uint32_t number) const;
  /// With the state of the last report, and with all changes since.
  BodyDefinition definition_of(std::uint32_t number) const;
  const Change* change_since_report(std::uint32_t number) const {
    const std::uint32_t change = bodies_[number].change_number;
    return change == Body::none ? nullptr : &changes_[change];
  }
  const Filter& filter_of(std::uint32_t number) const {
    static constexpr Filter none{};
    return number < filters_.size() ? filters_[number] : none;
  }
  /// Contains the body, and all that it senses, from now until its window ends.
  Box box(std::uint32_t number) const { return windows_.box_of(number, time_); }
  const Space& space() const { return space_; }
  /// All that may be in a box now, by number. Cost: a search, and those that were added or changed since the
  /// last advance.
  std::vector<std::uint32_t> bodies_in(const Box& box) const;
  std::size_t present_count() const;
  /// About the size of the smallest bodies (length).
  double finest_length() const {
    return std::clamp(windows_.least_width(), definition_.contact_tolerance,
                      0x1p30 * definition_.contact_tolerance);
  }
  /// Where a body with this definition would be now.
  Bound bound_now(const BodyDefinition& body) const;
  /// The body's bound, if its radius and errors were those of `changed`.
  Bound bound_with(BodyId id, const BodyDefinition& changed) const;
  Box box_now(const Bound& bound) const { return space_.within(swept_box(bound, time_, time_)); }
  Box box_of(const Shape& shape) const;
  Box box_of_fixed(std::uint32_t number) const;
  /// What the body takes up, or would with another bound.
  Extent extent(std::uint32_t number) const { return extent(number, bodies_[number].bound); }
  Extent extent(std::uint32_t number, const Bound& bound) const {
    if (!bodies_[number].is_fixed()) return {bound};
    return extent_of(bound, shapes_[bodies_[number].shape_number]);
  }
  /// visit_extents() of two bodies as they are, in the image in which they may meet before the window of
  /// either ends; in most worlds nothing is fixed and space does not repeat.
  template <class Visit>
  auto visit_pair(std::uint32_t a, std::uint32_t b, Visit visit) const {
    if (space_.repeats()) return visit(bodies_[a].bound, seen_from(a, b));
    if (shapes_.empty()) return visit(bodies_[a].bound, bodies_[b].bound);
    return visit_extents(extent(a), extent(b), visit);
  }
  /// A shape that has been checked: the normal of a half-space made exactly as long as doubles allow, a ball
  /// moved into the box where space repeats, a box without ends in z in the plane.
  Shape as_kept(Shape shape) const;
  static Extent extent_of(const Bound& bound, const Shape& shape) {
    return {bound, true, std::holds_alternative<Ball>(shape) ? nullptr : &shape};
  }
  FixedDefinition fixed_definition(BodyId id) const {
    const Body& body = bodies_[id.index];
    return {shape(id.index), filter_of(id.index), body.solid, body.sensor_class, body.user_data};
  }
  const Shape& shape(std::uint32_t number) const { return shapes_[bodies_[number].shape_number]; }
  /// Whether the two overlap by more than the tolerance now, whatever the bodies do within them.
  bool certainly_overlap(const Extent& a, const Extent& b) const;
  std::optional<Wall> certain_overlap_of_wall(const Bound& bound) const;
  /// The first other body that certainly overlaps body `id` with this extent and definition, and may touch
  /// it.
  std::optional<BodyId> certain_overlap(BodyId id, const Extent& extent,
                                        const BodyDefinition& definition) const;
  /// The first of new bodies that certainly overlaps one before it, and may touch it: as the second of a
  /// pair, beside the first that it overlaps. Cost: a search for each.
  std::optional<std::pair<std::size_t, std::size_t>> first_overlap(
      std::span<const BodyDefinition> bodies) const;
  /// Whether the filters, and the predicate, let two bodies touch or sense each other.
  bool may_meet(BodyId a, const Filter& filter_a, BodyId b, const Filter& filter_b) const {
    return passes(filter_a, filter_b) && (!pair_filter_ || lets_meet(a, b));
  }
  bool may_touch(BodyId a, const BodyDefinition& body_a, BodyId b, const BodyDefinition& body_b) const {
    return body_a.solid && body_b.solid && may_meet(a, body_a.filter, b, body_b.filter);
  }
  const SensorTable& sensors() const { return sensors_; }
  Sensing sensing_of(std::uint32_t number) const {
    return {bodies_[number].sensor_class, filter_of(number).category};
  }
  const ContactBook& book() const { return book_; }
  std::optional<AuditFinding> audit() const;
  // inspection.cpp
  Memory memory() const;
  std::vector<Certificate> certificates() const;
  const Windows& windows() const { return windows_; }

  // What is known at the current time.
  class Answers;
  class Queries;
  Result<bool> probe_stale(std::span<const std::uint32_t> numbers, const Probe& ask, std::string_view call);
  // snapshot.cpp: the whole state as bytes.
  std::vector<std::byte> save() const;
  static Result<std::unique_ptr<Engine>> restore(std::span<const std::byte> bytes, PairFilter pair_filter);
  bool has_pair_filter() const { return static_cast<bool>(pair_filter_); }

 private:
  class Audit;
  class StillDue;

  // engine.cpp: the clock.
  void move_on_to(double time);
  Result<void> gather();
  Result<void> settle_all();
  std::uint32_t take_number();
  void appear(std::uint32_t number, const Bound& bound);
  void withdraw(std::uint32_t number);
  void mark_dirty(std::uint32_t number);
  void void_facts(std::uint32_t number);

  // changes.cpp
  void replace(std::uint32_t number, const Bound& bound);
  void keep(std::uint32_t number, const BodyDefinition& definition);
  void keep_filter(std::uint32_t number, const Filter& filter);
  Change& change_of(std::uint32_t number);
  void forget_change(std::uint32_t number);
  bool may_meet(std::uint32_t a, std::uint32_t b) const {
    return !filtering_ || (!(bodies_[a].is_fixed() && bodies_[b].is_fixed()) &&
                           may_meet(id_of(a), filter_of(a), id_of(b), filter_of(b)));
  }
  bool may_touch(std::uint32_t a, std::uint32_t b) const {
    return bodies_[a].solid && bodies_[b].solid && may_meet(a, b);
  }
  bool may_hold(const Event& event) const;

  // rest.cpp
  void stand_still(Body& body) const;
  void forget_rest(std::uint32_t number);
  void resume(std::uint32_t number);
  void rouse(std::uint32_t number);
  void wake_island(std::uint32_t number);
  void wake_by(const Event& event);
  std::vector<std::uint32_t> resting_in_touch(std::uint32_t number) const;
  bool lets_meet(BodyId a, BodyId b) const;

  /// The limits of the gap of the two now, in the image in which they are nearest.
  GapLimits gap_now(const Extent& a, const Extent& b) const;

  /// More than what rounding does to positions and ways, which are at most 2^45 contact tolerances; and so
  /// much less than a tolerance that a certificate for two bodies that are not near spans most of it.
  double rounding_room() const { return definition_.contact_tolerance / 16.0; }
  /// How far the gap of the two can be from one that means something: no sensor distance of either is larger.
  double reach_of_pair(const Body& a, const Body& b) const;

  // starting.cpp: windows, and the hot pairs in them.
  Result<void> start_windows(bool all, std::span<const std::uint32_t> joining = {});
  Result<void> settle_dirty();
  void enter(std::uint32_t number);
  double sensor_reach(const Body& body) const {
    return sensors_.any() ? sensors_.reach(body.sensor_class) : 0.0;
  }
  void settle_changed(std::uint32_t a, std::uint32_t b);
  Pace pace_of(const Body& body) const;
  /// The place of a body that has gone farther since its last report could not be computed well (length).
  double longest_way() const { return 0x1p40 * definition_.contact_tolerance; }
  void choose_tempo(std::span<const std::uint32_t> round);
  Window window_for(std::uint32_t number) const;
  Window window_to_start(std::uint32_t number) const;
  bool needs_report(std::uint32_t number) const;
  RoomyBound roomy_bound(std::uint32_t number) const;
  double widest_in_period(const Body& body, int axis) const;
  double longest_in_period(const Body& body, double length) const;
  void bring_home(std::uint32_t number, double length);
  std::size_t find_hot_pairs(std::uint32_t number, std::span<const std::uint32_t> others);
  void find_known_pairs(std::uint32_t number);
  void find_walls(std::uint32_t number);
  Vec3 shift_to_meet(std::uint32_t a, std::uint32_t b) const;
  Bound seen_from(std::uint32_t a, std::uint32_t b) const;
  /// Both stay in their capsules until then.
  double windows_end(std::uint32_t a, std::uint32_t b) const {
    return std::min(windows_.end_of(a), windows_.end_of(b));
  }

  // looking.cpp: pairs that are due.
  HotPair hot_pair(double time, std::uint32_t a, std::uint32_t b) const;
  bool is_void(const HotPair& pair) const;
  /// Those that hold, or those of them that a body has a part in.
  std::vector<HotPair> hot_pairs(std::optional<std::uint32_t> number = std::nullopt) const;
  bool is_linked(std::uint32_t a, std::uint32_t b) const;
  double unchanged_until(std::uint32_t a, std::uint32_t b) const;
  double unchanged_until_by_thresholds(std::uint32_t a, std::uint32_t b) const;
  Result<void> look(const HotPair& pair);
  Result<void> look_at_pair(std::uint32_t a, std::uint32_t b);
  Result<void> look_at_walls(std::uint32_t number);
  std::optional<double> judge_pair(std::uint32_t a, std::uint32_t b);
  std::optional<double> judge_walls(std::uint32_t number);
  template <class Visit>
  void for_each_threshold(std::uint32_t a, std::uint32_t b, Visit visit) const;
  template <class Partner>
  std::optional<double> judge(const Outlook<Partner>& outlook, const Threshold& threshold, Event current,
                              const Promise& promise);

  // probing.cpp: reports.
  Result<void> probe(std::span<const std::uint32_t> numbers);
  Result<void> probe_staler(std::uint32_t a, std::uint32_t b);
  void apply_report(std::uint32_t number, const State& answer);

  // contacts.cpp: events.
  Sphere sphere(std::uint32_t number) const;
  Event contact(EventKind kind, std::uint32_t a, std::uint32_t b) const;
  Event wall_contact(EventKind kind, std::uint32_t number, Wall wall) const;
  Senses senses_in(const Event& event) const;
  std::optional<Event> deliver();

  // snapshot.cpp.
  template <class Self, class Archive>
  static void transfer(Self& self, Archive& archive);
  const char* contradiction() const;
  bool bodies_are_sound() const;
  bool agenda_is_sound() const;
  bool shapes_are_sound() const;
  bool is_sound(std::uint32_t number) const;
  bool changes_are_sound() const;
  bool rests_are_sound() const;
  bool contacts_of_fixed_are_sound() const;
  bool is_sound_fixed(std::uint32_t number) const;
  bool image_is_sound(std::uint32_t number) const;
  bool was_given_out(BodyId id) const;

  WorldDefinition definition_;
  std::uint32_t tag_;
  Space space_;
  std::optional<Box> walls_;  ///< as walls_of(definition_)
  ContactBook book_;
  double time_;
  std::size_t size_ = 0;
  std::vector<Body> bodies_;
  std::vector<Change> changes_;
  std::vector<Rest> rests_;
  std::vector<Filter> filters_;  ///< of all bodies up to the last one that has another than the default
  // Where space repeats.
  std::vector<Vec3> middles_;  ///< of the capsules, which tell in which image two bodies can meet
  /// Whole numbers: bound.position + image * period is on the path since the caller
  /// placed the body.
  std::vector<Vec3> images_;
  std::vector<std::uint32_t> free_;
  std::vector<Shape> shapes_;  ///< of fixed bodies
  std::vector<std::uint32_t> free_shapes_;
  Windows windows_;
  Tempo tempo_;
  Kicks kicks_;  ///< since most bodies started
  Agenda agenda_;
  std::vector<std::uint32_t> dirty_;
  Counters counters_;
  SensorTable sensors_;
  PairFilter pair_filter_;
  bool filtering_ = false;  ///< not all may touch: filters, a predicate, bodies that are not solid or fixed
  /// Collecting what is due at this instant has begun: if a bad answer interrupts it, the next advance() goes
  /// on with it.
  bool gathering_ = false;
  const Probe* probe_ = nullptr;   ///< during a call that may probe
  std::string_view probing_call_;  ///< its name, for messages
  bool probing_ = false;
  // Kept for their memory only.
  std::vector<BodyId> probe_ids_;
  std::vector<State> probe_states_;
  std::vector<std::uint32_t> round_;
  std::vector<HotPair> hot_;
  Windows::Scratch scratch_;
};

/// What comes next between two bodies that may meet: their contact, the next sensor distance inward, and the
/// next one outward.
template <class Visit>
void World::Engine::for_each_threshold(std::uint32_t a, std::uint32_t b, Visit visit) const {
  if (bodies_[a].solid && bodies_[b].solid) visit(Threshold{.within = book_.touch(a, b)});
  if (!sensors_.any()) return;
  const Crossings::List crossed = book_.crossings_of(a, b);
  if (const auto next = sensors_.next_inward(sensing_of(a), sensing_of(b), crossed))
    visit(Threshold{false, *next, true});
  if (!crossed.empty()) visit(Threshold{true, crossed.back().distance, true});
}

}  // namespace kinesphere
