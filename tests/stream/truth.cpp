// The true motion of bodies, and the exact course of the gaps between them.
#include "stream/truth.hpp"

#include <algorithm>
#include <cmath>

#include "number/infinity.hpp"
#include "support/exact_shapes.hpp"

namespace kinesphere::stream {
namespace {

using exact::Wide;
using exact::WideVec;
using placed_parts::distance_of;
using placed_parts::gap_of;
using placed_parts::PlacedPart;

/// In a plane boxes are as high as the world allows.
Shape near_the_world(Shape shape) {
  if (auto* box = std::get_if<Box>(&shape)) {
    box->lower.z = std::max(box->lower.z, -2.0 * world_size);
    box->upper.z = std::min(box->upper.z, 2.0 * world_size);
  }
  return shape;
}

/// Returns the signed distance from the surface of a shape that is no ball, by formulas other than the
/// library's.
Wide distance_from(const Shape& shape, const WideVec& point) {
  return std::visit(
      [&]<class Solid>(const Solid& solid) -> Wide {
        if constexpr (std::is_same_v<Solid, Ball>)
          throw Disagreement("a ball has no surface of its own");
        else
          return exact::distance(solid, point);
      },
      shape);
}

WideVec place_at(const TrueBody& body, double time) {
  const Segment& path = body.path.front();
  const Wide s = Wide(time) - Wide(path.begin);
  return exact::moved(exact::moved(exact::wide(path.position), exact::wide(path.velocity), s),
                      exact::wide(path.acceleration), s * s / 2);
}

double acceleration_limit(const TrueBody& body) {
  return body.definition.acceleration_limit + norm(body.definition.planned_acceleration);
}

/// Returns what turning adds to the acceleration of the points of a rigid body, at most.
double turning_acceleration(const TrueBody& body) {
  const double spin = body.rigid->spin();
  return (body.rigid->angular_acceleration_limit + spin * spin) * body.definition.radius;
}

std::string text_of(BodyId id) { return std::to_string(id.index) + "." + std::to_string(id.generation); }

}  // namespace

std::string text_of(const Contact& contact) {
  return text_of(contact.first) + " and " +
         (contact.wall == Wall::none ? text_of(contact.second) : std::string(name_of(contact.wall))) +
         (contact.sensed ? " within " + std::to_string(*contact.sensed) : std::string());
}

Truth::Truth(const WorldDefinition& definition) : definition_(definition), time_(definition.start_time) {
  if (!definition.box) return;
  for (const Wall wall : kinesphere::walls) {
    const int axis = (static_cast<int>(wall) - 1) / 2;
    if (axis < definition.dimensions && !definition.periodic[axis]) walls_.push_back(wall);
  }
}

Vec3 Truth::shift_to_nearest(const Vec3& from, const Vec3& to) const {
  Vec3 shift;
  for (int axis = 0; axis < 3; ++axis)
    if (definition_.periodic[axis])
      shift[axis] = world_size * std::round((to[axis] - from[axis]) / world_size);
  return shift;
}

/// Calls visit(shift) for an image and those up to one period away.
template <class Visit>
void Truth::for_each_image(Visit visit) const {
  const auto most = [this](int axis) { return definition_.periodic[axis] ? 1 : 0; };
  for (int x = -most(0); x <= most(0); ++x)
    for (int y = -most(1); y <= most(1); ++y)
      for (int z = -most(2); z <= most(2); ++z) visit(world_size * Vec3{double(x), double(y), double(z)});
}

void Truth::add(BodyId id, const BodyDefinition& body, const Vec3& acceleration) {
  if (id.index >= bodies_.size()) {
    require(id.index == bodies_.size() && id.generation == 0, "a new index is not the next one");
    bodies_.emplace_back();
  } else {
    require(!at(id).alive && id.generation == at(id).id.generation + 1, "an id is given out twice");
  }
  at(id) = {.id = id, .definition = body, .path = {}, .alive = true, .enabled = true};
  at(id).path = {{time_, infinity, body.position, body.velocity, acceleration, {}}};
}

void Truth::add_static(BodyId id, const BodyDefinition& body, const Shape& shape) {
  add(id, body, {});
  at(id).fixed = true;
  if (!std::holds_alternative<Ball>(shape)) at(id).shape = shape;
}

void Truth::add_rigid(BodyId id, const RigidBody& body, double radius, const Vec3& acceleration) {
  add(id, body.body, acceleration);
  at(id).definition.radius = radius;
  at(id).rigid.emplace(body, time_);
}

void Truth::swing(BodyId id, double part, const Vec3& axis) {
  TrueRigid& rigid = *at(id).rigid;
  const Rotation now = rigid.turning.at(time_);
  const double speed = norm(now.angular_velocity);
  const double room = std::max(0.0, 0.99 * rigid.largest_angular_speed - speed) * Turning::pace;
  const double most = std::min(0.99 * rigid.angular_acceleration_limit, room);
  const Vec3 along = speed > 0.0 ? now.angular_velocity / speed : axis;
  rigid.turning = {time_, now, along * (part * most)};
}

void Truth::note_acceleration(BodyId id) {
  TrueBody& body = at(id);
  if (!body.rigid) return;
  body.rigid->accelerations.include(acceleration_limit(body));
  body.rigid->turning_accelerations.include(turning_acceleration(body));
}

void Truth::remove(BodyId id) {
  at(id).alive = false;
  haunted_.erase(id);
}

void Truth::restart(BodyId id) {
  Segment& path = at(id).path.front();
  const State now = path.state_at(time_);
  path.begin = time_;
  path.position = now.position;
  path.velocity = now.velocity;
}

void Truth::move(BodyId id, const State& state) {
  restart(id);
  at(id).path.front().position = state.position;
  at(id).path.front().velocity = state.velocity;
}

void Truth::steer(BodyId id, const Vec3& acceleration) {
  if (at(id).resting) {
    at(id).on_waking = acceleration;
    return;
  }
  restart(id);
  at(id).path.front().acceleration = acceleration;
}

void Truth::rest(BodyId id) {
  restart(id);
  TrueBody& body = at(id);
  Segment& path = body.path.front();
  body.resting = true;
  body.rested_at = time_;
  body.on_waking = path.acceleration;
  path.velocity = path.acceleration = {};
}

void Truth::wake(BodyId id) {
  at(id).resting = false;
  steer(id, at(id).on_waking);
}

std::vector<BodyId> Truth::ids() const {
  std::vector<BodyId> ids;
  for (const TrueBody& body : bodies_)
    if (body.alive) ids.push_back(body.id);
  return ids;
}

bool Truth::is_alive(BodyId id) const { return id.index < bodies_.size() && at(id).alive && at(id).id == id; }

void Truth::haunt(BodyId id) {
  if (!haunted_.insert(id).second) haunted_.erase(id);
}

bool Truth::may_touch(BodyId a, const BodyDefinition& definition_of_a, BodyId b) const {
  const BodyDefinition& other = at(b).definition;
  return definition_of_a.solid && other.solid && passes(definition_of_a.filter, other.filter) &&
         (!has_pair_filter || pair_filter(a, b));
}

bool Truth::meets(const Contact& contact) const {
  const TrueBody& first = at(contact.first);
  const TrueBody& second = at(contact.second);
  return is_present(contact.second) && !(first.fixed && second.fixed) &&
         passes(first.definition.filter, second.definition.filter) &&
         (!has_pair_filter || pair_filter(contact.first, contact.second));
}

bool Truth::senses(BodyId a, BodyId b, double distance) const {
  const Sensor& sensor = sensors[at(a).definition.sensor_class];
  return (sensor.mask & at(b).definition.filter.category) != 0 &&
         std::find(sensor.distances.begin(), sensor.distances.end(), distance) != sensor.distances.end();
}

bool Truth::may_be_reported(const Contact& contact) const {
  if (!is_present(contact.first)) return false;
  if (contact.wall != Wall::none)
    return !at(contact.first).fixed && meets_walls(definition_, at(contact.first).definition.filter);
  const auto& [a, b, wall, sensed] = contact;
  if (sensed) return (senses(a, b, *sensed) || senses(b, a, *sensed)) && meets(contact);
  return at(a).definition.solid && at(b).definition.solid && meets(contact);
}

// Gaps.

/// Returns the body with a radius and no shape.
const TrueBody& Truth::mover(const Contact& contact) const {
  return at(at(contact.first).shape ? contact.second : contact.first);
}

/// Returns the shape of the other body; null if it has none.
const Shape* Truth::shape(const Contact& contact) const {
  if (contact.wall != Wall::none) return nullptr;
  const auto& shape = at(at(contact.first).shape ? contact.first : contact.second).shape;
  return shape ? &*shape : nullptr;
}

/// Returns the half-space of a wall, or of a shape that is one.
std::optional<HalfSpace> Truth::inside(const Contact& contact) const {
  if (contact.wall != Wall::none) return half_space(*definition_.box, contact.wall);
  const Shape* solid = shape(contact);
  if (solid == nullptr || !std::holds_alternative<HalfSpace>(*solid)) return std::nullopt;
  return std::get<HalfSpace>(*solid);
}

/// Returns the difference of the distance of the centres (or of the centre from a wall or shape) and the gap.
double Truth::extent(const Contact& contact) const {
  const double radius = mover(contact).definition.radius;
  const bool ball = contact.wall == Wall::none && shape(contact) == nullptr;
  return radius + (ball ? at(contact.second).definition.radius : 0.0) + contact.sensed.value_or(0.0);
}

/// Returns the largest speed at which the surfaces of rigid bodies turn.
double Truth::turning_speed(const Contact& contact) const {
  const auto of = [this](BodyId id) {
    const TrueBody& body = at(id);
    return body.rigid ? body.rigid->spin() * body.definition.radius : 0.0;
  };
  return of(contact.first) + (contact.wall == Wall::none ? of(contact.second) : 0.0);
}

Range Truth::largest_accelerations(BodyId id) const {
  const TrueBody& body = at(id);
  if (body.fixed) return {0.0, 0.0};
  if (!body.rigid) return {acceleration_limit(body), acceleration_limit(body)};
  const auto& [least, greatest] = body.rigid->accelerations;
  const auto& [least_turning, greatest_turning] = body.rigid->turning_accelerations;
  return {least + least_turning, greatest + greatest_turning};
}

/// Returns the least sum of radii that two parts have.
double Truth::least_radius(const Contact& contact) const {
  const auto of = [this](BodyId id) {
    const TrueBody& body = at(id);
    if (!body.rigid) return body.shape ? 0.0 : body.definition.radius;
    double least = infinity;
    for (const RigidPart& part : body.rigid->parts) least = std::min(least, part.radius);
    return least;
  };
  return of(contact.first) + (contact.wall == Wall::none ? of(contact.second) : 0.0);
}

/// Returns the parts of a rigid body, or the ball of another one.
std::vector<PlacedPart> Truth::placed(const TrueBody& body, double time, const Vec3& shift) const {
  static const true_hulls::Hull point(std::vector<Vec3>(1));
  const Vec3 position = body.path.front().state_at(time).position + shift;
  if (!body.rigid) return {{RigidPart{.radius = body.definition.radius}, point, position, {}}};
  const Quaternion orientation = body.rigid->turning.at(time).orientation;
  std::vector<PlacedPart> parts;
  for (std::size_t k = 0; k < body.rigid->parts.size(); ++k)
    parts.emplace_back(body.rigid->parts[k], body.rigid->hulls[k], position, orientation);
  return parts;
}

/// Beyond `enough`, a lower limit will do. Parts whose axes or hulls cross are as near as their radii tell.
double Truth::gap_of_parts(const Contact& contact, double time, double enough) const {
  const TrueBody& body = mover(contact);
  const double sensed = contact.sensed.value_or(0.0);
  double least = infinity;
  const auto consider = [&](double lower, auto exact) {
    if (lower < least) least = std::min(least, lower > enough + sensed ? lower : exact());
  };
  if (const auto half = inside(contact)) {
    for (const PlacedPart& part : placed(body, time, {})) least = std::min(least, gap_of(part, *half));
    return least - sensed;
  }
  if (const Shape* solid = shape(contact)) {
    for (const PlacedPart& part : placed(body, time, {}))
      consider(distance_of(*solid, part.middle) - part.reach,
               [&] { return gap_of(part, near_the_world(*solid), {}, false, enough + sensed); });
    return least - sensed;
  }
  const TrueBody& other = at(contact.second);
  const auto centre = [time](const TrueBody& of) { return of.path.front().state_at(time).position; };
  const Vec3 nearest = shift_to_nearest(centre(other), centre(body));
  const std::vector<PlacedPart> parts = placed(body, time, {});
  // Where the positions are nearest, the parts need not be.
  for_each_image([&](const Vec3& shift) {
    for (const PlacedPart& partner : placed(other, time, nearest + shift))
      for (const PlacedPart& part : parts)
        consider(norm(part.middle - partner.middle) - part.reach - partner.reach,
                 [&] { return gap_of(part, partner, false, enough + sensed); });
  });
  return least - sensed;
}

double Truth::gap_to_walls(const std::vector<PlacedPart>& parts, const Filter& filter) const {
  double least = infinity;
  if (!meets_walls(definition_, filter)) return least;
  for (const Wall wall : walls_)
    for (const PlacedPart& part : parts)
      least = std::min(least, gap_of(part, half_space(*definition_.box, wall)));
  return least;
}

double Truth::gap_at(const Contact& contact, double time, double enough) const {
  if (turns(contact)) return gap_of_parts(contact, time, enough);
  const Vec3 centre = mover(contact).path.front().state_at(time).position;
  const double extent = this->extent(contact);
  if (const auto half = inside(contact)) return dot(half->normal, centre) - half->offset - extent;
  if (const Shape* solid = shape(contact))
    return static_cast<double>(distance_from(*solid, exact::wide(centre)) - extent);
  const Vec3 other = at(contact.second).path.front().state_at(time).position;
  return norm(other + shift_to_nearest(other, centre) - centre) - extent;
}

double Truth::gap(const Contact& contact) const { return gap_at(contact, time_); }

double Truth::exact_gap(const Contact& contact) const {
  if (turns(contact)) return gap(contact);
  const WideVec centre = place_at(mover(contact), time_);
  const Wide extent = Wide(mover(contact).definition.radius) + Wide(contact.sensed.value_or(0.0));
  if (const auto half = inside(contact)) return double(exact::distance(*half, centre) - extent);
  if (const Shape* solid = shape(contact)) return double(distance_from(*solid, centre) - extent);
  WideVec way = exact::operator-(place_at(at(contact.second), time_), centre);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Wide period = definition_.periodic[static_cast<int>(axis)] ? Wide(world_size) : Wide(0);
    if (period > 0) way[axis] -= Wide(std::round(double(way[axis] / period))) * period;
    while (period > 0 && way[axis] > period / 2) way[axis] -= period;
    while (period > 0 && way[axis] < -period / 2) way[axis] += period;
  }
  return double(exact::sqrt(exact::dot(way, way)) - extent - Wide(at(contact.second).definition.radius));
}

