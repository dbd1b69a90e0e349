// A robot arm of three links among posts. Each link is a capsule that turns. The world knows only how fast
// the joints can turn and how hard they can be driven; from this it says how long nothing can be touched, and
// tells the first touch at its time.
#include <kinesphere/kinesphere.hpp>

#include <array>
#include <cmath>
#include <cstdio>

using namespace kinesphere;

constexpr int links = 3;
constexpr double length = 1.0, radius = 0.08, joint_speed = 1.0, joint_acceleration = 2.0;

/// The controller's secret; it keeps the limits of the joints.
std::pair<double, double> angle_and_speed(int joint, double t) {
  const double rate = 1.1 + 0.3 * joint;
  return {0.58 * std::sin(rate * t + joint), 0.58 * rate * std::cos(rate * t + joint)};
}

/// State and rotation of the middle of a link: each turns relative to the one before.
std::pair<State, Rotation> link_at(int link, double t) {
  State joint;
  double angle = 0, speed = 0;
  for (int k = 0;; ++k) {
    const auto [turned, turning] = angle_and_speed(k, t);
    angle += turned;
    speed += turning;
    const Vec3 along{std::cos(angle), std::sin(angle), 0}, across{-along.y, along.x, 0};
    const double part = k == link ? 0.5 * length : length;
    joint.position += along * part;
    joint.velocity += across * (part * speed);
    if (k == link) return {joint, {rotation_by({0, 0, angle}), {0, 0, speed}}};
  }
}

int main() {
  World world = World::create({.contact_tolerance = 1e-6}).value();
  std::array<BodyId, links> arm;
  double acceleration = 0;  // of the joint where the link begins
  for (int k = 0; k < links; ++k) {
    const double spin = (k + 1) * joint_speed, turn = (k + 1) * joint_acceleration;
    const auto [state, rotation] = link_at(k, 0);
    // A link meets the posts, and no other link.
    arm[k] =
        world
            .add_rigid_body({.body = {.acceleration_limit = acceleration + (turn + spin * spin) * length / 2,
                                      .position = state.position,
                                      .velocity = state.velocity,
                                      .filter = {.category = 2, .mask = 1}},
                             .parts = {{{-length / 2, 0, 0}, {length / 2, 0, 0}, radius}},
                             .rotation = rotation,
                             .angular_acceleration_limit = turn,
                             .largest_angular_speed = spin})
            .value();
    acceleration += (turn + spin * spin) * length;
  }
  for (const auto& [x, y] : {std::pair(2.2, 2.0), std::pair(1.2, -2.2), std::pair(-0.8, 1.4)})
    world.add_static({.shape = Box{{x - 0.1, y - 0.1, -1}, {x + 0.1, y + 0.1, 1}}}).value();

  const auto number = [&](BodyId id) { return id == arm[0] ? 0 : id == arm[1] ? 1 : 2; };
  world
      .set_rotation_probe([&](std::span<const BodyId> ids, double t, std::span<Rotation> rotations) {
        for (std::size_t k = 0; k < ids.size(); ++k) rotations[k] = link_at(number(ids[k]), t).second;
      })
      .value();
  const auto probe = [&](std::span<const BodyId> ids, double t, std::span<State> states) {
    for (std::size_t k = 0; k < ids.size(); ++k) states[k] = link_at(number(ids[k]), t).first;
  };

  std::printf("at the start nothing is touched for %.3f s, whatever the joints do\n",
              world.certificates().safe_until()->time);
  const auto event = world.advance(20.0, probe).value();
  if (!event) return 1;
  std::printf("%.6f s: link %d touches a post at (%.3f, %.3f), closing at %.3f; %llu probes\n", event->time,
              number(event->first), event->point.x, event->point.y, event->approach_speed,
              static_cast<unsigned long long>(world.counters().probes));
  return event->first == arm[2] ? 0 : 1;
}
