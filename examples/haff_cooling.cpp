// A granular gas cools by itself: 2,000 spheres that lose energy in each collision, in a box that repeats.
// Haff's law says how fast: T = T0 / (1 + t / t0)^2, and the kinetic theory of Enskog gives t0 (Haff, J.
// Fluid Mech. 134, 401, 1983; Brilliantov and Poeschel, Kinetic Theory of Granular Gases, 2004).
#include <kinesphere/game_world.hpp>
#include <kinesphere/placement.hpp>
#include <kinesphere/random.hpp>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

using namespace kinesphere;

int main() {
  const int count = 2000;
  const double restitution = 0.9, packing = 0.05, diameter = 1.0, pi = std::numbers::pi;
  const double length = std::cbrt(count * pi / 6 / packing);
  const Box box{{0, 0, 0}, {length, length, length}};
  const Axes everywhere{true, true, true};
  GameWorld gas =
      GameWorld::create({.world = {.box = box, .periodic = everywhere, .contacts = ContactEvents::impacts},
                         .response = bouncing(restitution)})
          .value();
  const std::vector<double> radii(count, diameter / 2);
  Random random(3);
  for (const Vec3& centre : place_spheres(radii, box, {.periodic = everywhere, .seed = 2}).value())
    gas.add({.radius = diameter / 2, .position = centre, .velocity = random.point_in_ball()}).value();

  // Mean square of a velocity component, without the drift of all.
  const auto temperature = [&] {
    Vec3 drift;
    for (const Vec3& velocity : gas.velocities()) drift += velocity / count;
    double sum = 0;
    for (const Vec3& velocity : gas.velocities()) sum += norm_squared(velocity - drift);
    return sum / (3 * count);
  };
  gas.set_response(bouncing(1.0)).value();
  gas.step(20.0).value();  // until the velocities are those of equilibrium
  gas.set_response(bouncing(restitution)).value();

  // Collisions of one sphere in a unit of time at T0, by Enskog, and the part of its energy that each costs.
  const double start = temperature();
  const double density = count / (length * length * length),
               contact = (1 - packing / 2) / std::pow(1 - packing, 3);
  const double rate = 4 * density * diameter * diameter * contact * std::sqrt(pi * start);
  const double cooling_time = 6 / ((1 - restitution * restitution) * rate);
  std::printf("   t/t0     T/T0   Haff\n");
  double worst = 0;
  for (int k = 1; k <= 8; ++k) {
    gas.step(0.5 * cooling_time).value();
    const double found = temperature() / start, expected = std::pow(1 + 0.5 * k, -2);
    std::printf("%7.1f  %7.4f  %5.4f\n", 0.5 * k, found, expected);
    worst = std::max(worst, std::abs(found / expected - 1));
  }
  std::printf("%.0f %% off at most\n", 100 * worst);
  return worst < 0.1 ? 0 : 1;
}