double Truth::distance(BodyId id, const Vec3& point) const {
  const TrueBody& body = at(id);
  if (body.rigid) {
    const Vec3 centre = state(id).position;
    const true_hulls::Hull hull(std::vector<Vec3>(1));
    const PlacedPart there(RigidPart{.radius = 0.0}, hull, point, {});
    double least = infinity;
    for (const PlacedPart& part : placed(body, time_, shift_to_nearest(centre, point)))
      least = std::min(least, gap_of(part, there, false, infinity));
    return least;
  }
  if (body.shape) return static_cast<double>(distance_from(*body.shape, exact::wide(point)));
  const Vec3 centre = state(id).position;
  return norm(centre + shift_to_nearest(centre, point) - point) - body.definition.radius;
}

GapLimits Truth::limits(const CollisionShape& a, const CollisionShape& b) const {
  Bound nearest = b.bound;
  nearest.position += shift_to_nearest(b.bound.centre_at(time_), a.bound.centre_at(time_));
  return visit_shapes(
      a, CollisionShape{nearest, b.is_static, b.shape},
      [this](const Bound& bound, const auto& partner) { return gap_limits(bound, partner, time_); });
}

/// Returns the motion of the first body relative to the second in its nearest image, or along the normal of a
/// wall. Precondition: no other shape.
Truth::Relative Truth::relative(const Contact& contact) const {
  const TrueBody& body = mover(contact);
  const auto [position, velocity] = body.path.front().state_at(time_);
  const Vec3 acceleration = body.path.front().acceleration;
  if (const auto half = inside(contact)) {
    const Vec3 n = half->normal;
    return {n * (dot(n, position) - half->offset), n * dot(n, velocity), n * dot(n, acceleration)};
  }
  if (shape(contact) != nullptr) return {{}, -velocity, -acceleration};
  const State second = state(contact.second);
  return {second.position + shift_to_nearest(second.position, position) - position,
          second.velocity - velocity, at(contact.second).path.front().acceleration - acceleration};
}

