// Operations that must not change the course of the world: restored worlds and clones, queries, and refused
// calls.
#include <algorithm>

#include "kinesphere/certificates.hpp"
#include "kinesphere/queries.hpp"
#include "stream/on_world.hpp"
#include "stream/player.hpp"

namespace kinesphere::stream {

/// Replaces the world by the restored one, or gives it a twin that must agree with it to the last bit from
/// now on.
void Player::restore(const Operation& operation) {
  const std::vector<std::byte> bytes = world_.save().value();
  if (twin_ && twin_saves_the_same_)
    require(twin_->save().value() == bytes, "a restored world is not what the saved one became");
  twin_.reset();
  auto restored = operation.byte(1) % 4 == 0 ? world_.clone() : World::restore(bytes, pair_filter());
  if (!restored) throw Disagreement("restore: " + restored.error().message);
  require(restored->save().value() == bytes, "a restored world saves other bytes");
  give_rotation_probe(*restored);
  if (operation.byte(0) % 2 == 0)
    world_ = std::move(*restored);
  else
    twin_ = std::move(*restored);
  twin_saves_the_same_ = true;
  if (truth_.has_pair_filter) give_pair_filters();
}

/// Queries with or without a probe; all answers must contain the truth.
void Player::ask(const Operation& operation) {
  const auto id = any(operation);
  const std::vector<BodyId> ids = truth_.ids();
  if (!id || ids.size() < 2) return;
  const BodyId other = ids[(operation.body() + 1u + operation.byte(0) % (ids.size() - 1)) % ids.size()];
  const bool probes = operation.byte(1) % 2 == 0;
  const double slack = 1e-3 * truth_.definition().contact_tolerance + 1e-12;
  if (*id != other && truth_.is_present(*id) && truth_.is_present(other) &&
      !(truth_.at(*id).fixed && truth_.at(other).fixed)) {
    const double now = truth_.time();
    for (World* world : {&world_, twin_ ? &*twin_ : nullptr}) {
      if (world == nullptr) continue;
      const auto limits = probes ? world->certificates(probe()).distance_limits(*id, other, now)
                                 : std::as_const(*world).certificates().distance_limits(*id, other, now);
      if (!limits) throw Disagreement("distance_limits: " + limits.error().message);
      const double gap = truth_.gap(id->index < other.index ? Contact{*id, other} : Contact{other, *id});
      // Of rigid bodies that overlap the truth does not know how deep.
      const bool is_deep = gap <= 0.0 && (is_rigid(*id) || is_rigid(other));
      require(is_deep || (limits->lower <= gap + slack && gap <= limits->upper + slack),
              "distance_limits do not hold the distance");
    }
  }
  const Vec3 centre = truth_.in_space(operation.position());
  const double radius = this->radius(operation);
  for (World* world : {&world_, twin_ ? &*twin_ : nullptr}) {
    if (world == nullptr) continue;
    const auto found = probes ? world->queries(probe()).overlapping(centre, radius)
                              : std::as_const(*world).queries().overlapping(centre, radius);
    if (!found) throw Disagreement("overlapping: " + found.error().message);
    for (const BodyId body : ids) {
      if (!truth_.is_present(body)) continue;
      const double gap = truth_.distance(body, centre);
      const auto entry = std::find_if(found->begin(), found->end(),
                                      [=](const OverlapHit& candidate) { return candidate.body == body; });
      if (entry == found->end())
        require(gap >= radius - slack, "overlapping() leaves out a body that overlaps");
      else if (entry->certainty == Certainty::certainly || (probes && !is_rigid(body)))
        require(gap <= radius + slack, "overlapping() names a body that does not overlap");
    }
  }
}

/// Makes calls that the world must refuse, without any change.
void Player::call_wrongly(const Operation& operation) {
  const std::vector<std::byte> before = world_.save().value();
  const auto refused = [&](const auto& result, ErrorCode code) {
    require(!result, "a wrong call is not refused");
    if (result.error().code != code)
      throw Disagreement("a wrong call is refused for a wrong reason: " + result.error().message);
  };
  const auto id = any(operation);
  const State state{truth_.in_space(operation.position()), truth_.in_space(operation.velocity())};
  BodyId wrong{operation.byte(0) + 1000u, 0};
  ErrorCode code = ErrorCode::unknown_body;
  if (!removed_.empty() && operation.byte(1) % 2 == 0) {
    wrong = removed_[operation.byte(0) % removed_.size()];
    code = ErrorCode::stale_body;
  }
  const std::vector<BodyId> wrong_batch = id ? std::vector{*id, wrong} : std::vector{wrong};
  const std::vector<BodyDefinition> bad_batch{{.radius = 0, .position = state.position}, {.radius = -1}};
  if (id && kind_.rigid) turn_wrongly(*id, operation);
  switch (operation.byte(2) % 16) {
    case 0:
      refused(world_.remove(wrong), code);
      refused(world_.remove(wrong_batch), code);
      break;
    case 1:
      refused(world_.set_velocity(wrong, {}), code);
      refused(world_.teleport(wrong, state), code);
      break;
    case 2:
      refused(world_.disable(wrong), code);
      refused(world_.enable(wrong, state), code);
      break;
    case 3:
      refused(world_.change(wrong, {.radius = 1}), code);
      refused(world_.change(wrong, {.motion_limits = MotionLimits{}}), code);
      break;
    case 4:
      refused(world_.change(wrong, {.filter = Filter{}}), code);
      refused(world_.refresh_filter(wrong), code);
      refused(world_.change(wrong, {.solid = true}), code);
      refused(world_.change(wrong, {.sensor_class = 1}), code);
      refused(world_.set_sensor(1, {.distances = {0.5, -1.0}}), ErrorCode::out_of_range);
      break;
    case 5:
      refused(world_.change(wrong, {.user_data = 1}), code);
      refused(world_.user_data(wrong), code);
      refused(world_.body(wrong), code);
      refused(world_.touching(wrong), code);
      refused(world_.sensor_overlaps(wrong), code);
      break;
    case 6:
      refused(world_.add({.radius = nan}), ErrorCode::not_finite);
      refused(world_.add_all(bad_batch),
              truth_.definition().allow_overlap ||
                      has_room(no_body, {bound_of(bad_batch[0], {state.position, {}}, truth_.time())},
                               bad_batch[0])
                  ? ErrorCode::out_of_range
                  : ErrorCode::overlapping);
      break;
    case 7:
      refused(world_.advance(nan, probe()), ErrorCode::not_finite);
      refused(world_.advance(world_.time() - 1e-3, probe()), ErrorCode::time_backwards);
      break;
    case 8:
      if (!id) break;
      if (truth_.at(*id).fixed) {
        refused(world_.change(*id, {.radius = 0.5}), ErrorCode::static_body);
        refused(world_.change(*id, {.motion_limits = MotionLimits{}}), ErrorCode::static_body);
        refused(world_.set_velocity(*id, {}), ErrorCode::static_body);
        refused(world_.teleport(*id, state), ErrorCode::static_body);
        refused(world_.add_static({.shape = HalfSpace{{1, 1, 0}, 0}}), ErrorCode::out_of_range);
      } else {
        if (!is_rigid(*id)) refused(world_.change(*id, {.radius = -0.5}), ErrorCode::out_of_range);
        refused(world_.change(*id, {.motion_limits = MotionLimits{.acceleration_limit = nan}}),
                ErrorCode::not_finite);
      }
      break;
    case 9:
      if (!id || truth_.at(*id).fixed) break;
      if (truth_.is_present(*id)) {
        refused(world_.enable(*id, state), ErrorCode::enabled_body);
        refused(world_.set_velocity(*id, {nan, 0, 0}), ErrorCode::not_finite);
        refused(world_.teleport(*id, {{0, nan, 0}, {}}), ErrorCode::not_finite);
      } else {
        refused(world_.disable(*id), ErrorCode::disabled_body);
        refused(world_.set_velocity(*id, {}), ErrorCode::disabled_body);
        refused(world_.teleport(*id, state), ErrorCode::disabled_body);
        refused(world_.enable(*id, {{0, 0, nan}, {}}), ErrorCode::not_finite);
      }
      break;
    case 10:
      if (id) refused(world_.remove(std::vector{*id, *id}), ErrorCode::stale_body);
      break;
    case 11:
      refused(world_.certificates().safe_until(wrong), code);
      refused(world_.certificates().earliest_contact(wrong), code);
      refused(world_.certificates().safe_until(wrong, wrong), code);
      refused(world_.certificates().distance_limits(wrong, wrong, world_.time()), code);
      break;
    case 12:
      refused(world_.queries().overlapping({nan, 0, 0}, 1), ErrorCode::not_finite);
      refused(world_.queries().nearest({0, nan, 0}, 1), ErrorCode::not_finite);
      refused(world_.queries().ray_cast({}, {}, 1), ErrorCode::out_of_range);
      refused(world_.queries().sphere_cast({}, -1, {1, 0, 0}, 1), ErrorCode::out_of_range);
      break;
    default: {
      std::vector<std::byte> damaged = before;
      damaged[operation.random().bits() % damaged.size()] ^= std::byte{1};
      refused(World::restore(damaged), ErrorCode::bad_snapshot);
    }
  }
  require(world_.save().value() == before, "a call that was refused has changed the world");
}

}  // namespace kinesphere::stream
