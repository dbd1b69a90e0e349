// Bodies holds all bodies of a world: their table, and side tables for changes, sleep records, filters,
// masses, periodic images, shapes and sensors.
//
// A static body has a shape in a side table and is never probed. Another body may carry a shape, or be rigid:
// then it has parts in a side table. A sleeping body has a bound that stands still and is otherwise treated
// like any other; the motion limits that apply after it wakes are in a side table.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <vector>

#include "bodies/body_table.hpp"
#include "bodies/changing_radii.hpp"
#include "bodies/filters.hpp"
#include "bodies/periodic_image.hpp"
#include "bodies/rigid_bodies.hpp"
#include "bodies/shapes.hpp"
#include "bodies/side_table.hpp"
#include "bodies/sparse_column.hpp"
#include "contact/contact_event.hpp"
#include "contact/sensor_table.hpp"
#include "kinesphere/world_definition.hpp"
#include "number/infinity.hpp"
#include "space/space.hpp"

namespace kinesphere {

class Bodies {
 public:
  explicit Bodies(const WorldDefinition& definition);

  const WorldDefinition& definition() const { return definition_; }
  const Space& space() const { return space_; }
  /// Returns walls_of(definition()).
  const std::optional<Box>& walls() const { return walls_; }

  const BodyTable& table() const { return table_; }
  Body& operator[](std::uint32_t number) { return table_[number]; }
  const Body& operator[](std::uint32_t number) const { return table_[number]; }
  BodyId id_of(std::uint32_t number) const { return table_.id_of(number); }
  std::uint32_t numbers() const { return table_.numbers(); }

  void reserve(std::size_t bodies);
  /// Adds a body with its definition at time `now`, except for its state and motion limits. Returns its
  /// number.
  std::uint32_t add(const BodyDefinition& definition, double now);
  /// Adds a body as above, with a name (BodyTable).
  std::uint32_t add_named(const BodyDefinition& definition, double now, std::uint32_t name);
  /// Gives the body a shape: a carried one, or else one at rest, which makes the body static.
  void give_shape(std::uint32_t number, const Shape& shape, bool carried);
  /// Gives a body with a shape another one. Its bound must follow.
  void reshape(std::uint32_t number, const Shape& shape) { shapes[table_[number]] = shape; }
  /// Gives the body the parts and the rotation of a rigid body.
  void make_rigid(std::uint32_t number, RigidRecord record) { rigid.add(table_[number], std::move(record)); }
  void remove(std::uint32_t number);
  /// Returns true if there has never been a body that is not a ball.
  bool are_balls() const { return shapes.empty() && !rigid.with_parts(); }

  /// Returns the definition with the state of the last report and all pending changes.
  BodyDefinition definition_of(std::uint32_t number) const;
  /// Returns the motion limits in it.
  MotionLimits limits_of(std::uint32_t number) const;
  /// Returns the bound of the body, in this state, with these limits.
  Bound changed_bound(std::uint32_t number, const State& state, double time) const;
  /// Returns the limits that the bound of the body has now.
  MotionLimits bound_limits_of(std::uint32_t number) const {
    const Body& body = table_[number];
    return {body.bound.acceleration_limit, body.bound.planned_acceleration, body.position_error,
            velocity_error(number)};
  }
  void set_solid(std::uint32_t number, bool solid);
  /// Returns the pending change of the body, and creates it if there is none.
  Change& change_of(std::uint32_t number) {
    Body& body = table_[number];
    return body.change_number != Body::none ? changes[body] : give_change(number, changes.extend(1));
  }
  /// Gives a body that has none its pending change, at this place (SideTable::extend()). Threads may call it
  /// for different bodies.
  Change& give_change(std::uint32_t number, std::size_t place) {
    Body& body = table_[number];
    Change& change = changes.give(body, number, place);
    // Field by field: a record that is made elsewhere and copied would wait for its own stores.
    if (const SleepRecord* const record = sleep_records.find(body)) {
      change.limits = record->limits;
      return change;
    }
    change.limits.acceleration_limit = body.bound.acceleration_limit;
    change.limits.planned_acceleration = body.bound.planned_acceleration;
    change.limits.position_error = body.position_error;
    change.limits.velocity_error = velocity_error(number);
    return change;
  }
  /// Removes the pending change: it has taken effect, or the body is being removed.
  void forget_change(std::uint32_t number);
  /// Removes the pending changes of many bodies: of each, and then all of these, so many. The first returns
  /// false if there is none; threads may call it for different bodies.
  bool release_change(std::uint32_t number) {
    if (table_[number].change_number == Body::none) return false;
    if (radii.any()) take_velocity_error(number);
    changes.release(table_[number]);
    return true;
  }
  void drop_released_changes(std::size_t released) { changes.drop_released(table_, released); }

  // Radii that change with time. Body::radius is that at the last report.
  /// Returns the radius that the body has at time `now`.
  double radius_at(std::uint32_t number, double now) const {
    const ChangingRadius* const changing = radii.find(number);
    return changing ? changing->at(now) : table_[number].radius;
  }
  double radius_rate(std::uint32_t number) const {
    const ChangingRadius* const changing = radii.find(number);
    return changing ? changing->rate : 0.0;
  }
  /// Returns the growth speed of the body's bound without the rate of its radius.
  double velocity_error(std::uint32_t number) const {
    const ChangingRadius* const changing = radii.find(number);
    return changing ? changing->velocity_error : table_[number].bound.growth_speed;
  }
  /// From time `now`, when the body has this radius, its radius changes at this rate. Body::radius and the
  /// bound must follow.
  void set_radius_law(std::uint32_t number, double radius, double rate, double now);
  /// Gives the body in the table the radius that it has at time `now`. Its bound must follow.
  void update_radius(std::uint32_t number, double now) { table_[number].radius = radius_at(number, now); }

