// The bodies of a world, and all that is kept of them: promises and reports, shapes, filters, sensors, rests.
//
// A fixed body has a shape in a table of its own; it is never probed. A body that rests has a bound that
// stands still, and is otherwise like any other; what it promises once it is awake waits in a table.
//
// Where space repeats, the image in which two bodies can meet is the one in which the middles of their
// capsules are nearest (space/space.hpp). A body's bound is in one image: reports are moved to that nearest
// to the bound, and a new capsule brings both home to the primary box. Of fixed bodies there are only balls
// there, which are bounds at rest.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "bound/encounter.hpp"
#include "contact/contact_event.hpp"
#include "contact/sensor_table.hpp"
#include "engine/activity.hpp"
#include "engine/body.hpp"
#include "engine/extent.hpp"
#include "kinesphere/filter.hpp"
#include "kinesphere/shape.hpp"
#include "kinesphere/world_definition.hpp"
#include "space/space.hpp"
#include "window/windows.hpp"

namespace kinesphere {

class Bodies {
  /// Of a body, where space repeats.
  struct Home {
    Vec3 middle{};  ///< of its capsule, which tells in which image it can meet others
    /// Whole numbers: bound.position + image * period is on the path since the caller placed the body.
    Vec3 image{};

    template <class Self, class Archive>
    static void transfer(Self& self, Archive& archive) {
      auto& [of_capsule, images] = self;
      archive(of_capsule, images);
    }
  };

 public:
  explicit Bodies(const WorldDefinition& definition);

  const WorldDefinition& definition() const { return definition_; }
  const Space& space() const { return space_; }
  /// As walls_of(definition()).
  const std::optional<Box>& walls() const { return walls_; }
  /// The sum of what all worlds of this program that were made before count: of BodyId::world.
  std::uint32_t tag() const { return tag_; }

  // The table.
  const std::vector<Body>& table() const { return table_; }
  Body& operator[](std::uint32_t number) { return table_[number]; }
  const Body& operator[](std::uint32_t number) const { return table_[number]; }
  /// All numbers are smaller than this.
  std::uint32_t numbers() const { return static_cast<std::uint32_t>(table_.size()); }
  /// That live.
  std::size_t size() const { return size_; }
  /// That live and are enabled. Cost: O(n).
  std::size_t present_count() const;
  void reserve(std::size_t bodies);
  /// A body that lives and has nothing else yet: its number.
  std::uint32_t take_number();
  void give_back(std::uint32_t number);
  bool is_alive(BodyId id) const {
    return id.index < table_.size() && table_[id.index].alive && table_[id.index].generation == id.generation;
  }
  BodyId id_of(std::uint32_t number) const { return {number, table_[number].generation, tag_}; }
  /// The ids that the next bodies added will have, in their order.
  BodyId next_id(std::size_t additions_before = 0) const;

  // What they promise, and what was reported of them.
  /// All but its state and its promise.
  void keep(std::uint32_t number, const BodyDefinition& definition);
  /// With the state of the last report, and with all changes since.
  BodyDefinition definition_of(std::uint32_t number) const;
  /// Of a body that has one: what has changed since its last report.
  const Change* change_since_report(std::uint32_t number) const {
    const std::uint32_t change = table_[number].change_number;
    return change == Body::none ? nullptr : &changes_[change];
  }
  /// The change of the body, to be made or added to.
  Change& change_of(std::uint32_t number);
  /// It is in force, or the body has gone.
  void forget_change(std::uint32_t number);
  bool has_changes() const { return !changes_.empty(); }

  /// A body as it is, to be put back as it was; without changes since its report.
  struct Kept {
    Body body;
    Home home;
  };
  Kept keep(std::uint32_t number) const {
    return {table_[number], space_.repeats() ? homes_[number] : Home{}};
  }
  void put_back(std::uint32_t number, const Kept& kept) {
    table_[number] = kept.body;
    if (space_.repeats()) homes_[number] = kept.home;
  }

  // Those that rest (rest.cpp).
  bool any_rests() const { return !rests_.empty(); }
  void start_rest(std::uint32_t number, const MotionLimits& awake);
  void forget_rest(std::uint32_t number);

