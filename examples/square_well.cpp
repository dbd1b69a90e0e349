// A fluid of spheres that attract each other: a square well around each. What comes out is compared with the
// second virial coefficient, which is known exactly: for the pressure, and for how many others a sphere has
// in its well (Hirschfelder, Curtiss and Bird, Molecular Theory of Gases and Liquids, 1954).
#include <kinesphere/kinesphere.hpp>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

using namespace kinesphere;

int main() {
  const int count = 1000;
  const double density = 0.03, lambda = 1.5, depth = 1.0;  // diameter and mass are 1
  const double length = std::cbrt(count / density);
  const Box box{{0, 0, 0}, {length, length, length}};
  const Axes everywhere{true, true, true};
  const std::vector<double> radii(count, 0.5);
  const std::vector<Vec3> centres = place_spheres(radii, box, {.periodic = everywhere, .seed = 1}).value();
  std::vector<State> start;
  Random random(1);
  Vec3 drift;
  for (const Vec3& centre : centres) {
    start.push_back({centre, random.point_in_ball() * 2.6});
    drift += start.back().velocity / count;
  }
  for (State& state : start) state.velocity -= drift;

  Ballistic spheres = Ballistic::create({.start = start}).value();
  SingleMotionSource source(spheres);
  World world =
      World::create({.box = box, .periodic = everywhere, .contacts = ContactEvents::impacts}).value();
  const StepPotential well =
      StepPotential::create({.distances = {lambda - 1.0}, .energies = {-depth}}, world.definition()).value();
  world.set_sensor(0, well.sensor()).value();
  for (std::uint32_t k = 0; k < spheres.size(); ++k) {
    BodyDefinition sphere = spheres.definition(k, 0.0);
    sphere.radius = radii[k];
    world.add(sphere).value();
  }

  // A sample in each unit of time, after a time in which the fluid comes to its balance.
  const double warm_up = 60.0, end = 460.0;
  world.schedule({.time = warm_up, .period = 1.0}).value();
  double virial = 0.0, temperature = 0.0, neighbours = 0.0;
  int samples = 0;
  const auto respond = [&](const Event& event) { return well.respond(event); };
  const auto hear = [&](const Event& event) {
    if (event.kind == EventKind::timer) {
      ++samples;
      for (const BodyId id : world.bodies()) {
        temperature += norm_squared(spheres.state(id.index, event.time).velocity) / (3.0 * count);
        neighbours += static_cast<double>(world.sensor_overlaps(id).value().size()) / count;
      }
      return;
    }
    const Response after = well.respond(event);
    if (event.time >= warm_up && after.second_velocity)
      virial += dot(*after.second_velocity - event.second_state.velocity,
                    event.second_state.position - event.first_state.position);
  };
  world.run(end, source, respond, hear).value();
  temperature /= samples;
  neighbours /= samples;

  const double z = 1.0 + virial / (3.0 * count * temperature * (end - warm_up));
  const double boltzmann = std::exp(depth / temperature), shell = lambda * lambda * lambda - 1.0;
  const double b2 = 2.0 / 3.0 * std::numbers::pi * (1.0 - shell * (boltzmann - 1.0));
  const double expected = 1.0 + b2 * density;
  const double in_well = 4.0 / 3.0 * std::numbers::pi * density * shell * boltzmann;
  std::printf("temperature %.3f\n", temperature);
  std::printf("compressibility factor %.3f, by the second virial coefficient %.3f\n", z, expected);
  std::printf("spheres in a well %.3f, at low density %.3f\n", neighbours, in_well);
  const bool agrees = std::abs(z - expected) < 0.02 && std::abs(neighbours / in_well - 1.0) < 0.05;
  return agrees ? 0 : 1;
}