  /// Returns true if the filters allow two bodies to touch or sense each other.
  bool may_meet(std::uint32_t a, std::uint32_t b) const { return !filters.any() || filters_allow(a, b); }
  bool may_touch(std::uint32_t a, std::uint32_t b) const {
    return table_[a].solid && table_[b].solid && may_meet(a, b);
  }
  /// Returns true if there are walls that the body may touch.
  bool meets_walls(std::uint32_t number) const {
    // Most worlds do not need to look up filters here.
    return walls_ && !table_[number].has_shape() &&
           (!definition_.wall_filter || kinesphere::meets_walls(definition_, filters.of(number)));
  }

  /// Returns the largest acceleration of a point of the body (length / time^2), with the limits of its
  /// pending change, if it has one.
  double largest_acceleration(std::uint32_t number) const {
    const Body& body = table_[number];
    const RigidRecord* const turning = rigid.find(body);
    const Change* const pending = changes.find(body);
    const double of_position =
        pending ? pending->limits.acceleration_limit + norm(pending->limits.planned_acceleration)
                : body.largest_acceleration();
    return of_position + (body.has_parts() ? turning->surface_acceleration(body.radius) : 0.0);
  }

  /// Returns the contact events that a pair reports; for a body and its walls, `b` is the body again.
  ContactEvents wanted_of(std::uint32_t a, std::uint32_t b) const {
    return table_[a].contact_events | table_[b].contact_events;
  }

  /// Resets the image count of the body; call when the caller sets its position.
  void count_images_anew(std::uint32_t number) {
    if (space_.repeats()) images[number].image = {};
    if (space_.slides()) rows[number] = 0.0;
  }
  /// Moves the body to the image in which it lies in the primary box. Requires periodic space.
  void wrap_to_primary(std::uint32_t number, double now);
  /// Moves the body to the image in which it is nearest to the centre of its safe region, in the primary box.
  void move_to_image_of(std::uint32_t number, const Vec3& centre, double now) {
    Bound& bound = table_[number].bound;
    const Vec3 shift = images[number].follow(space_, bound.centre_at(now), centre, now);
    bound.position += shift;
    if (space_.slides()) slide_to_image(number, shift, now);
  }
  /// Returns a velocity of the body that the caller gives with a position of now, in the image of its bound.
  Vec3 velocity_in_image(std::uint32_t number, const Vec3& velocity) const {
    return space_.slides() ? sliding_velocity(number, velocity) : velocity;
  }

  /// Serializes all fields except the definition and what follows from it, the tag, and the pair filter.
  /// Bodies that are read get ids with tag 0.
  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    auto& [changes, sleep_records, filters, masses, radii, images, rows, shapes, rigid, sensors, common_reach,
           definition, space, enclosure, table] = self;
    auto& [bodies, live_count, free, tag, names] = table;
    auto& [by_number, pair_filter, any] = filters;
    archive(bodies, live_count, changes, sleep_records, by_number, masses, radii, images, rows, free, shapes,
            rigid, sensors, common_reach, any);
    if constexpr (!std::is_const_v<Self>) tag = 0;
  }
  /// Returns the name of the part that no sequence of calls could have produced, or nullptr if there is none.
  /// Call after reading; `now` is the time of the world.
  const char* first_invalid_part(double now, const std::vector<std::uint32_t>& dirty) const;

  // Side tables. The member functions above make the changes that concern the body table too.
  WaitingChanges changes;
  SleepRecords sleep_records;
  Filters filters;
  SparseColumn<double> masses{BodyDefinition{}.mass};  ///< for events; infinite for static bodies
  ChangingRadii radii;
  std::vector<PeriodicImage> images;  ///< by body number; empty unless space is periodic
  /// By body number, empty unless images slide: how many rows up y the image of the bound is from that of the
  /// last report. A whole number.
  std::vector<double> rows;
  Shapes shapes;
  RigidBodies rigid;
  SensorTable sensors;
  /// Each body senses at least this far (length). Infinity where that is not known, as on a rank, which does
  /// not know all bodies.
  double common_reach = infinity;

 private:
  std::uint32_t describe(std::uint32_t number, const BodyDefinition& definition, double now);
  void take_velocity_error(std::uint32_t number);
  [[gnu::cold]] Vec3 sliding_velocity(std::uint32_t number, const Vec3& velocity) const;
  [[gnu::cold]] void slide_to_image(std::uint32_t number, const Vec3& shift, double now);
  bool filters_allow(std::uint32_t a, std::uint32_t b) const;
  bool bodies_are_valid(double now, const std::vector<std::uint32_t>& dirty) const;
  bool is_valid(std::uint32_t number, double now) const;
  bool is_valid_static(std::uint32_t number, double now) const;
  bool carried_shape_is_valid(const Body& body, const BodyDefinition& definition) const;
  bool rigid_body_is_valid(std::uint32_t number, double now) const;
  bool sleep_is_valid(const Body& body) const;
  bool radius_is_valid(std::uint32_t number, double now) const;
  bool limits_are_valid(const Body& body, BodyDefinition definition) const;

  WorldDefinition definition_;
  Space space_;
  std::optional<Box> walls_;
  BodyTable table_;
};

}  // namespace kinesphere
