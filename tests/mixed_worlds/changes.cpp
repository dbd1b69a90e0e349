// Random changes of the world, and the same of the truth.
#include "kinesphere/world.hpp"
#include "mixed_worlds/player.hpp"
#include "number/infinity.hpp"

namespace kinesphere::mixed {

/// Some are there twice, so that they come more often.
const std::array<Player::Change, 23> Player::changes{&Player::come,
                                                     &Player::replace,
                                                     &Player::set_velocity,
                                                     &Player::set_velocity,
                                                     &Player::teleport,
                                                     &Player::teleport,
                                                     &Player::switch_on_or_off,
                                                     &Player::switch_on_or_off,
                                                     &Player::set_radius,
                                                     &Player::set_radius,
                                                     &Player::set_radius_rate,
                                                     &Player::set_radius_rate,
                                                     &Player::set_limits,
                                                     &Player::set_filter,
                                                     &Player::set_solid,
                                                     &Player::set_sensor_class,
                                                     &Player::set_spin,
                                                     &Player::set_rotation,
                                                     &Player::sleep_or_wake,
                                                     &Player::sleep_or_wake,
                                                     &Player::set_shape,
                                                     &Player::set_sensor,
                                                     &Player::build};

void Player::change_any() {
  const std::vector<BodyId> ids = world_.bodies();
  if (ids.empty()) return come();
  const Change change = draw_.any_of(changes);
  (this->*change)(truth_.at(draw_.any_of(ids)));
}

// New bodies. Those for which there is no room are refused.

void Player::come() {
  if (scenario().rigid && draw_.one_in(2)) return come_rigid();
  begin_change("add");
  BodyDefinition body = draw_.body(draw_.radius());
  if (scenario().radii && draw_.one_in(2)) body.radius_rate = draw_.radius_rate();
  auto id = world_.add(body);
  if (!id) {
    body.radius *= 0.3;
    body.radius_rate = 0.0;
    id = world_.add(body);
  }
  if (!id) return;
  Thing ball{.id = *id};
  ball.start(body, now());
  truth_.put(ball);
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

void Player::build(Thing&) {
  if (scenario().statics) build(scenario().zones && draw_.one_in(3));
}

void Player::replace(Thing& thing) {
  begin_change("remove");
  world_.remove(thing.id).value();
  thing.alive = false;
  restarted(thing.id);
  come();
}

void Player::switch_on_or_off(Thing& thing) {
  if (thing.enabled) {
    begin_change("disable");
    world_.disable(thing.id).value();
    thing.enabled = thing.sleeping = false;
    return restarted(thing.id);
  }
  begin_change("enable");
  const State to = draw_.state();
  if (!world_.enable(thing.id, to)) return;
  thing.enabled = true;
  if (thing.moves())
    thing.path = {now(), vector(to.position), vector(to.velocity),
                  vector(thing.definition.planned_acceleration)};
  if (thing.sort == Sort::rigid) {
    const auto [orientation, velocity] = world_.body(thing.id)->rigid->rotation;
    const double speed = norm(velocity);
    thing.spin = {now(), orientation, speed > 0.0 ? velocity / speed : Vec3{0.0, 0.0, 1.0}, speed};
  }
  restarted(thing.id);
}

// Motion.

void Player::set_velocity(Thing& thing) {
  if (!thing.moves() || !thing.enabled) return;
  begin_change("set_velocity");
  turn(thing.id, draw_.velocity());
  restarted(thing.id);
}

void Player::teleport(Thing& thing) {
  if (!thing.moves() || !thing.enabled) return;
  begin_change("teleport");
  const State to = draw_.state();
  if (!world_.teleport(thing.id, to)) return;
  thing.wake(now());
  thing.path.since = now();
  thing.path.position = vector(to.position);
  thing.path.velocity = vector(to.velocity);
  restarted(thing.id);
  if (thing.sort != Sort::rigid || thing.spin_limit == 0.0) return;
  // The world does not know how the body has turned until now.
  thing.spin = {now(), thing.spin.at(now()).orientation, thing.spin.axis, thing.spin.speed_at(now())};
  world_.change(thing.id, {.rotation = thing.spin.at(now())}).value();
}

void Player::set_limits(Thing& thing) {
  if (!thing.moves()) return;
  begin_change("motion_limits");
  MotionLimits limits = motion_limits_of(thing.definition);
  limits.acceleration_limit = scenario().steered ? draw_.acceleration() : 0.0;
  if (!world_.change(thing.id, {.motion_limits = limits})) return;
  thing.definition.acceleration_limit = limits.acceleration_limit;
  thing.path = {now(), thing.path.at(now()), thing.path.velocity_at(now()),
                vector(limits.planned_acceleration)};
  thing.sleeping = false;
  restarted(thing.id);
}

/// Returns a spin that starts from the present orientation.
Spin Player::any_spin(const Thing& thing) {
  const double most = 0.5 * std::min(thing.largest_spin, 6.0 / scenario().unit_time());
  return {now(), thing.spin.at(now()).orientation, draw_.axis(), most * draw_.uniform()};
}

void Player::set_spin(Thing& thing) {
  if (thing.sort != Sort::rigid || !thing.enabled) return;
  begin_change("angular_velocity");
  const Spin spin = any_spin(thing);
  world_.change(thing.id, {.angular_velocity = spin.at(now()).angular_velocity}).value();
  thing.spin = spin;
  restarted(thing.id);
}

void Player::set_rotation(Thing& thing) {
  if (thing.sort != Sort::rigid || !thing.enabled) return;
  begin_change("rotation");
  Spin spin = any_spin(thing);
  spin.orientation = draw_.orientation();
  if (!world_.change(thing.id, {.rotation = spin.at(now())})) return;
  thing.spin = spin;
  restarted(thing.id);
}

void Player::sleep_or_wake(Thing& thing) {
  if (!scenario().resting || !thing.enabled || !thing.moves()) return;
  if (thing.sleeping) {
    begin_change("wake");
    world_.wake(thing.id).value();
    thing.wake(now());
  } else {
    if (!can_rest(thing)) return;
    begin_change("sleep");
    rest(thing);
  }
  restarted(thing.id);
}

// Sizes and shapes.

void Player::set_radius(Thing& thing) {
  if (thing.sort != Sort::ball) return;
  begin_change("radius");
  const double radius = draw_.radius();
  if (!world_.change(thing.id, {.radius = radius})) return;
  thing.radius = {now(), radius, thing.radius.rate};
  thing.wake(now());
  restarted(thing.id);
}

void Player::set_radius_rate(Thing& thing) {
  if (thing.sort != Sort::ball || !scenario().radii || thing.sleeping) return;
  begin_change("radius_rate");
  const double rate = draw_.one_in(3) ? 0.0 : draw_.radius_rate();
  if (!world_.change(thing.id, {.radius_rate = rate})) return;
  thing.radius = {now(), thing.radius.at(now()), rate};
  restarted(thing.id);
}

void Player::set_shape(Thing& thing) {
  if (!thing.has_shape()) return;
  begin_change("set_shape");
  const Shape shape = thing.sort == Sort::carried ? draw_.carried_shape() : draw_.shape();
  if (!world_.set_shape(thing.id, shape)) return;
  thing.set_shape(shape, now(), scenario().unit_length(), scenario().flat);
  restarted(thing.id);
}

// Who meets whom.

void Player::set_filter(Thing& thing) {
  if (!scenario().filters) return;
  begin_change("filter");
  const Filter filter = draw_.filter();
  world_.change(thing.id, {.filter = filter}).value();
  thing.definition.filter = filter;
  restarted(thing.id);
}

void Player::set_solid(Thing& thing) {
  begin_change("solid");
  const bool solid = !draw_.one_in(3);
  if (!world_.change(thing.id, {.solid = solid})) return;
  thing.definition.solid = solid;
  restarted(thing.id);
}

void Player::set_sensor_class(Thing& thing) {
  if (!scenario().sensors) return;
  begin_change("sensor_class");
  const auto sensor_class = static_cast<SensorClass>(draw_.below(2));
  if (!world_.change(thing.id, {.sensor_class = sensor_class})) return;
  thing.definition.sensor_class = sensor_class;
  restarted(thing.id);
}

void Player::change_sensor() {
  begin_change("set_sensor");
  const Sensor sensor = draw_.sensor();
  if (!world_.set_sensor(1, sensor)) return;
  truth_.sensors[1] = sensor;
  truth_.last_change = now();
}

void Player::set_sensor(Thing&) {
  if (scenario().sensors) change_sensor();
}

}  // namespace kinesphere::mixed