/// Returns the approach to a shape, from the difference of distances over a way so short that it needs
/// quadruple precision.
double Truth::approach_to_shape(const Contact& contact) const {
  const Wide moment = 0x1p-40;
  const WideVec centre = place_at(mover(contact), time_);
  const WideVec next = exact::moved(centre, exact::wide(state(mover(contact).id).velocity), moment);
  const Shape& solid = *shape(contact);
  return static_cast<double>((distance_from(solid, centre) - distance_from(solid, next)) / moment);
}

/// In a step speeds change by the accelerations of points and, as axes or hulls slide past each other, by the
/// square of the speed over their distance.
Range Truth::closing_speeds(const Contact& contact) const {
  constexpr double step = 1e-6;
  constexpr double rounding = 1e-9;
  const double now = gap_at(contact, time_);
  const double before = (gap_at(contact, time_ - step) - now) / step;
  const double after = (now - gap_at(contact, time_ + step)) / step;
  const double speed = norm(relative(contact).velocity) + turning_speed(contact);
  const double distance = now + contact.sensed.value_or(0.0) + least_radius(contact);
  const double bend = largest_accelerations(contact.first).greatest +
                      (contact.wall == Wall::none ? largest_accelerations(contact.second).greatest : 0.0) +
                      (distance > 0.0 ? speed * speed / distance : infinity);
  const double slack = rounding / step + bend * step;
  return {std::min(before, after) - slack, std::max(before, after) + slack};
}

