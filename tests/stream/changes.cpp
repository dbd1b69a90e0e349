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

/// In a world without overlaps it lies in the box as a whole.
BodyDefinition Player::new_body(const Operation& operation) const {
  const MotionPromise promise = operation.promise();
  BodyDefinition body = with_promise({.radius = operation.radius(),
                                      .position = operation.position(),
                                      .velocity = operation.velocity(),
                                      .filter = operation.filter(),
                                      .user_data = operation.code()},
                                     promise);
  if (operation.byte(8) % 8 == 0) body.velocity = {};
  const WorldDefinition& world = truth_.definition();
  if (!world.allow_overlap && world.box)
    for (int axis = 0; axis < 3; ++axis)
      body.position[axis] = std::clamp(body.position[axis], body.radius, world_size - body.radius);
  return body;
}

/// Whether nothing keeps a body, with this bound and filter, from being there where overlaps are refused.
bool Player::has_room(BodyId id, const Bound& bound, const Filter& filter) const {
  if (truth_.definition().allow_overlap) return true;
  for (const TrueBody& other : truth_.bodies()) {
    if (!other.present() || other.id == id || !truth_.passes_filters(id, filter, other.id)) continue;
    const GapLimits gap = gap_limits(bound, world_.body(other.id).value().bound, truth_.time());
    if (gap.upper < -truth_.definition().contact_tolerance) return false;
  }
  return true;
}

void Player::join(BodyId id, const BodyDefinition& body, const Operation& operation) {
  truth_.add(id, body, operation.acceleration(promise_of(body)));
  told_.appeared(id);
  changed();
}

void Player::add(const Operation& operation) {
  if (truth_.ids().size() >= most_bodies_) return;
  const BodyDefinition body = new_body(operation);
  const Bound bound = bound_of(body, {body.position, body.velocity}, truth_.time());
  const bool room = has_room(no_body, bound, body.filter);
  const auto id = on_world([&](World& world) { return world.add(body); });
  require(static_cast<bool>(id) == room, "add: overlaps are refused wrongly");
  if (!id) return require(id.error().code == ErrorCode::overlapping, "add: refused for a wrong reason");
  join(*id, body, operation);
}

void Player::add_all(const Operation& operation) {
  if (truth_.ids().size() + 2 > most_bodies_) return;
  const BodyDefinition first = new_body(operation);
  BodyDefinition second = first;
  second.position = Vec3{world_size, world_size, world_size} - first.position;
  const std::vector<BodyDefinition> bodies{first, second};
  const auto ids = on_world([&](World& world) { return world.add_all(bodies); });
  if (!ids) {
    require(!truth_.definition().allow_overlap && ids.error().code == ErrorCode::overlapping,
            "add_all: refused for a wrong reason");
    return;
  }
  for (std::size_t k = 0; k < bodies.size(); ++k) join((*ids)[k], bodies[k], operation);
}

void Player::leave(BodyId id, const std::vector<Before>& before) {
  told_.gone(before);
  truth_.remove(id);
  if (removed_.size() == 8) removed_.erase(removed_.begin());
  removed_.push_back(id);
  changed();
}

void Player::remove(const Operation& operation) {
  const auto id = any(operation);
  if (!id || truth_.ids().size() < 3) return;
  const auto before = told_.before(world_, *id);
  accepted(on_world([&](World& world) { return world.remove(*id); }));
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
  for (const BodyId id : ids) before.push_back(told_.before(world_, id));
  accepted(on_world([&](World& world) { return world.remove_all(ids); }));
  for (std::size_t k = 0; k < ids.size(); ++k) leave(ids[k], before[k]);
}

void Player::kick(BodyId id, const Vec3& velocity) {
  accepted(on_world([&](World& world) { return world.kick(id, velocity); }));
  truth_.move(id, {truth_.state(id).position, velocity});
  told_.kicked(id);
  changed();
}

void Player::kick(const Operation& operation) {
  const auto id = any(operation);
  if (id && truth_.is_present(*id)) kick(*id, operation.velocity());
}

/// Bodies that have strayed far are sent back.
void Player::send_back() {
  for (const BodyId id : truth_.ids()) {
    if (!truth_.is_present(id)) continue;
    const State state = truth_.state(id);
    const Vec3 out = state.position - Vec3{0.5, 0.5, 0.5} * world_size;
    if (norm(out) > 1.5 * world_size && dot(out, state.velocity) > 0.0) kick(id, out * (-0.3));
  }
}

/// The world learns nothing of it.
void Player::steer(const Operation& operation) {
  const auto id = any(operation);
  if (id) truth_.steer(*id, operation.acceleration(promise_of(truth_.at(*id).definition)));
}

void Player::teleport(BodyId id, const State& state) {
  const auto before = told_.before(world_, id);
  const BodyDefinition& body = truth_.at(id).definition;
  const bool room = has_room(id, bound_of(body, state, truth_.time()), body.filter);
  const auto done = on_world([&](World& world) { return world.teleport(id, state); });
  require(static_cast<bool>(done) == room, "teleport: overlaps are refused wrongly");
  if (!done) return require(done.error().code == ErrorCode::overlapping, "teleport: a wrong reason");
  truth_.move(id, state);
  told_.replaced(world_, id, before);
  told_.teleported(id);
  changed();
}

