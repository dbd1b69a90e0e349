// Random changes of the world, and the same of the truth.
#include <algorithm>

#include "number/infinity.hpp"
#include "stream/player.hpp"

namespace kinesphere::stream {

// New bodies. Those for which there is no room are refused.

/// Checks that a body was refused for a reason, where it is now said to be.
void Player::check_refusal(const Error& error, const Thing& thing) const {
  if (error.code != ErrorCode::overlapping) return;
  const auto overlaps = [&](const Thing& other) {
    const double errors = 2.0 * (thing.definition.position_error + other.definition.position_error);
    return other.id != thing.id && thing.definition.solid && other.definition.solid &&
           truth_.meet(thing, other) &&
           truth_.gaps.between(thing, other, now()) < truth_.slack() + errors - truth_.tolerance();
  };
  if (scenario().overlaps || std::ranges::none_of(truth_.things, overlaps))
    throw Disagreement("refused without an overlap: " + error.message);
}

void Player::come() {
  if (world_.size() > 2 * static_cast<std::size_t>(scenario().bodies) + 10) return;
  if (scenario().rigid && draw_.one_in(2)) return come_rigid();
  begin_change("add");
  BodyDefinition body = draw_.body(draw_.radius());
  if (scenario().radii && draw_.one_in(2)) body.radius_rate = draw_.radius_rate();
  body.user_data = draw_.below(1000);
  Thing ball;
  ball.start(body, now());
  auto id = world_.add(body);
  if (!id) {
    check_refusal(id.error(), ball);
    body.radius *= 0.3;
    body.radius_rate = 0.0;
    ball.start(body, now());
    id = world_.add(body);
  }
  if (!id) return check_refusal(id.error(), ball);
  ball.id = *id;
  truth_.put(ball);
  truth_.last_change = now();
}

void Player::come_together() {
  begin_change("add_all");
  const std::array bodies{draw_.body(draw_.radius()), draw_.body(draw_.radius())};
  const auto ids = world_.add_all(bodies);
  if (!ids) return;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    Thing ball{.id = (*ids)[k]};
    ball.start(bodies[k], now());
    truth_.put(ball);
  }
  truth_.last_change = now();
}

void Player::come_rigid() {
  begin_change("add_rigid_body");
  RigidBody body{.body = draw_.body(1.0), .parts = draw_.parts()};
  Thing rigid{.sort = Sort::rigid, .largest_spin = 6.0 / scenario().unit_time()};
  rigid.spin = {now(), draw_.orientation(), draw_.axis()};
  if (!draw_.one_in(4)) rigid.spin.speed = 0.5 * rigid.largest_spin * draw_.uniform();
  if (scenario().spins && draw_.one_in(2))
    rigid.spin_limit = 8.0 / (scenario().unit_time() * scenario().unit_time());
  body.rotation = rigid.spin.at(now());
  body.angular_acceleration_limit = rigid.spin_limit;
  if (rigid.spin_limit > 0.0 || draw_.one_in(2))
    body.largest_angular_speed = rigid.largest_spin;
  else
    rigid.largest_spin = 100.0 / scenario().unit_time();
  const Vec3 moments = scenario().flat ? Vec3{0.0, 0.0, 0.3} : Vec3{0.2, 0.25, 0.3};
  body.inertia = moments * lengths(scenario().unit_length());
  const auto id = world_.add_rigid_body(body);
  if (!id) return;
  rigid.id = *id;
  rigid.set_parts(body.parts, scenario().unit_length());
  rigid.start(body.body, now());
  truth_.put(rigid);
  truth_.last_change = now();
}

void Player::build(bool is_zone) {
  begin_change("build");
  Thing thing{.sort = Sort::fixed};
  const Shape shape = draw_.shape();
  const auto id = is_zone ? world_.add_zone(shape) : world_.add_static({.shape = shape});
  if (!id) return;
  thing.id = *id;
  thing.definition.solid = !is_zone;
  thing.definition.sensor_class = is_zone ? zone_class : SensorClass{0};
  if (is_zone) truth_.sensors[zone_class] = world_.sensor(zone_class);
  thing.set_shape(shape, now(), scenario().unit_length(), scenario().flat);
  truth_.put(thing);
  truth_.last_change = now();
}

void Player::carry() {
  begin_change("add_moving_shape");
  const MovingShape body{draw_.body(0.0), draw_.carried_shape()};
  const auto id = world_.add_moving_shape(body);
  if (!id) return;
  Thing thing{.id = *id, .sort = Sort::carried};
  thing.start(body.body, now());
  thing.set_shape(body.shape, now(), scenario().unit_length(), scenario().flat);
  truth_.put(thing);
  truth_.last_change = now();
}

void Player::build() {
  if (!scenario().statics) return;
  if (scenario().carried && draw_.one_in(2)) return carry();
  build(scenario().zones && draw_.one_in(3));
}

