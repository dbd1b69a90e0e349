// The changes that a stream makes to bodies.
#include <algorithm>

#include "stream/on_world.hpp"
#include "stream/player.hpp"

namespace kinesphere::stream {
namespace {

/// A change that the world must accept.
template <class T>
T accepted(Result<T> result) {
  if (!result) throw Disagreement("refused: " + result.error().message);
  if constexpr (!std::is_void_v<T>) return *result;
}

}  // namespace

/// Radii are smaller in a crowd, and in periodic space, which has no room for large bodies.
double Player::radius(const Operation& operation) const {
  const double radius = kind_.crowd ? 0.25 * operation.radius() : operation.radius();
  return truth_.definition().periodic.any() ? std::min(0.3, radius) : radius;
}

MotionLimits Player::limits(const Operation& operation) const {
  MotionLimits promise = operation.motion_limits();
  promise.planned_acceleration = truth_.in_space(promise.planned_acceleration);
  return promise;
}

/// In a world without overlaps the body lies in the box as a whole.
BodyDefinition Player::new_body(const Operation& operation) const {
  BodyDefinition body = with_motion_limits({.radius = radius(operation),
                                            .position = operation.position(),
                                            .velocity = truth_.in_space(operation.velocity()),
                                            .filter = operation.filter(),
                                            .solid = !kind_.sensors || operation.solid(),
                                            .sensor_class = operation.sensor_class(),
                                            .user_data = operation.code()},
                                           limits(operation));
  if (operation.byte(8) % 8 == 0) body.velocity = {};
  const unsigned events = operation.byte(8) / 8 % 8;
  if (events >= 1 && events <= 3) body.contacts = static_cast<ContactEvents>(events);
  body.position = inside(body.position, body.radius);
  return body;
}

/// Returns the nearest place where a body of this radius may be put.
Vec3 Player::inside(Vec3 position, double radius) const {
  const WorldDefinition& world = truth_.definition();
  const double reach = world.allow_overlap ? 0.0 : radius;
  for (int axis = 0; axis < 3 && world.box; ++axis)
    if (!world.periodic[axis]) position[axis] = std::clamp(position[axis], reach, world_size - reach);
  return truth_.in_space(position);
}

/// Returns true if a body of this shape may be there, in a world that refuses overlaps.
bool Player::has_room(BodyId id, const CollisionShape& extent, const BodyDefinition& body) const {
  if (truth_.definition().allow_overlap) return true;
  for (const TrueBody& other : truth_.bodies()) {
    if (!other.present() || other.id == id || (extent.is_static && other.fixed)) continue;
    if (!truth_.may_touch(id, body, other.id)) continue;
    const Bound bound = world_.body(other.id).value().bound;
    const GapLimits gap = truth_.limits(extent, {bound, other.fixed, other.shape ? &*other.shape : nullptr});
    if (gap.upper < -truth_.definition().contact_tolerance) return false;
  }
  return true;
}

void Player::join(BodyId id, const BodyDefinition& body, const Operation& operation) {
  truth_.add(id, body, acceleration(operation, motion_limits_of(body)));
  told_.appeared(id);
  changed();
}

void Player::add(const Operation& operation) {
  if (truth_.ids().size() >= kind_.most_bodies) return;
  if (kind_.rigid && operation.byte(9) % 2 == 0) return add_rigid(operation);
  const BodyDefinition body = new_body(operation);
  const Bound bound = bound_of(body, {body.position, body.velocity}, truth_.time());
  const bool margin = has_room(no_body, {bound}, body);
  const auto id = on_world([&](World& world) { return world.add(body); });
  require(static_cast<bool>(id) == margin, "add: overlaps are refused wrongly");
  if (!id) return require(id.error().code == ErrorCode::overlapping, "add: refused for a wrong reason");
  join(*id, body, operation);
}

void Player::add_all(const Operation& operation) {
  if (truth_.ids().size() + 2 > kind_.most_bodies) return;
  const BodyDefinition first = new_body(operation);
  BodyDefinition second = first;
  second.position = truth_.in_space(Vec3{world_size, world_size, world_size} - first.position);
  const std::vector<BodyDefinition> bodies{first, second};
  const auto ids = on_world([&](World& world) { return world.add_all(bodies); });
  if (!ids) {
    require(!truth_.definition().allow_overlap && ids.error().code == ErrorCode::overlapping,
            "add_all: refused for a wrong reason");
    return;
  }
  for (std::size_t k = 0; k < bodies.size(); ++k) join((*ids)[k], bodies[k], operation);
}

void Player::add_static(const Operation& operation) {
  if (!kind_.fixed || truth_.ids().size() >= kind_.most_bodies) return;
  const bool flat = truth_.definition().dimensions == 2;
  StaticDefinition fixed{.shape = operation.shape(flat),
                         .filter = operation.filter(),
                         .solid = !kind_.sensors || operation.solid(),
                         .sensor_class = operation.sensor_class(),
                         .user_data = operation.code()};
  if (truth_.definition().periodic.any()) fixed.shape = Ball{operation.position(), radius(operation)};
  if (auto* ball = std::get_if<Ball>(&fixed.shape)) ball->centre = truth_.in_space(ball->centre);
  const auto id = on_world([&](World& world) { return world.add_static(fixed); });
  if (!id) {
    require(!truth_.definition().allow_overlap && id.error().code == ErrorCode::overlapping,
            "add_static: refused for a wrong reason");
    return;
  }
  const BodyDefinition body = world_.body(*id).value().definition;
  require(body.filter == fixed.filter && body.solid == fixed.solid &&
              body.sensor_class == fixed.sensor_class && body.user_data == fixed.user_data,
          "add_static: other than asked for");
  const Shape shape = world_.body(*id).value().shape;
  require(shape.index() == fixed.shape.index(), "add_static: another shape");
  truth_.add_static(*id, body, shape);
  require(room_of_fixed(*id), "add_static: an overlap is not refused");
  told_.appeared(*id);
  changed();
}

void Player::leave(BodyId id, const std::vector<Before>& before) {
  told_.gone(before);
  woken_.erase(id);
  truth_.remove(id);
  if (removed_.size() == 8) removed_.erase(removed_.begin());
  removed_.push_back(id);
  changed();
}

void Player::remove(const Operation& operation) {
  const auto id = any(operation);
  if (!id || truth_.ids().size() < 3) return;
  const auto before = told_.before(world_, *id);
  accepted(waking(island_of(*id), [&](World& world) { return world.remove(*id); }));
  leave(*id, before);
}

void Player::remove_all(const Operation& operation) {
  std::vector<BodyId> ids = truth_.ids();
  const std::size_t count = operation.byte(0) % 3;
  if (ids.size() < count + 2) return;
  const std::size_t from = operation.body() % (ids.size() - count);
  ids = {ids.begin() + static_cast<std::ptrdiff_t>(from),
         ids.begin() + static_cast<std::ptrdiff_t>(from + count)};
  std::vector<std::vector<Before>> before;
  EventProcessor island;
  for (const BodyId id : ids) {
    before.push_back(told_.before(world_, id));
    island.join(island_of(id));
  }
  accepted(waking(island, [&](World& world) { return world.remove(ids); }));
  for (std::size_t k = 0; k < ids.size(); ++k) leave(ids[k], before[k]);
}

void Player::set_velocity(BodyId id, const Vec3& velocity) {
  accepted(waking(island_if_resting(id), [&](World& world) { return world.set_velocity(id, velocity); }));
  truth_.move(id, {truth_.state(id).position, velocity});
  told_.redirected(id);
  changed();
}

void Player::set_velocity(const Operation& operation) {
  const auto id = any_moving(operation);
  if (!id || !truth_.is_present(*id)) return;
  if (operation.byte(7) % 16 == 15 && !kind_.rigid) sprint(*id, operation);
  set_velocity(*id, truth_.in_space(operation.velocity()));
}

/// Sends bodies back that have strayed far.
void Player::send_back() {
  for (const BodyId id : truth_.ids()) {
    if (!truth_.is_present(id) || truth_.at(id).fixed) continue;
    const State state = truth_.state(id);
    const Vec3 out = truth_.in_space(state.position - Vec3{0.5, 0.5, 0.5} * world_size);
    if (norm(out) > 1.5 * world_size && dot(out, state.velocity) > 0.0) set_velocity(id, out * (-0.3));
  }
}

/// Changes the true acceleration without a call of the world.
void Player::steer(const Operation& operation) {
  const auto id = any_moving(operation);
  if (!id) return;
  truth_.steer(*id, acceleration(operation, motion_limits_of(truth_.at(*id).definition)));
  if (is_rigid(*id)) turn(*id, operation);
}

void Player::teleport(BodyId id, const State& state) {
  const auto before = told_.before(world_, id);
  const BodyDefinition& body = truth_.at(id).definition;
  const bool margin = has_room(id, {bound_of(body, state, truth_.time())}, body);
  const auto done = waking(island_of(id), [&](World& world) { return world.teleport(id, state); });
  if (!done && is_rigid(id) && done.error().code == ErrorCode::outside_domain) return;
  require(static_cast<bool>(done) == margin, "teleport: overlaps are refused wrongly");
  if (!done) return require(done.error().code == ErrorCode::overlapping, "teleport: a wrong reason");
  truth_.move(id, state);
  go_on_turning(id);
  told_.replaced(world_, id, before);
  told_.redirected(id);
  changed();
}

/// Returns a place where a body of this radius may be put.
State Player::place(const Operation& operation, double radius) const {
  return {inside(operation.position(), radius), new_body(operation).velocity};
}

void Player::teleport(const Operation& operation) {
  const auto id = any_moving(operation);
  if (!id || !truth_.is_present(*id)) return;
  teleport(*id, place(operation, truth_.at(*id).definition.radius));
}

/// Teleports a body by so little that it may stay in its contacts, or leave them by a hair.
void Player::nudge(const Operation& operation) {
  const auto id = any_moving(operation);
  if (!id || !truth_.is_present(*id)) return;
  State state = truth_.state(*id);
  const double length = operation.byte(3) % 2 == 0 ? 0.02 : 8.0 * truth_.definition().contact_tolerance;
  state.position += length * operation.random().point_in_ball();
  state.position = inside(state.position, truth_.at(*id).definition.radius);
  teleport(*id, state);
}

/// Turns a rigid body, which keeps its size.
void Player::set_radius(const Operation& operation) {
  const auto id = any_moving(operation);
  if (!id) return;
  if (is_rigid(*id)) return turn(*id, operation);
  const double radius = this->radius(operation);
  const auto before = truth_.is_present(*id) ? told_.before(world_, *id) : std::vector<Before>();
  const bool strict = !truth_.definition().allow_overlap;
  const EventProcessor island = truth_.is_present(*id) ? island_of(*id) : EventProcessor{};
  const auto done = waking(island, [&](World& world) { return world.change(*id, {.radius = radius}); });
  if (!done) {
    require(strict && radius > truth_.at(*id).definition.radius, "set_radius: refused without a reason");
    require(done.error().code == ErrorCode::overlapping || done.error().code == ErrorCode::outside_domain,
            "set_radius: refused for a wrong reason");
    return;
  }
  const bool grows = radius > truth_.at(*id).definition.radius;
  truth_.at(*id).definition.radius = radius;
  if (!truth_.is_present(*id)) return;
  if (strict && grows)
    require(has_room(*id, {world_.body(*id).value().bound}, truth_.at(*id).definition),
            "set_radius: an overlap is not refused");
  told_.replaced(world_, *id, before);
  changed();
}

void Player::set_motion_limits(const Operation& operation) {
  const auto id = any_moving(operation);
  if (!id) return;
  const MotionLimits promise = limits(operation);
  const auto before = truth_.is_present(*id) ? told_.before(world_, *id) : std::vector<Before>();
  accepted(waking(island_if_resting(*id),
                  [&](World& world) { return world.change(*id, {.motion_limits = promise}); }));
  truth_.at(*id).definition = with_motion_limits(truth_.at(*id).definition, promise);
  truth_.steer(*id, acceleration(operation, promise));
  if (!truth_.is_present(*id)) return;
  told_.replaced(world_, *id, before);
  changed();
}

void Player::turn_off(const Operation& operation) {
  const auto id = any(operation);
  if (!id || !truth_.is_present(*id)) return;
  const auto before = told_.before(world_, *id);
  accepted(waking(island_of(*id), [&](World& world) { return world.disable(*id); }));
  told_.gone(before);
  woken_.erase(*id);
  truth_.at(*id).enabled = false;
  changed();
}

/// Enables the first disabled body.
void Player::turn_on(const Operation& operation) {
  const auto off = std::find_if(truth_.bodies().begin(), truth_.bodies().end(),
                                [](const TrueBody& body) { return body.alive && !body.enabled; });
  if (off == truth_.bodies().end()) return;
  const BodyId id = off->id;
  const State state = place(operation, off->definition.radius);
  const bool margin = off->fixed
                          ? room_of_fixed(id)
                          : has_room(id, {bound_of(off->definition, state, truth_.time())}, off->definition);
  const auto done = on_world([&](World& world) { return world.enable(id, state); });
  if (!done && off->rigid && done.error().code == ErrorCode::outside_domain) return;
  require(static_cast<bool>(done) == margin, "enable: overlaps are refused wrongly");
  if (!done) return require(done.error().code == ErrorCode::overlapping, "enable: a wrong reason");
  if (!off->fixed) truth_.move(id, state);
  go_on_turning(id);
  truth_.at(id).enabled = true;
  told_.appeared(id);
  changed();
}

void Player::set_user_data(const Operation& operation) {
  const auto id = any(operation);
  if (!id) return;
  const std::uint64_t data = operation.random().bits();
  accepted(on_world([&](World& world) { return world.change(*id, {.user_data = data}); }));
  truth_.at(*id).definition.user_data = data;
}

bool Player::room_of_fixed(BodyId id) const {
  const TrueBody& body = truth_.at(id);
  const Bound bound = bound_of(body.definition, truth_.state(id), truth_.time());
  return has_room(id, {bound, true, body.shape ? &*body.shape : nullptr}, body.definition);
}

// Filters.

/// Applies `change`, which may alter the filter's answers about these bodies.
template <class Change>
void Player::refresh_filter(const std::vector<BodyId>& ids, Change change) {
  std::vector<std::vector<Before>> before;
  for (const BodyId id : ids) before.push_back(told_.before(world_, id));
  change();
  for (std::size_t k = 0; k < ids.size(); ++k) told_.refiltered(ids[k], before[k]);
  changed();
}

void Player::set_filter(const Operation& operation) {
  const auto id = any(operation);
  if (!id) return;
  refresh_filter({*id}, [&] {
    accepted(on_world([&](World& world) { return world.change(*id, {.filter = operation.filter()}); }));
    truth_.at(*id).definition.filter = operation.filter();
  });
}

void Player::set_solid(const Operation& operation) {
  const auto id = any(operation);
  if (!id || !kind_.sensors) return;
  const bool solid = operation.byte(0) % 4 != 0;
  refresh_filter({*id}, [&] {
    accepted(on_world([&](World& world) { return world.change(*id, {.solid = solid}); }));
    truth_.at(*id).definition.solid = solid;
  });
}

void Player::set_sensor_class(const Operation& operation) {
  const auto id = any(operation);
  if (!id || !kind_.sensors) return;
  const SensorClass sensor_class = operation.sensor_class();
  refresh_filter({*id}, [&] {
    accepted(on_world([&](World& world) { return world.change(*id, {.sensor_class = sensor_class}); }));
    truth_.at(*id).definition.sensor_class = sensor_class;
  });
}

void Player::set_sensor(const Operation& operation) {
  if (!kind_.sensors) return;
  const SensorClass sensor_class = operation.sensor_class();
  const Sensor sensor = operation.sensor(truth_.definition().periodic.any() ? 0.3 : 1.0);
  std::vector<BodyId> ids = truth_.ids();
  std::erase_if(ids, [&](BodyId id) { return truth_.at(id).definition.sensor_class != sensor_class; });
  refresh_filter(ids, [&] {
    accepted(on_world([&](World& world) { return world.set_sensor(sensor_class, sensor); }));
    truth_.sensors[sensor_class] = sensor;
  });
  require(world_.sensor(sensor_class) == sensor, "a sensor is not what was set");
}

/// The body becomes haunted, or stops being so; this alters the answers of the pair filter.
void Player::haunt(const Operation& operation) {
  const auto id = any(operation);
  if (!id) return;
  refresh_filter({*id}, [&] {
    truth_.haunt(*id);
    accepted(on_world([&](World& world) { return world.refresh_filter(*id); }));
  });
}

/// Returns an empty filter if there is none.
PairFilter Player::pair_filter() const {
  if (!truth_.has_pair_filter) return {};
  return [this](BodyId a, BodyId b) { return truth_.pair_filter(a, b); };
}

void Player::give_pair_filter(World& world) const { accepted(world.set_pair_filter(pair_filter())); }

/// Sets the earlier pair filter again, since copies of a world have none.
void Player::give_pair_filters() {
  give_pair_filter(world_);
  if (twin_) give_pair_filter(*twin_);
  for (const BodyId id : truth_.ids()) told_.refiltered(id, {});
  changed();
}

void Player::set_pair_filter(const Operation& operation) {
  if (kind_.crowd) return;
  refresh_filter(truth_.ids(), [&] {
    truth_.has_pair_filter = operation.byte(0) % 4 != 0;
    give_pair_filter(world_);
    if (twin_) give_pair_filter(*twin_);
  });
}

}  // namespace kinesphere::stream
