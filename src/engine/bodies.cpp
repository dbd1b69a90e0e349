#include "engine/bodies.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "contact/contact_event.hpp"
#include "engine/validation.hpp"
#include "number/infinity.hpp"

namespace kinesphere {
namespace {

std::uint32_t next_tag() {
  static std::atomic<std::uint32_t> count{0};
  const std::uint32_t tag = ++count;
  return tag == 0 ? next_tag() : tag;
}

Vec3 centre_of(const Box& box) { return 0.5 * (box.lower + box.upper); }

}  // namespace

Bodies::Bodies(const WorldDefinition& definition)
    : definition_(definition), tag_(next_tag()), space_(definition), walls_(walls_of(definition)) {}

void Bodies::reserve(std::size_t bodies) {
  table_.reserve(bodies);
  if (space_.repeats()) homes_.reserve(bodies);
}

std::uint32_t Bodies::take_number() {
  std::uint32_t number;
  if (free_.empty()) {
    number = static_cast<std::uint32_t>(table_.size());
    table_.emplace_back();
    if (space_.repeats()) homes_.emplace_back();
  } else {
    number = free_.back();
    free_.pop_back();
  }
  table_[number].alive = true;
  ++size_;
  return number;
}

void Bodies::give_back(std::uint32_t number) {
  Body& body = table_[number];
  if (body.is_fixed()) free_shapes_.push_back(body.shape_number);
  forget_change(number);
  keep_filter(number, {});
  count_images_anew(number);
  const std::uint32_t generation = body.generation + 1;
  const std::uint32_t stamp = body.stamp;
  body = Body{};
  body.generation = generation;
  body.stamp = stamp;
  free_.push_back(number);
  --size_;
}

void Bodies::keep(std::uint32_t number, const BodyDefinition& definition) {
  Body& body = table_[number];
  body.radius = definition.radius;
  body.position_error = definition.position_error;
  body.sensor_class = definition.sensor_class;
  body.user_data = definition.user_data;
  keep_filter(number, definition.filter);
  keep_solid(number, definition.solid);
}

std::size_t Bodies::present_count() const {
  return static_cast<std::size_t>(
      std::count_if(table_.begin(), table_.end(), [](const Body& body) { return body.present(); }));
}

BodyId Bodies::next_id(std::size_t additions_before) const {
  if (additions_before < free_.size()) return id_of(free_[free_.size() - 1 - additions_before]);
  return {static_cast<std::uint32_t>(table_.size() + (additions_before - free_.size())), 0, tag_};
}

GapLimits Bodies::gap_at(double now, const Extent& a, const Extent& b) const {
  const auto limits = [now](const Bound& bound, const auto& partner) {
    return gap_limits(bound, partner, now);
  };
  if (!space_.repeats()) return visit_extents(a, b, limits);
  Bound nearest = b.bound;
  nearest.position += space_.shift_to_nearest(b.bound.centre_at(now), a.bound.centre_at(now));
  return limits(a.bound, nearest);
}

BodyDefinition Bodies::definition_of(std::uint32_t number) const {
  const Body& body = table_[number];
  const Bound& bound = body.bound;
  BodyDefinition definition{.radius = body.radius,
                            .acceleration_limit = bound.growth_acceleration,
                            .planned_acceleration = bound.planned_acceleration,
                            .position_error = body.position_error,
                            .velocity_error = bound.growth_speed,
                            .position = bound.position,
                            .velocity = bound.velocity,
                            .filter = filter_of(number),
                            .solid = body.solid,
                            .sensor_class = body.sensor_class,
                            .user_data = body.user_data};
  if (const Change* change = change_since_report(number)) {
    definition = with_motion_limits(definition, change->promise);
    definition.velocity = change->kicked_to.value_or(bound.velocity);
  }
  if (body.is_resting()) definition = with_motion_limits(definition, rests_[body.rest_number].limits);
  return definition;
}

Sphere Bodies::sphere_at(double now, std::uint32_t number) const {
  const Bound& bound = table_[number].bound;
  Sphere sphere{id_of(number),
                bound.radius,
                {bound.centre_at(now), bound.velocity_at(now)},
                shapes_.empty() ? nullptr : extent(number).shape,
                table_[number].user_data};
  if (space_.repeats()) sphere.state.position = space_.wrapped(sphere.state.position).position;
  return sphere;
}

Change& Bodies::change_of(std::uint32_t number) {
  Body& body = table_[number];
  if (body.change_number == Body::none) {
    changes_.push_back({number, std::nullopt, motion_limits_of(definition_of(number))});
    body.change_number = static_cast<std::uint32_t>(changes_.size() - 1);
  }
  return changes_[body.change_number];
}

/// The last one takes its place.
void Bodies::forget_change(std::uint32_t number) {
  const std::uint32_t change = table_[number].change_number;
  if (change == Body::none) return;
  table_[changes_.back().body].change_number = change;
  table_[number].change_number = Body::none;
  changes_[change] = changes_.back();
  changes_.pop_back();
}

void Bodies::start_rest(std::uint32_t number, const MotionLimits& awake) {
  table_[number].rest_number = static_cast<std::uint32_t>(rests_.size());
  rests_.push_back({number, awake});
}

/// The last one takes its place in the table.
void Bodies::forget_rest(std::uint32_t number) {
  const std::uint32_t rest = table_[number].rest_number;
  if (rest == Body::none) return;
  table_[rests_.back().body].rest_number = rest;
  table_[number].rest_number = Body::none;
  rests_[rest] = rests_.back();
  rests_.pop_back();
}

void Bodies::keep_filter(std::uint32_t number, const Filter& filter) {
  if (filter != Filter{}) {
    filtering_ = true;
    if (number >= filters_.size()) filters_.resize(number + std::size_t{1});
  }
  if (number < filters_.size()) filters_[number] = filter;
}

void Bodies::keep_solid(std::uint32_t number, bool solid) {
  table_[number].solid = solid;
  if (!solid) filtering_ = true;
}

void Bodies::keep_pair_filter(PairFilter filter) {
  filtering_ = true;
  pair_filter_ = std::move(filter);
}

/// What the caller's predicate says.
bool Bodies::lets_meet(BodyId a, BodyId b) const {
  const FilterQuestion question(this);
  return pair_filter_(a, b);
}

/// Bodies and their bounds, with all that they sense, reach less far than eight times the limit of their
/// coordinates.
Box Bodies::box_of(const Shape& shape) const {
  return bounding_box(shape, 8.0 * coordinate_limit(definition_));
}

void Bodies::keep_shape(std::uint32_t number, const Shape& shape) {
  Body& body = table_[number];
  if (free_shapes_.empty()) {
    body.shape_number = static_cast<std::uint32_t>(shapes_.size());
    shapes_.push_back(shape);
  } else {
    body.shape_number = free_shapes_.back();
    free_shapes_.pop_back();
    shapes_[body.shape_number] = shape;
  }
  filtering_ = true;
}

FixedDefinition Bodies::fixed_definition(BodyId id) const {
  const Body& body = table_[id.index];
  return {shape(id.index), filter_of(id.index), body.solid, body.sensor_class, body.user_data};
}

Box Bodies::box_of_fixed(std::uint32_t number) const {
  const Vec3 room = Vec3{1.0, 1.0, 1.0} * sensors_.reach(table_[number].sensor_class);
  const Box box = box_of(shape(number));
  return space_.within({box.lower - room, box.upper + room});
}

RoomyBound Bodies::roomy_bound(std::uint32_t number, double now) const {
  const Body& body = table_[number];
  const double room = sensor_reach(number) + definition_.contact_tolerance;
  if (!body.is_fixed()) return {MovedBound(body.bound, now), room};
  Bound ball = body.bound;
  if (const Shape* shape = extent(number).shape) {
    const Box box = space_.within(box_of(*shape));
    ball.position = centre_of(box);
    ball.radius = norm(0.5 * (box.upper - box.lower));
  }
  return {MovedBound(ball, now), room};
}

/// How wide the box of a body may be on an axis that repeats, by space/space.hpp (2); a little less, for
/// rounding.
double Bodies::widest_in_period(const Body& body, int axis, double release_gap) const {
  return (0.5 - 0x1p-10) * space_.period()[axis] - release_gap - 4.0 * body.position_error;
}

double Bodies::longest_in_period(std::uint32_t number, double now, double length, double release_gap) const {
  const Body& body = table_[number];
  const MovedBound moved(body.bound, now);
  const double radius =
      moved.radius + sensors_.reach(body.sensor_class) + 2.0 * definition_.contact_tolerance;
  double longest = length;
  for (int axis = 0; axis < 3; ++axis) {
    if (!space_.repeats(axis)) continue;
    const double speed = std::abs(moved.velocity[axis]) + 2.0 * moved.speed;
    const double a = norm_one(moved.acceleration) + moved.growth;
    const double way = std::max(widest_in_period(body, axis, release_gap) - 2.0 * radius, 0.0);
    if ((speed + a * longest) * longest <= way) continue;
    const double divisor = speed + std::sqrt(speed * speed + 4.0 * a * way);
    if (divisor > 0.0) longest = std::min(longest, 2.0 * way / divisor);
  }
  return longest;
}

void Bodies::bring_home(std::uint32_t number, double now, double length) {
  const Vec3 middle = centre_of(roomy_bound(number, now).box_of_way(length));
  const auto [home, images] = space_.wrapped(middle);
  homes_[number].middle = home;
  if (images == Vec3{}) return;
  table_[number].bound.position -= space_.shift_of(images);
  homes_[number].image += images;
}

Bound Bodies::seen_from(std::uint32_t a, std::uint32_t b) const {
  Bound bound = table_[b].bound;
  bound.position += shift_to_meet(a, b);
  return bound;
}

}  // namespace kinesphere