  // Fixed ones (fixed.cpp).
  bool any_fixed() const { return shapes_.size() > free_shapes_.size(); }
  void keep_shape(std::uint32_t number, const Shape& shape);
  const Shape& shape(std::uint32_t number) const { return shapes_[table_[number].shape_number]; }
  FixedDefinition fixed_definition(BodyId id) const;
  /// Of a shape, cut off where no body comes.
  Box box_of(const Shape& shape) const;
  /// Of a fixed body, with room for all that it senses around it.
  Box box_of_fixed(std::uint32_t number) const;
  /// What the body takes up, or would with another bound.
  Extent extent(std::uint32_t number) const { return extent(number, table_[number].bound); }
  Extent extent(std::uint32_t number, const Bound& bound) const {
    if (!table_[number].is_fixed()) return {bound};
    return extent_of(bound, shapes_[table_[number].shape_number]);
  }
  static Extent extent_of(const Bound& bound, const Shape& shape) {
    return {bound, true, std::holds_alternative<Ball>(shape) ? nullptr : &shape};
  }
  /// visit_extents() of two bodies as they are, in the image in which they may meet before the window of
  /// either ends; in most worlds nothing is fixed and space does not repeat.
  template <class Visit>
  auto visit_pair(std::uint32_t a, std::uint32_t b, Visit visit) const {
    if (space_.repeats()) return visit(table_[a].bound, seen_from(a, b));
    if (shapes_.empty()) return visit(table_[a].bound, table_[b].bound);
    return visit_extents(extent(a), extent(b), visit);
  }
  /// The limits of the gap of the two now, in the image in which they are nearest.
  GapLimits gap_at(double now, const Extent& a, const Extent& b) const;
  /// As events tell of it.
  Sphere sphere_at(double now, std::uint32_t number) const;

  // Who may touch or sense whom.
  /// Not all may touch: filters, a predicate, bodies that are not solid or fixed.
  bool are_filtered() const { return filtering_; }
  const Filter& filter_of(std::uint32_t number) const {
    static constexpr Filter none{};
    return number < filters_.size() ? filters_[number] : none;
  }
  void keep_filter(std::uint32_t number, const Filter& filter);
  void keep_solid(std::uint32_t number, bool solid);
  void keep_pair_filter(PairFilter filter);
  bool has_pair_filter() const { return static_cast<bool>(pair_filter_); }
  /// Whether this thread is in the pair filter.
  bool is_filtering() const { return pair_filter_ && FilterQuestion::is_asked_by(this); }
  /// Whether the filters, and the predicate, let two bodies touch or sense each other.
  bool may_meet(BodyId a, const Filter& filter_a, BodyId b, const Filter& filter_b) const {
    return passes(filter_a, filter_b) && (!pair_filter_ || lets_meet(a, b));
  }
  bool may_meet(std::uint32_t a, std::uint32_t b) const {
    return !filtering_ || (!(table_[a].is_fixed() && table_[b].is_fixed()) &&
                           may_meet(id_of(a), filter_of(a), id_of(b), filter_of(b)));
  }
  bool may_touch(std::uint32_t a, std::uint32_t b) const {
    return table_[a].solid && table_[b].solid && may_meet(a, b);
  }
  bool may_touch(BodyId a, const BodyDefinition& body_a, BodyId b, const BodyDefinition& body_b) const {
    return body_a.solid && body_b.solid && may_meet(a, body_a.filter, b, body_b.filter);
  }
  SensorTable& sensors() { return sensors_; }
  const SensorTable& sensors() const { return sensors_; }
  Sensing sensing_of(std::uint32_t number) const {
    return {table_[number].sensor_class, filter_of(number).category};
  }
  double sensor_reach(std::uint32_t number) const {
    return sensors_.any() ? sensors_.reach(table_[number].sensor_class) : 0.0;
  }
  /// How far the gap of the two can be from one that means something: no sensor distance of either is larger.
  double reach_of_pair(std::uint32_t a, std::uint32_t b) const {
    return sensors_.any() ? std::max(sensor_reach(a), sensor_reach(b)) : 0.0;
  }

