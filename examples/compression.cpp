// A gas of hard spheres in a box that shrinks, slowly and without heat from outside. Its temperature rises by
// the work of the pressure: T2 / T1 = (V1 / V2)^(2/3 Z), with the compressibility factor Z of Carnahan and
// Starling (1969), which changes on the way.
// Usage: example_compression [number of spheres [rate]]
#include <kinesphere/kinesphere.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <vector>

using namespace kinesphere;

/// The integral of (Z - 1) / filled.
double beyond_ideal(double filled) { return filled * (4 - 3 * filled) / ((1 - filled) * (1 - filled)); }

int main(int arguments, char** argument) {
  const int count = arguments > 1 ? std::atoi(argument[1]) : 1000;
  const double rate = arguments > 2 ? std::atof(argument[2]) : -0.005;  // beside speeds of about 1
  const double radius = 0.5, first_filled = 0.1;
  const double edge = std::cbrt(count * std::numbers::pi / 6 / first_filled);
  const ExpandingBox box = ExpandingBox::create({.rate = rate}).value();

  World world = World::create({.box = Box{{}, {edge, edge, edge}},
                               .periodic = {true, true, true},
                               .contacts = ContactEvents::impacts})
                    .value();
  Ballistic spheres = Ballistic::create({}).value();
  Random random(1);
  const std::vector<double> radii(count, radius);
  for (const Vec3& centre :
       place_spheres(radii, *world.definition().box, {.periodic = {true, true, true}}).value()) {
    // A velocity against the flow of the box, rate x.
    const State start{centre, random.point_in_ball() + rate * centre}, seen = box.seen(start, 0.0);
    spheres.add(0.0, seen).value();
    world
        .add({.radius = radius,
              .position = seen.position,
              .velocity = seen.velocity,
              .radius_rate = box.growth_rate(radius)})
        .value();
  }
  // The box sees velocities against its flow, times the scale.
  const auto temperature = [&](double clock) {
    double energy = 0.0;
    for (std::uint32_t k = 0; k < spheres.size(); ++k)
      energy += norm_squared(spheres.state(k, clock).velocity);
    return energy / (3 * count) / std::pow(box.scale_at(clock), 2);
  };

  SingleMotionSource source(spheres);
  const double first_temperature = temperature(0.0);
  bool agrees = true;
  std::printf("filled   times the first temperature   by Carnahan and Starling\n");
  for (const double filled : {0.15, 0.2, 0.3, 0.4, 0.45}) {
    const double scale = std::cbrt(first_filled / filled), clock = box.clock((scale - 1) / rate);
    world.run(clock, source, bouncing(1.0), [](const Event&) {}).value();
    const double measured = temperature(clock) / first_temperature;
    const double known = std::pow(filled / first_filled, 2.0 / 3.0) *
                         std::exp(2.0 / 3.0 * (beyond_ideal(filled) - beyond_ideal(first_filled)));
    std::printf("%6.2f   %27.3f   %24.3f\n", filled, measured, known);
    agrees = agrees && std::abs(measured / known - 1) < 0.03;
  }
  return agrees ? 0 : 1;
}
