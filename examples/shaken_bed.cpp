// Grains on a floor that shakes: what it gives them is what their collisions lose. If that is little, they
// are a thin gas of one temperature T under gravity, and T follows from the balance, as Kumaran (1998) found:
//   T = 2 sqrt(2) / pi m U^2 / (N d^2 (1 - e^2)),
// with N grains of diameter d, mass m and restitution e on a unit of area. A floor that rises and falls at U
// gives 4 m^2 g N U^2 / sqrt(2 pi m T), and they lose m g N^2 d^2 (1 - e^2) sqrt(pi T / m) (Haff, 1983).
// Usage: example_shaken_bed [restitution [duration]]
#include <kinesphere/kinesphere.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <vector>

using namespace kinesphere;

int main(int arguments, char** argument) {
  const double restitution = arguments > 1 ? std::atof(argument[1]) : 0.95;
  const double duration = arguments > 2 ? std::atof(argument[2]) : 500.0;
  const int count = 200;
  const double side = 20.0, radius = 0.5, gravity = 1.0, speed = 1.0, half_period = 0.1;

  Ballistic grains = Ballistic::create({.gravity = {0, 0, -gravity}}).value();
  Ballistic floors = Ballistic::create({}).value();
  // The walls below the floor and far above are never reached.
  World world =
      World::create({.box = Box{{0, 0, -3}, {side, side, 3000}}, .contacts = ContactEvents::impacts}).value();
  BodyMap bodies;
  Random random(1);
  const std::vector<double> radii(count, radius);
  const Box start{{0, 0, 1}, {side, side, 40}};
  for (const Vec3& centre : place_spheres(radii, start).value())
    bodies
        .add(world, grains, grains.add(0.0, {centre, 4.0 * random.point_in_ball()}).value(),
             {.radius = radius})
        .value();
  const MovingShape plate{{.mass = std::numeric_limits<double>::infinity()},
                          Box{{-11, -11, -2}, {11, 11, 0}}};
  const std::uint32_t number = floors.add(0.0, {{side / 2, side / 2, 0}, {0, 0, speed}}).value();
  const BodyId floor = bodies.add_moving_shape(world, floors, number, plate).value();

  const auto respond = [&](const Event& event) {
    // Walls and the floor lose nothing.
    const bool is_of_grains = event.second != no_body && event.first != floor && event.second != floor;
    return response_of(event, bounce(event, is_of_grains ? restitution : 1.0));
  };
  auto source = bodies.source();
  double energy = 0.0;
  int samples = 0;
  const int halves = static_cast<int>(duration / half_period);
  for (int k = 1; k <= halves; ++k) {
    world.run(k * half_period, source, respond, [](const Event&) {}).value();
    bodies.set_velocity(world, floor, {0, 0, k % 2 == 0 ? speed : -speed}).value();
    if (k < halves / 3) continue;
    for (std::uint32_t grain = 0; grain < count; ++grain)
      energy += norm_squared(grains.state(grain, world.time()).velocity) / count;
    ++samples;
  }
  const double temperature = energy / (3 * samples), diameter = 2 * radius;
  // Their centres stay within a radius of the walls.
  const double area = (side - diameter) * (side - diameter);
  const double balance = 2 * std::numbers::sqrt2 / std::numbers::pi * speed * speed * area /
                         (count * diameter * diameter * (1 - restitution * restitution));
  std::printf("restitution %.3f: temperature %.2f, by the balance %.2f\n", restitution, temperature, balance);
  return std::abs(temperature / balance - 1) < 0.15 ? 0 : 1;
}