/// Where a body that has this radius may be put.
State Player::place(const Operation& operation, double radius) const {
  Operation same = operation;
  BodyDefinition body = new_body(same);
  const WorldDefinition& world = truth_.definition();
  if (!world.allow_overlap && world.box)
    for (int axis = 0; axis < 3; ++axis)
      body.position[axis] = std::clamp(operation.position()[axis], radius, world_size - radius);
  return {body.position, body.velocity};
}

void Player::teleport(const Operation& operation) {
  const auto id = any(operation);
  if (!id || !truth_.is_present(*id)) return;
  teleport(*id, place(operation, truth_.at(*id).definition.radius));
}

/// A teleport so short that the body may stay in its contacts, or leave them by a hair.
void Player::nudge(const Operation& operation) {
  const auto id = any(operation);
  if (!id || !truth_.is_present(*id)) return;
  const WorldDefinition& world = truth_.definition();
  State state = truth_.state(*id);
  const double length = operation.byte(3) % 2 == 0 ? 0.02 : 8.0 * world.contact_tolerance;
  state.position += length * operation.random().point_in_ball();
  const double reach = world.allow_overlap ? 0.0 : truth_.at(*id).definition.radius;
  for (int axis = 0; axis < 3 && world.box; ++axis)
    state.position[axis] = std::clamp(state.position[axis], reach, world_size - reach);
  teleport(*id, state);
}

void Player::set_radius(const Operation& operation) {
  const auto id = any(operation);
  if (!id) return;
  const double radius = operation.radius();
  const auto before = truth_.is_present(*id) ? told_.before(world_, *id) : std::vector<Before>();
  const bool strict = !truth_.definition().allow_overlap;
  const auto done = on_world([&](World& world) { return world.set_radius(*id, radius); });
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
    require(has_room(*id, world_.body(*id).value().bound, truth_.at(*id).definition.filter),
            "set_radius: an overlap is not refused");
  told_.replaced(world_, *id, before);
  changed();
}

void Player::set_promise(const Operation& operation) {
  const auto id = any(operation);
  if (!id) return;
  const MotionPromise promise = operation.promise();
  const auto before = truth_.is_present(*id) ? told_.before(world_, *id) : std::vector<Before>();
  accepted(on_world([&](World& world) { return world.set_promise(*id, promise); }));
  truth_.at(*id).definition = with_promise(truth_.at(*id).definition, promise);
  truth_.steer(*id, operation.acceleration(promise));
  if (!truth_.is_present(*id)) return;
  told_.replaced(world_, *id, before);
  changed();
}

void Player::turn_off(const Operation& operation) {
  const auto id = any(operation);
  if (!id || !truth_.is_present(*id)) return;
  const auto before = told_.before(world_, *id);
  accepted(on_world([&](World& world) { return world.disable(*id); }));
  told_.gone(before);
  truth_.at(*id).enabled = false;
  changed();
}

/// The first disabled body comes back.
void Player::turn_on(const Operation& operation) {
  const auto off = std::find_if(truth_.bodies().begin(), truth_.bodies().end(),
                                [](const TrueBody& body) { return body.alive && !body.enabled; });
  if (off == truth_.bodies().end()) return;
  const BodyId id = off->id;
  const State state = place(operation, off->definition.radius);
  const bool room = has_room(id, bound_of(off->definition, state, truth_.time()), off->definition.filter);
  const auto done = on_world([&](World& world) { return world.enable(id, state); });
  require(static_cast<bool>(done) == room, "enable: overlaps are refused wrongly");
  if (!done) return require(done.error().code == ErrorCode::overlapping, "enable: a wrong reason");
  truth_.move(id, state);
  truth_.at(id).enabled = true;
  told_.appeared(id);
  changed();
}

void Player::set_user_data(const Operation& operation) {
  const auto id = any(operation);
  if (!id) return;
  const std::uint64_t data = operation.random().bits();
  accepted(on_world([&](World& world) { return world.set_user_data(*id, data); }));
  truth_.at(*id).definition.user_data = data;
}

// Filters.

void Player::set_filter(const Operation& operation) {
  const auto id = any(operation);
  if (!id) return;
  const auto before = told_.before(world_, *id);
  accepted(on_world([&](World& world) { return world.set_filter(*id, operation.filter()); }));
  truth_.at(*id).definition.filter = operation.filter();
  told_.refiltered(*id, before);
  changed();
}

/// The body becomes one of the haunted, or is so no longer: the pair filter answers otherwise.
void Player::haunt(const Operation& operation) {
  const auto id = any(operation);
  if (!id) return;
  const auto before = told_.before(world_, *id);
  truth_.haunt(*id);
  accepted(on_world([&](World& world) { return world.refilter(*id); }));
  told_.refiltered(*id, before);
  changed();
}

void Player::give_pair_filter(World& world) const {
  PairFilter filter;
  if (truth_.has_pair_filter) filter = [this](BodyId a, BodyId b) { return truth_.pair_filter(a, b); };
  accepted(world.set_pair_filter(std::move(filter)));
}

void Player::set_pair_filter(const Operation& operation) {
  const std::vector<BodyId> ids = truth_.ids();
  std::vector<std::vector<Before>> before;
  for (const BodyId id : ids) before.push_back(told_.before(world_, id));
  truth_.has_pair_filter = operation.byte(0) % 4 != 0;
  give_pair_filter(world_);
  if (twin_) give_pair_filter(*twin_);
  for (std::size_t k = 0; k < ids.size(); ++k) told_.refiltered(ids[k], before[k]);
  changed();
}

}  // namespace kinesphere::stream
