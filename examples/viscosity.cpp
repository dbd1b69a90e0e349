// Viscosity of hard spheres in a shear flow: the images of the periodic box slide (Lees and Edwards, 1972).
// The shear stress comes from the collisions and from what the spheres carry between them; a thermostat takes
// out the heat of the flow. Beside it stands the theory of Enskog (1922), which holds for what is not dense.
#include <kinesphere/kinesphere.hpp>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

using namespace kinesphere;

constexpr double pi = std::numbers::pi;

/// Enskog's viscosity, in units of the diameter, the mass and the temperature.
double enskog(double filled) {
  const double contact = (1.0 - 0.5 * filled) / std::pow(1.0 - filled, 3), dense = 4.0 * filled;
  const double dilute = 1.016 * 5.0 / 16.0 / std::sqrt(pi);
  return dilute * (1.0 / contact + 0.8 * dense + 0.7614 * dense * dense * contact);
}

struct Flow {
  Flow(double filled, double shear_rate)
      : length(std::cbrt(count * pi / 6 / filled)),
        rate(shear_rate),
        world(World::create({.box = Box{{}, {length, length, length}},
                             .periodic = everywhere,
                             .shear_rate = rate,
                             .contacts = ContactEvents::impacts})
                  .value()) {
    const std::vector<double> radii(count, 0.5);
    Random random(1);
    for (const Vec3& centre :
         place_spheres(radii, *world.definition().box, {.periodic = everywhere}).value()) {
      const State start{centre, random.point_in_ball() + Vec3{rate * centre.y, 0, 0}};
      spheres.add(0.0, start).value();
      ids.push_back(world.add({.radius = 0.5, .position = centre, .velocity = start.velocity}).value());
    }
    set_temperature();
  }

  /// The velocity of a sphere against the flow. Its way leads through all images, and so does the flow.
  Vec3 peculiar(std::uint32_t sphere) const {
    const auto [position, velocity] = spheres.state(sphere, world.time());
    return velocity - Vec3{rate * position.y, 0, 0};
  }
  /// Makes the temperature 1, and the spheres move with the flow on average.
  void set_temperature() {
    Vec3 drift;
    double energy = 0.0;
    for (std::uint32_t k = 0; k < count; ++k) drift += peculiar(k) / count;
    for (std::uint32_t k = 0; k < count; ++k) energy += norm_squared(peculiar(k) - drift);
    const double scale = std::sqrt(3.0 * count / energy);
    for (std::uint32_t k = 0; k < count; ++k) {
      const State now = spheres.state(k, world.time());
      const Vec3 velocity = now.velocity - peculiar(k) + scale * (peculiar(k) - drift);
      spheres.set_velocity(k, world.time(), velocity).value();
      world.set_velocity(ids[k], velocity).value();
    }
  }
  /// Returns the viscosity, as measured for so long.
  double viscosity(double duration) {
    const double step = 0.05, end = world.time() + duration, volume = length * length * length;
    double stress = 0.0;  // times volume and time
    SingleMotionSource source(spheres);
    const auto respond = [&](const Event& event) {
      const Bounce after = bounce(event, 1.0);
      stress += (after.first_velocity.x - event.first_state.velocity.x) *
                (event.first_state.position.y - event.second_state.position.y);
      return response_of(event, after);
    };
    while (world.time() < end) {
      world.run(world.time() + step, source, respond, [](const Event&) {}).value();
      for (std::uint32_t k = 0; k < count; ++k) stress += step * peculiar(k).x * peculiar(k).y;
      set_temperature();
    }
    return -stress / (volume * duration * rate);
  }

  static constexpr int count = 500;
  static constexpr Axes everywhere{true, true, true};
  double length, rate;
  Ballistic spheres = Ballistic::create({}).value();
  World world;
  std::vector<BodyId> ids{};
};

int main() {
  const struct {
    double filled, rate, duration, least, most;
  } fluids[] = {{0.1, 0.2, 150, 0.95, 1.05}, {0.3, 0.2, 100, 0.95, 1.05}, {0.5, 0.1, 30, 1.7, 2.5}};
  bool agrees = true;
  for (const auto& [filled, rate, duration, least, most] : fluids) {
    Flow flow(filled, rate);
    flow.viscosity(20.0);
    const double measured = flow.viscosity(duration), ratio = measured / enskog(filled);
    std::printf("filled %.1f: viscosity %.3f, %.2f times that of Enskog, %.3f\n", filled, measured, ratio,
                enskog(filled));
    agrees = agrees && least < ratio && ratio < most;
  }
  return agrees ? 0 : 1;
}