double Truth::approach_speed(const Contact& contact) const {
  const auto [x, v, g] = relative(contact);
  if (const auto half = inside(contact)) return -dot(half->normal, v);
  if (shape(contact) != nullptr) return approach_to_shape(contact);
  const double distance = norm(x);
  return distance > 0.0 ? -dot(x, v) / distance : -norm(v);
}

bool Truth::may_reach(const Contact& contact, LevelCrossing overlap, double level, double until) const {
  const auto [x, v, g] = relative(contact);
  const double s = until - time_;
  const double way = 1.001 * (norm(v) + 0.5 * norm(g) * s + turning_speed(contact)) * s + 1e-9;
  const double gap = this->gap(contact);
  return overlap == LevelCrossing::falls_to ? gap - way <= level : gap + way >= level;
}

std::optional<double> Truth::first_time(const Contact& contact, LevelCrossing overlap, double level,
                                        double from, double until) const {
  if (turns(contact)) return march(contact, overlap, level, from, until);
  if (const auto half = inside(contact))
    return GapCourse(mover(contact).path, *half, extent(contact)).first_time(overlap, level, from, until);
  if (shape(contact) != nullptr) return march(contact, overlap, level, from, until);
  return first_in_images(contact, overlap, level, from, until);
}

/// Steps through the times that the body needs to reach the level at its largest speed, with a lower limit.
std::optional<double> Truth::march(const Contact& contact, LevelCrossing overlap, double level, double from,
                                   double until) const {
  const auto [x, v, g] = relative(contact);
  const double speed = norm(v) + norm(g) * (until - time_) + turning_speed(contact);
  const double least = turns(contact) ? 1.0 / 64.0 : 1e-3;
  for (double time = from;;) {
    const double gap = gap_at(contact, time, level + 0.1);
    const double way = overlap == LevelCrossing::falls_to ? gap - level : level - gap;
    if (way <= 0.0) return time;
    if (time >= until) return std::nullopt;
    time = std::min(until, time + std::max(least * (until - from), way / speed));
  }
}