/// Notes that a body has been removed.
void Player::leave(Thing& thing) {
  thing.alive = false;
  truth_.haunted.erase(thing.id);
  woken_.erase(thing.id);
  if (removed_.size() == 8) removed_.erase(removed_.begin());
  removed_.push_back(thing.id);
  restarted(thing.id);
}

void Player::remove() {
  Thing* const thing = this->thing();
  if (!thing || world_.size() < 3) return;
  begin_change("remove");
  world_.remove(thing->id).value();
  leave(*thing);
}

void Player::remove_some() {
  std::vector<BodyId> ids = world_.bodies();
  const std::size_t count = draw_.below(3);
  if (ids.size() < count + 3) return;
  begin_change("remove some");
  ids.erase(ids.begin(), ids.begin() + static_cast<std::ptrdiff_t>(draw_.below(ids.size() - count)));
  ids.resize(count);
  world_.remove(ids).value();
  for (const BodyId id : ids) truth_.at(id).alive = false;
  for (const BodyId id : ids) leave(truth_.at(id));
}

void Player::switch_on_or_off() {
  if (!this->thing()) return;
  Thing& thing = *this->thing();
  if (thing.enabled) {
    begin_change("disable");
    world_.disable(thing.id).value();
    thing.enabled = thing.sleeping = false;
    woken_.erase(thing.id);
    return restarted(thing.id);
  }
  begin_change("enable");
  const State to = draw_.state();
  const auto done = world_.enable(thing.id, to);
  thing.enabled = true;
  if (thing.moves())
    thing.path = {now(), vector(to.position), vector(to.velocity),
                  vector(thing.definition.planned_acceleration)};
  if (!done) {
    // Of a rigid body the truth does not know how it has turned.
    if (thing.sort != Sort::rigid) check_refusal(done.error(), thing);
    thing.enabled = false;
    return;
  }
  if (thing.sort == Sort::rigid) {
    const auto [orientation, velocity] = world_.body(thing.id)->rigid->rotation;
    const double speed = norm(velocity);
    thing.spin = {now(), orientation, speed > 0.0 ? velocity / speed : Vec3{0.0, 0.0, 1.0}, speed};
  }
  restarted(thing.id);
}

// Motion.

void Player::set_velocity() {
  Thing* const thing = moving_thing();
  if (!thing) return;
  begin_change("set_velocity");
  turn(thing->id, draw_.velocity());
  restarted(thing->id);
}

void Player::teleport() {
  if (Thing* const thing = moving_thing()) teleport(*thing, draw_.state());
}

/// Teleports a body by so little that it may stay in its contacts, or leave them by a hair.
void Player::nudge() {
  Thing* const thing = moving_thing();
  if (!thing) return;
  const double length = draw_.one_in(2) ? lengths(0.02) : 8.0 * truth_.tolerance();
  const State state = state_of(*thing, now());
  teleport(*thing, {state.position + length * draw_.point_in_ball(), state.velocity});
}

void Player::teleport(Thing& thing, const State& to) {
  begin_change("teleport");
  if (thing.sort == Sort::rigid && thing.spin_limit != 0.0) {
    // The world does not know how the body has turned until now.
    const Rotation turned = thing.spin.at(now());
    if (!world_.change(thing.id, {.rotation = turned})) return;
    thing.spin = {now(), turned.orientation, thing.spin.axis, thing.spin.speed_at(now())};
    restarted(thing.id);
  }
  const auto done = world_.teleport(thing.id, to);
  Thing moved = thing;
  moved.path.since = now();
  moved.path.position = vector(to.position);
  moved.path.velocity = vector(to.velocity);
  if (!done) return check_refusal(done.error(), moved);
  check_awake();
  moved.sleeping = thing.sleeping;
  moved.path.acceleration = thing.path.acceleration;
  thing = moved;
  restarted(thing.id);
}

void Player::set_limits() {
  if (!this->thing() || !this->thing()->moves()) return;
  Thing& thing = *this->thing();
  begin_change("motion_limits");
  MotionLimits limits = motion_limits_of(thing.definition);
  limits.acceleration_limit = scenario().steered ? draw_.acceleration() : 0.0;
  if (!world_.change(thing.id, {.motion_limits = limits})) return;
  check_awake(std::vector{thing.id});
  thing.definition.acceleration_limit = limits.acceleration_limit;
  const State state = state_of(thing, now());
  thing.path = {now(), vector(state.position), vector(state.velocity), vector(limits.planned_acceleration)};
  restarted(thing.id);
}

/// Returns a spin that starts from the present orientation.
Spin Player::any_spin(const Thing& thing) {
  const double most = 0.5 * std::min(thing.largest_spin, 6.0 / scenario().unit_time());
  return {now(), thing.spin.at(now()).orientation, draw_.axis(), most * draw_.uniform()};
}

void Player::set_spin() {
  if (!moving_thing() || moving_thing()->sort != Sort::rigid) return;
  Thing& thing = *moving_thing();
  begin_change("angular_velocity");
  const Spin spin = any_spin(thing);
  world_.change(thing.id, {.angular_velocity = spin.at(now()).angular_velocity}).value();
  thing.spin = spin;
  restarted(thing.id);
}