  // What windows have to know of them.
  /// With room for all that the body can touch or sense.
  RoomyBound roomy_bound(std::uint32_t number, double now) const;
  /// The same for another bound of a body that can move.
  RoomyBound room_for(std::uint32_t number, const MovedBound& bound) const {
    return {bound, sensor_reach(number) + definition_.contact_tolerance};
  }
  Pace pace_of(std::uint32_t number, double now) const {
    return pace_of(MovedBound(table_[number].bound, now));
  }
  static Pace pace_of(const MovedBound& moved) {
    return {norm(moved.velocity) + moved.speed, moved.growth + norm(moved.acceleration)};
  }
  /// The place of a body that has gone farther since its last report could not be computed well (length).
  double longest_way() const { return 0x1p40 * definition_.contact_tolerance; }
  /// More than what rounding does to positions and ways, which are at most 2^45 contact tolerances; and so
  /// much less than a tolerance that a certificate for two bodies that are not near spans most of it.
  double rounding_room() const { return definition_.contact_tolerance / 16.0; }

  // Where space repeats.
  /// How long a window of a body may last, `length` at most, for the box around its way to be as narrow as
  /// space/space.hpp (2) wants it.
  double longest_in_period(std::uint32_t number, double now, double length, double release_gap) const;
  /// Moves the body to the image in which the middle of its way for this long lies in the primary box.
  void bring_home(std::uint32_t number, double now, double length);
  /// The caller has placed the body anew: its images are counted from here.
  void count_images_anew(std::uint32_t number) {
    if (space_.repeats()) homes_[number].image = {};
  }
  /// Of its capsule.
  Vec3 middle_of(std::uint32_t number) const { return homes_[number].middle; }
  Vec3 image_of(std::uint32_t number) const { return homes_[number].image; }
  /// What brings body b to the image in which body a may meet it while both are in their windows.
  Vec3 shift_to_meet(std::uint32_t a, std::uint32_t b) const {
    return space_.shift_between_homes(homes_[b].middle, homes_[a].middle);
  }
  /// The bound of body b as body a has to reckon with it.
  Bound seen_from(std::uint32_t a, std::uint32_t b) const;

  /// All but the definition and what follows from it, the tag, and the predicate.
  template <class Self, class Archive>
  static void transfer(Self& self, Archive& archive) {
    auto& [definition, tag, space, enclosure, table, size, changes, rests, filters, homes, free, shapes,
           free_shapes, sensors, pair_filter, filtering] = self;
    archive(table, size, changes, rests, filters, homes, free, shapes, free_shapes, sensors, filtering);
  }
  /// For one that was read, with the time of the world: nullptr, or the part that cannot have come about.
  const char* contradiction(double now, const std::vector<std::uint32_t>& dirty) const;
  /// Of one that was read: its ids are given out anew.
  void forget_tag() { tag_ = 0; }
  bool was_given_out(BodyId id) const;

 private:
  double widest_in_period(const Body& body, int axis, double release_gap) const;
  bool lets_meet(BodyId a, BodyId b) const;
  bool shapes_are_sound() const;
  bool changes_are_sound() const;
  bool rests_are_sound() const;
  bool bodies_are_sound(double now, const std::vector<std::uint32_t>& dirty) const;
  bool is_sound(std::uint32_t number, double now) const;
  bool is_sound_fixed(std::uint32_t number, double now) const;
  bool image_is_sound(std::uint32_t number) const;

  WorldDefinition definition_;
  std::uint32_t tag_;
  Space space_;
  std::optional<Box> walls_;
  std::vector<Body> table_;
  std::size_t size_ = 0;
  std::vector<Change> changes_;
  std::vector<Rest> rests_;
  std::vector<Filter> filters_;  ///< of all bodies up to the last one that has another than the default
  std::vector<Home> homes_;
  std::vector<std::uint32_t> free_;
  std::vector<Shape> shapes_;
  std::vector<std::uint32_t> free_shapes_;
  SensorTable sensors_;
  PairFilter pair_filter_;
  bool filtering_ = false;
};

/// Around the bound now, in the part of space that there is.
inline Box box_now(const Space& space, const Bound& bound, double now) {
  return space.within(swept_box(bound, now, now));
}

}  // namespace kinesphere