/// In periodic space one image after the other approaches; but bodies that must separate are near each other
/// in one image only.
std::optional<double> Truth::first_in_images(const Contact& contact, LevelCrossing overlap, double level,
                                             double from, double until) const {
  const Trajectory& path = at(contact.first).path;
  const double extent = this->extent(contact);
  const Axes periodic = definition_.periodic;
  if (!periodic.any())
    return GapCourse(path, at(contact.second).path, extent).first_time(overlap, level, from, until);
  const auto centre = [from](const Trajectory& along) { return along.front().state_at(from).position; };
  Trajectory other = at(contact.second).path;
  const Vec3 nearest = other.front().position + shift_to_nearest(centre(other), centre(path));
  std::optional<double> first;
  const int beyond = overlap == LevelCrossing::falls_to ? 1 : 0;
  const auto range = [&](int axis) { return periodic[axis] ? beyond : 0; };
  for (int x = -range(0); x <= range(0); ++x)
    for (int y = -range(1); y <= range(1); ++y)
      for (int z = -range(2); z <= range(2); ++z) {
        other.front().position = nearest + world_size * Vec3{double(x), double(y), double(z)};
        const auto time =
            GapCourse(path, other, extent).first_time(overlap, level, from, first.value_or(until));
        if (time) first = time;
      }
  return first;
}

