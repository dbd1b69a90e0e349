// Calls that the world must refuse, without any change.
#include "kinesphere/certificates.hpp"
#include "kinesphere/queries.hpp"
#include "stream/player.hpp"

namespace kinesphere::stream {

void Player::call_wrongly() {
  const std::vector<std::byte> before = world_.save().value();
  const auto refused = [&](const auto& result, ErrorCode code) {
    require(!result, "a wrong call is not refused");
    if (result.error().code != code)
      throw Disagreement("a wrong call is refused for a wrong reason: " + result.error().message);
  };
  const State state = draw_.state();
  BodyId wrong{static_cast<std::uint32_t>(100'000 + draw_.below(1000)), 0};
  ErrorCode code = ErrorCode::unknown_body;
  if (!removed_.empty() && draw_.one_in(2)) {
    wrong = draw_.any_of(removed_);
    code = ErrorCode::stale_body;
  }
  refused(world_.set_velocity(wrong, {}), code);
  refused(world_.teleport(wrong, state), code);
  refused(world_.disable(wrong), code);
  refused(world_.enable(wrong, state), code);
  refused(world_.change(wrong, {.radius = 1}), code);
  refused(world_.refresh_filter(wrong), code);
  refused(world_.body(wrong), code);
  refused(world_.touching(wrong), code);
  refused(world_.certificates().safe_until(wrong, wrong), code);
  refused(world_.set_sensor(1, {.distances = {0.5, -1.0}}), ErrorCode::out_of_range);
  refused(world_.add({.radius = nan}), ErrorCode::not_finite);
  refused(world_.advance(nan, probe()), ErrorCode::not_finite);
  refused(world_.advance(std::nextafter(now(), -infinity), probe()), ErrorCode::time_backwards);
  refused(world_.queries().overlapping({nan, 0, 0}, 1), ErrorCode::not_finite);
  refused(world_.queries().ray_cast({}, {}, 1), ErrorCode::out_of_range);
  if (const Thing* const thing = this->thing()) {
    const BodyId id = thing->id;
    refused(world_.remove(std::vector{id, wrong}), code);
    refused(world_.remove(std::vector{id, id}), ErrorCode::stale_body);
    if (!thing->moves()) {
      refused(world_.change(id, {.motion_limits = MotionLimits{}}), ErrorCode::static_body);
      refused(world_.set_velocity(id, {}), ErrorCode::static_body);
      refused(world_.teleport(id, state), ErrorCode::static_body);
    } else if (thing->enabled) {
      refused(world_.enable(id, state), ErrorCode::enabled_body);
      refused(world_.set_velocity(id, {nan, 0, 0}), ErrorCode::not_finite);
      refused(world_.teleport(id, {{0, nan, 0}, {}}), ErrorCode::not_finite);
    } else {
      refused(world_.disable(id), ErrorCode::disabled_body);
      refused(world_.set_velocity(id, {}), ErrorCode::disabled_body);
      refused(world_.enable(id, {{0, nan, 0}, {}}), ErrorCode::not_finite);
    }
    if (thing->sort == Sort::rigid) {
      refused(world_.change(id, {.radius = 0.5}), ErrorCode::unsupported);
      refused(world_.change(id, {.radius_rate = 0.5}), ErrorCode::unsupported);
      if (thing->enabled) {
        require(!world_.sleep(id), "a rigid body falls asleep");
        refused(world_.change(id, {.rotation = Rotation{{0, 0, 0, 0}, {}}}), ErrorCode::out_of_range);
        refused(world_.change(id, {.angular_velocity = Vec3{0, 0, nan}}), ErrorCode::not_finite);
      }
    } else if (thing->present() && thing->moves()) {
      refused(world_.change(id, {.angular_velocity = Vec3{0, 0, 1}}), ErrorCode::unsupported);
    }
  }
  std::vector<std::byte> damaged = before;
  damaged[draw_.below(damaged.size())] ^= std::byte{1};
  refused(World::restore(damaged), ErrorCode::bad_snapshot);
  require(world_.save().value() == before, "a call that was refused has changed the world");
}

}  // namespace kinesphere::stream