void Player::set_rotation() {
  if (!moving_thing() || moving_thing()->sort != Sort::rigid) return;
  Thing& thing = *moving_thing();
  begin_change("rotation");
  Spin spin = any_spin(thing);
  spin.orientation = draw_.orientation();
  if (!world_.change(thing.id, {.rotation = spin.at(now())})) return;
  thing.spin = spin;
  restarted(thing.id);
}

void Player::sleep_or_wake() {
  if (!scenario().resting || !moving_thing()) return;
  Thing& thing = *moving_thing();
  if (thing.sleeping) {
    begin_change("wake");
    world_.wake(thing.id).value();
    check_awake(std::vector{thing.id});
  } else {
    if (!can_rest(thing)) return;
    begin_change("sleep");
    rest(thing);
  }
  restarted(thing.id);
}

// Sizes and shapes.

void Player::set_radius() {
  if (!this->thing() || this->thing()->sort != Sort::ball) return;
  Thing& thing = *this->thing();
  begin_change("radius");
  const double radius = draw_.radius();
  const auto done = world_.change(thing.id, {.radius = radius});
  Thing grown = thing;
  grown.radius = {now(), radius, thing.radius.rate};
  if (!done) return check_refusal(done.error(), grown);
  check_awake();
  thing.radius = grown.radius;
  restarted(thing.id);
}

void Player::set_radius_rate() {
  if (!this->thing() || this->thing()->sort != Sort::ball || !scenario().radii || this->thing()->sleeping)
    return;
  Thing& thing = *this->thing();
  begin_change("radius_rate");
  const double rate = draw_.one_in(3) ? 0.0 : draw_.radius_rate();
  if (!world_.change(thing.id, {.radius_rate = rate})) return;
  thing.radius = {now(), thing.radius.at(now()), rate};
  restarted(thing.id);
}

void Player::set_shape() {
  if (!this->thing() || !this->thing()->has_shape()) return;
  Thing& thing = *this->thing();
  begin_change("set_shape");
  const Shape shape = thing.sort == Sort::carried ? draw_.carried_shape() : draw_.shape();
  if (!world_.set_shape(thing.id, shape)) return;
  check_awake();
  thing.set_shape(shape, now(), scenario().unit_length(), scenario().flat);
  restarted(thing.id);
}

// Who meets whom.

void Player::set_filter() {
  if (!scenario().filters || !this->thing()) return;
  Thing& thing = *this->thing();
  begin_change("filter");
  const Filter filter = draw_.filter();
  world_.change(thing.id, {.filter = filter}).value();
  thing.definition.filter = filter;
  restarted(thing.id);
}

/// Returns an empty filter if there is none.
PairFilter Player::pair_filter() const {
  if (!truth_.has_pair_filter) return {};
  return [this](BodyId a, BodyId b) { return truth_.passes_pair_filter(a, b); };
}

void Player::set_pair_filter() {
  if (!scenario().pair_filter) return;
  begin_change("set_pair_filter");
  truth_.has_pair_filter = !draw_.one_in(4);
  world_.set_pair_filter(pair_filter()).value();
  for (const BodyId id : world_.bodies()) restarted(id);
}

/// The body becomes haunted, or stops being so; this alters the answers of the pair filter.
void Player::haunt() {
  if (!scenario().pair_filter || !this->thing()) return;
  begin_change("refresh_filter");
  const BodyId id = this->thing()->id;
  if (!truth_.haunted.insert(id).second) truth_.haunted.erase(id);
  world_.refresh_filter(id).value();
  restarted(id);
}

void Player::set_user_data() {
  if (!this->thing()) return;
  Thing& thing = *this->thing();
  thing.definition.user_data = draw_.below(1000);
  world_.change(thing.id, {.user_data = thing.definition.user_data}).value();
}

void Player::set_solid() {
  if (!this->thing()) return;
  Thing& thing = *this->thing();
  begin_change("solid");
  const bool solid = !draw_.one_in(3);
  if (!world_.change(thing.id, {.solid = solid})) return;
  thing.definition.solid = solid;
  restarted(thing.id);
}

void Player::set_sensor_class() {
  if (!scenario().sensors || !this->thing()) return;
  Thing& thing = *this->thing();
  begin_change("sensor_class");
  const auto sensor_class = static_cast<SensorClass>(draw_.below(2));
  if (!world_.change(thing.id, {.sensor_class = sensor_class})) return;
  thing.definition.sensor_class = sensor_class;
  restarted(thing.id);
}

void Player::set_sensor() {
  if (!scenario().sensors) return;
  begin_change("set_sensor");
  const Sensor sensor = draw_.sensor();
  if (!world_.set_sensor(1, sensor)) return;
  truth_.sensors[1] = sensor;
  truth_.last_change = now();
}

}  // namespace kinesphere::stream