/// Uses the greatest value of x.x' / (1, or |n.x| for a wall), for the relative position x.
bool Truth::opens_before(const Contact& contact, double until) const {
  const auto [x, v, g] = relative(contact);
  if (const auto half = inside(contact)) {
    const Vec3 n = half->normal;
    return std::max(dot(n, v), dot(n, v + g * (until - time_))) >= -1e-9;
  }
  // Returns true for other shapes, for which the course is unknown.
  if (shape(contact) != nullptr) return true;
  const double q0 = dot(x, v);
  const double q1 = norm_squared(v) + dot(x, g);
  const double q2 = 1.5 * dot(v, g);
  const double q3 = 0.5 * norm_squared(g);
  const double end = until - time_;
  const auto opening = [=](double s) { return q0 + (q1 + (q2 + q3 * s) * s) * s; };
  double most = std::max(opening(0.0), opening(end));
  const double discriminant = q2 * q2 - 3.0 * q1 * q3;
  if (discriminant >= 0.0 && q3 > 0.0) {
    for (const double sign : {-1.0, 1.0}) {
      const double s = (-q2 + sign * std::sqrt(discriminant)) / (3.0 * q3);
      if (s > 0.0 && s < end) most = std::max(most, opening(s));
    }
  }
  return most >= -1e-9;
}

}  // namespace kinesphere::stream
