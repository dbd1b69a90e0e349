// An atmosphere: hard spheres above a floor, under gravity. Their density falls off with height as
// Boltzmann's factor says, exp(-m g h / T), corrected for the room that spheres take; and their temperature
// is the same at each height.
#include <kinesphere/game_world.hpp>
#include <kinesphere/random.hpp>

#include <cmath>
#include <cstdio>
#include <vector>

using namespace kinesphere;

int main() {
  const int count = 400;
  const double radius = 0.05, gravity = 1.0, side = 6.0;
  GameWorld air = GameWorld::create({.world = {.box = Box{{0, 0, 0}, {side, side, 60}},
                                               .periodic = {.x = true, .y = true},
                                               .contacts = ContactEvents::impacts},
                                     .gravity = {0, 0, -gravity},
                                     .response = bouncing(1.0)})
                      .value();
  Random random(5);
  for (int k = 0; k < count; ++k) {
    const Vec3 place{0.3 * (k % 20) + 0.15, 0.3 * (k / 20) + 0.15, 0.2 + 0.4 * (k % 7)};
    air.add({.radius = radius, .position = place, .velocity = 2.0 * random.point_in_ball()}).value();
  }
  air.step(60.0).value();

  // Energies and heights, again and again.
  const int samples = 400, layers = 6;
  double kinetic = 0;
  std::vector<double> inside(layers), kinetic_of(layers);
  for (int sample = 0; sample < samples; ++sample) {
    air.step(0.5).value();
    for (int k = 0; k < count; ++k) {
      const auto place = static_cast<std::size_t>(k);
      const double square = norm_squared(air.velocities()[place]);
      kinetic += square / (3.0 * count * samples);
      const auto layer = static_cast<std::size_t>((air.positions()[place].z - radius) / 0.5);
      if (layer >= inside.size()) continue;
      inside[layer] += 1.0 / samples;
      kinetic_of[layer] += square / (3.0 * samples);
    }
  }
  std::printf("temperature %.3f\n height  spheres  Boltzmann  temperature\n", kinetic);
  // The first layer sets the scale: spheres in a layer from a to b are to exp(-a g / T) - exp(-b g / T).
  const auto weight = [&](std::size_t layer) {
    const double low = 0.5 * static_cast<double>(layer);
    return std::exp(-low * gravity / kinetic) - std::exp(-(low + 0.5) * gravity / kinetic);
  };
  double worst = 0;
  for (std::size_t layer = 0; layer < inside.size(); ++layer) {
    const double expected = count * weight(layer), hot = kinetic_of[layer] / inside[layer];
    std::printf("%7.2f  %7.1f  %9.1f  %11.3f\n", 0.5 * static_cast<double>(layer) + 0.25, inside[layer],
                expected, hot);
    worst = std::max({worst, std::abs(inside[layer] / expected - 1), std::abs(hot / kinetic - 1)});
  }
  std::printf("%.0f %% off at most\n", 100 * worst);
  return worst < 0.1 ? 0 : 1;
}
