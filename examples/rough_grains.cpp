// Rough grains cool: each contact takes energy of motion along the normal, and exchanges energy of motion
// with energy of rotation. After a few contacts of each grain the ratio of the two temperatures is constant.
// It is compared with the kinetic theory of Luding, Huthmann, McNamara and Zippelius, Phys. Rev. E 58, 3416
// (1998), for contacts that never slide.
#include <kinesphere/kinesphere.hpp>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

using namespace kinesphere;

int main() {
  const int count = 2000;
  const double radius = 0.5, filled = 0.1;
  const Roughness rough{.restitution = 0.98, .tangential_restitution = 0.5, .inertia = 0.4};
  const double length = std::cbrt(count * std::numbers::pi / 6 / filled);
  const Box box{{0, 0, 0}, {length, length, length}};
  const Axes everywhere{true, true, true};
  const std::vector<double> radii(count, radius);
  std::vector<State> start;
  Random random(1);
  for (const Vec3& centre : place_spheres(radii, box, {.periodic = everywhere}).value())
    start.push_back({centre, random.point_in_ball()});
  Vec3 drift;
  for (const State& state : start) drift += state.velocity / count;
  for (State& state : start) state.velocity -= drift;
  Ballistic motion = Ballistic::create({.start = start}).value();
  SingleMotionSource source(motion);
  World world =
      World::create({.box = box, .periodic = everywhere, .contacts = ContactEvents::impacts}).value();
  for (std::uint32_t k = 0; k < motion.size(); ++k) {
    BodyDefinition grain = motion.definition(k, 0.0);
    grain.radius = radius;
    world.add_rigid_body({.body = grain, .parts = {{.radius = radius}}}).value();
  }

  const auto respond = [&](const Event& event) -> Response {
    if (event.kind != EventKind::contact_begin) return {};
    return response_of(event, bounce(event, rough));
  };
  // Temperatures: mass 1 and moment of inertia q r^2.
  double of_motion = 0.0, of_rotation = 0.0;
  const auto hear = [&](const Event& event) {
    if (event.kind != EventKind::timer) return;
    of_motion = of_rotation = 0.0;
    for (const BodyId id : world.bodies()) {
      const Vec3 spin = world.body(id).value().rigid->rotation.angular_velocity;
      of_motion += norm_squared(motion.state(id.index, event.time).velocity) / (3.0 * count);
      of_rotation += rough.inertia * radius * radius * norm_squared(spin) / (3.0 * count);
    }
    std::printf("time %3.0f, temperatures %.5f and %.5f, ratio %.3f\n", event.time, of_motion, of_rotation,
                of_rotation / of_motion);
  };
  world.schedule({.time = 50.0, .period = 50.0}).value();
  world.run(200.0, source, respond, hear).value();

  // dT/dt = -A T^(3/2) + B T^(1/2) R and dR/dt = B T^(3/2) - C T^(1/2) R, in three dimensions and in one
  // unit: where R / T stays, d ln R = d ln T.
  const double q = rough.inertia, r = rough.restitution;
  const double eta = q * (1.0 + rough.tangential_restitution) / (2.0 * q + 2.0);
  const double a = (1.0 - r * r) / 4.0 + eta * (1.0 - eta), b = eta * eta / q, c = eta / q * (1.0 - eta / q);
  // b k^2 + (c - a) k - b = 0 for the ratio k.
  const double expected = ((a - c) + std::sqrt((a - c) * (a - c) + 4.0 * b * b)) / (2.0 * b);
  const double ratio = of_rotation / of_motion;
  std::printf("in theory %.3f\n", expected);
  return std::abs(ratio / expected - 1.0) < 0.06 ? 0 : 1;
}
