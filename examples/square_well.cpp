// A fluid of spheres that attract each other: a square well around each. Its pressure and energy are compared
// with an equation of state that was fitted to many simulations: Espíndola-Heredia, del Río and Malijevský,
// J. Chem. Phys. 130, 024509 (2009), good to a few percent. A thermostat holds the temperature.
#include <kinesphere/kinesphere.hpp>

#include <cmath>
#include <cstdio>
#include <vector>

using namespace kinesphere;

/// In units of the diameter, the mass and the depth of the well.
struct Fluid {
  double density, temperature;
  double factor, energy;  ///< of the equation of state: compressibility factor, energy of a sphere
};

bool agrees(const Fluid& fluid, int count, double end) {
  const double lambda = 1.5, depth = 1.0;
  const double length = std::cbrt(count / fluid.density);
  const Box box{{0, 0, 0}, {length, length, length}};
  const Axes everywhere{true, true, true};
  Random random(1);
  const auto thermal = [&] {
    const auto gauss = [&] {
      return std::sqrt(-2 * std::log(1 - random.uniform())) *
             std::cos(2 * 3.141592653589793 * random.uniform());
    };
    return Vec3{gauss(), gauss(), gauss()} * std::sqrt(fluid.temperature);
  };
  std::vector<State> start;
  for (const Vec3& centre :
       place_spheres(std::vector<double>(count, 0.5), box, {.periodic = everywhere}).value())
    start.push_back({centre, thermal()});
  Ballistic spheres = Ballistic::create({.start = start}).value();
  SingleMotionSource source(spheres);
  World world =
      World::create({.box = box, .periodic = everywhere, .contacts = ContactEvents::impacts}).value();
  const StepPotential well =
      StepPotential::create({.distances = {lambda - 1.0}, .energies = {-depth}}, world.definition()).value();
  world.set_sensor(0, well.sensor()).value();
  for (std::uint32_t k = 0; k < spheres.size(); ++k) {
    BodyDefinition sphere = spheres.definition(k, 0.0);
    sphere.radius = 0.5;
    world.add(sphere).value();
  }

  // At each timer a sample is taken, and a quarter of the spheres get new velocities.
  const double warm_up = 0.25 * end;
  world.schedule({.time = 0.5, .period = 0.5}).value();
  double virial = 0.0, energy = 0.0;
  int samples = 0;
  const auto respond = [&](const Event& event) -> Response {
    if (event.kind == EventKind::timer) return {.stop = true};
    return well.respond(event);
  };
  const auto hear = [&](const Event& event) {
    if (event.kind == EventKind::timer) {
      for (const BodyId id : world.bodies()) {
        if (event.time > warm_up)
          energy -= depth / 2 * static_cast<double>(world.sensor_overlaps(id).value().size()) / count;
        if (random.uniform() > 0.25) continue;
        const Vec3 velocity = thermal();
        spheres.set_velocity(id.index, event.time, velocity).value();
        world.set_velocity(id, velocity).value();
      }
      samples += event.time > warm_up;
      return;
    }
    const Response after = well.respond(event);
    if (event.time > warm_up && after.second_velocity)
      virial += dot(*after.second_velocity - event.second_state.velocity,
                    event.second_state.position - event.first_state.position);
  };
  world.run(end, source, respond, hear).value();

  const double factor = 1.0 + virial / (3.0 * count * fluid.temperature * (end - warm_up));
  energy /= samples;
  std::printf("density %.2f, temperature %.1f: compressibility factor %.3f (%.3f), energy %.3f (%.3f)\n",
              fluid.density, fluid.temperature, factor, fluid.factor, energy, fluid.energy);
  return std::abs(factor - fluid.factor) < 0.1 && std::abs(energy / fluid.energy - 1.0) < 0.02;
}

int main() {
  std::printf("measured (equation of state)\n");
  const bool gas =
      agrees({.density = 0.1, .temperature = 2.0, .factor = 0.913, .energy = -0.778}, 500, 160.0);
  const bool liquid =
      agrees({.density = 0.6, .temperature = 2.0, .factor = 2.024, .energy = -4.409}, 500, 64.0);
  return gas && liquid ? 0 : 1;
}
