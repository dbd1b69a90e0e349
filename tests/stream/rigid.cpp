// Rigid bodies of a stream: balls, capsules and hulls that turn, steadily or as a rotation probe says.
#include <algorithm>
#include <utility>

#include "stream/on_world.hpp"
#include "stream/player.hpp"

namespace kinesphere::stream {
namespace {

/// Returns the same rotation, half of the time with the other sign of its quaternion.
Rotation of_any_sign(Rotation rotation, double time) {
  if (std::fmod(1e3 * std::abs(time), 2.0) < 1.0) return rotation;
  auto& [w, x, y, z] = rotation.orientation;
  rotation.orientation = {-w, -x, -y, -z};
  return rotation;
}

}  // namespace

void Player::give_rotation_probe(World& world) {
  if (!kind_.swings) return;
  const auto probe = [this](std::span<const BodyId> ids, double time, std::span<Rotation> rotations) {
    for (std::size_t k = 0; k < ids.size(); ++k) {
      require(truth_.is_present(ids[k]) && is_rigid(ids[k]), "a rotation of what does not turn");
      rotations[k] = of_any_sign(truth_.rotation(ids[k], time), time);
    }
    if (bad_rotation_) rotations[0] = *std::exchange(bad_rotation_, std::nullopt);
  };
  world.set_rotation_probe(probe).value();
}

RigidBody Player::new_rigid_body(const Operation& operation) const {
  const bool flat = truth_.definition().dimensions == 2;
  RigidBody body{.body = new_body(operation),
                 .parts = operation.parts(truth_.definition().periodic.any() ? 0.3 : 0.8, flat),
                 .rotation = operation.rotation(flat),
                 .inertia = {1.0, 2.0, 0.5}};
  if (kind_.swings && operation.byte(2) % 2 == 0) {
    const double speed = norm(body.rotation.angular_velocity);
    body.largest_angular_speed = 1.5 * speed + 2.0;
    body.angular_acceleration_limit = 2.0 * body.largest_angular_speed;
  }
  return body;
}

/// Parts that certainly are in a wall are refused.
void Player::add_rigid(const Operation& operation) {
  const RigidBody body = new_rigid_body(operation);
  const TrueRigid rigid(body, truth_.time());
  std::vector<placed_parts::PlacedPart> parts;
  for (std::size_t k = 0; k < body.parts.size(); ++k)
    parts.emplace_back(body.parts[k], rigid.hulls[k], body.body.position, body.rotation.orientation);
  const double gap = truth_.gap_to_walls(parts, body.body.filter);
  const double deepest = -truth_.definition().contact_tolerance;
  const auto id = on_world([&](World& world) { return world.add_rigid_body(body); });
  require(id ? gap >= deepest - told_.slack() : gap <= deepest + told_.slack(),
          "add_rigid_body: walls are minded wrongly");
  if (!id)
    return require(id.error().code == ErrorCode::outside_domain,
                   "add_rigid_body: refused for a wrong reason");
  truth_.add_rigid(*id, body, world_.body(*id).value().definition.radius,
                   acceleration(operation, motion_limits_of(body.body)));
  told_.appeared(*id);
  changed();
}

void Player::turn(BodyId id, const Vec3& angular_velocity) {
  const auto done =
      on_world([&](World& world) { return world.change(id, {.angular_velocity = angular_velocity}); });
  if (!done) throw Disagreement("change of an angular velocity: " + done.error().message);
  truth_.turn(id, {truth_.rotation(id, truth_.time()).orientation, angular_velocity});
  told_.redirected(id);
  changed();
}

void Player::turn(BodyId id, const Rotation& rotation) {
  const auto before = told_.before(world_, id);
  const auto done =
      waking(island_of(id), [&](World& world) { return world.change(id, {.rotation = rotation}); });
  if (!done)
    return require(done.error().code == ErrorCode::outside_domain,
                   "change of a rotation: refused for a wrong reason");
  truth_.turn(id, rotation);
  told_.replaced(world_, id, before);
  told_.redirected(id);
  changed();
}

/// Turns the body at once, gives it another angular velocity, or lets it swing.
void Player::turn(BodyId id, const Operation& operation) {
  if (!truth_.is_present(id)) return;
  const TrueRigid& rigid = *truth_.at(id).rigid;
  Rotation rotation = operation.rotation(truth_.definition().dimensions == 2);
  const double speed = norm(rotation.angular_velocity);
  const double most = 0.99 * rigid.largest_angular_speed;
  if (speed > most) rotation.angular_velocity *= most / speed;
  switch (operation.byte(9) % 3) {
    case 0:
      return turn(id, rotation);
    case 1:
      return turn(id, rotation.angular_velocity);
    default:
      if (!rigid.keeps_spin())
        truth_.swing(id, 2.0 * operation.fraction(8) - 1.0,
                     truth_.definition().dimensions == 2 ? Vec3{0, 0, 1} : Vec3{0.6, 0, 0.8});
  }
}

/// After a teleport a body goes on to turn as the world expects it to.
void Player::go_on_turning(BodyId id) {
  if (is_rigid(id)) truth_.turn(id, world_.body(id).value().rigid.value().rotation);
}

void Player::check_rigid(const BodyView& view, const TrueBody& body) const {
  require(view.rigid.has_value() == body.rigid.has_value(), "rigid bodies and others are mixed up");
  if (!body.rigid) return;
  const RigidBody& found = *view.rigid;
  require(found.parts == body.rigid->parts &&
              found.angular_acceleration_limit == body.rigid->angular_acceleration_limit &&
              found.largest_angular_speed == body.rigid->largest_angular_speed &&
              found.inertia == Vec3{1.0, 2.0, 0.5},
          "a rigid body is not what was added");
  const double reported = view.bound.time;
  if (!body.enabled || reported <= body.rigid->turning.since) return;
  const Rotation rotation = body.rigid->turning.at(reported);
  require(angle_between(found.rotation.orientation, rotation.orientation) <= 1e-7,
          "a rigid body is turned otherwise than reported");
  require(norm(found.rotation.angular_velocity - rotation.angular_velocity) <=
              1e-9 * (1.0 + norm(rotation.angular_velocity)),
          "a rigid body turns otherwise than reported");
}

/// Makes calls about rotations that the world must refuse.
void Player::turn_wrongly(BodyId id, const Operation& operation) {
  const auto refused = [&](const BodyChange& change, ErrorCode code) {
    const auto done = world_.change(id, change);
    require(!done, "a wrong rotation is not refused");
    if (done.error().code != code)
      throw Disagreement("a wrong rotation is refused for a wrong reason: " + done.error().message);
  };
  const Vec3 spin{0, 0, 1};
  if (!is_rigid(id)) {
    const bool fixed = truth_.at(id).fixed;
    if (!fixed && truth_.is_present(id)) refused({.angular_velocity = spin}, ErrorCode::unsupported);
    return;
  }
  refused({.radius = 0.5}, ErrorCode::unsupported);
  refused({.radius_rate = 0.5}, ErrorCode::unsupported);
  if (!truth_.is_present(id)) return;
  require(!world_.sleep(id), "a rigid body falls asleep");
  const Quaternion orientations[] = {{nan, 0, 0, 0}, {1, 0, infinity, 0}, {0, 0, 0, 0}, {1, 0, 0, 1}};
  const Quaternion& wrong = orientations[operation.byte(3) % 4];
  refused({.rotation = Rotation{wrong, spin}},
          operation.byte(3) % 4 < 2 ? ErrorCode::not_finite : ErrorCode::out_of_range);
  refused({.angular_velocity = Vec3{0, 0, nan}}, ErrorCode::not_finite);
  refused({.angular_velocity = Vec3{0, 0, 1e300}}, ErrorCode::out_of_range);
  const double most = truth_.at(id).rigid->largest_angular_speed;
  if (most < infinity) refused({.angular_velocity = Vec3{0, 0, 1.1 * most}}, ErrorCode::out_of_range);
}

}  // namespace kinesphere::stream
