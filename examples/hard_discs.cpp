// Hard discs in a box that repeats: their pressure, from the collisions, beside the equation of state of
// Henderson (Mol. Phys. 30, 971, 1975), at several packings.
#include <kinesphere/game_world.hpp>
#include <kinesphere/placement.hpp>
#include <kinesphere/random.hpp>
#include <kinesphere/response.hpp>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

using namespace kinesphere;

namespace {

/// Returns the compressibility factor of discs that fill this part of the plane.
double compressibility(double packing) {
  const int count = 400;
  const double radius = 0.5, length = std::sqrt(count * std::numbers::pi * radius * radius / packing);
  const Box box{{0, 0, 0}, {length, length, 0}};
  const Axes everywhere{true, true, false};
  GameWorld discs =
      GameWorld::create(
          {.world = {.box = box, .periodic = everywhere, .dimensions = 2, .contacts = ContactEvents::impacts},
           .response = bouncing(1.0)})
          .value();
  const std::vector<double> radii(count, radius);
  Random random(1);
  const auto centres = place_spheres(radii, box, {.periodic = everywhere, .dimensions = 2, .seed = 1});
  for (const Vec3& centre : centres.value()) {
    const Vec3 velocity = random.point_in_ball();
    discs.add({.radius = radius, .position = centre, .velocity = {velocity.x, velocity.y, 0}}).value();
  }
  discs.step(20.0).value();
  double energy = 0, virial = 0;
  Vec3 drift;
  for (const Vec3& velocity : discs.velocities()) drift += velocity / count;
  for (const Vec3& velocity : discs.velocities()) energy += 0.5 * norm_squared(velocity - drift);
  const double time = 100.0;
  for (const Event& event : discs.step(time).value()) {
    if (event.kind != EventKind::contact_begin) continue;
    const Vec3 gained = bounce(event, 1.0).second_velocity - event.second_state.velocity;
    virial += dot(gained, event.second_state.position - event.first_state.position);
  }
  return 1 + virial / (2 * energy * time);
}

}  // namespace

int main() {
  std::printf("packing  measured  Henderson\n");
  double worst = 0;
  for (const double packing : {0.1, 0.3, 0.5}) {
    const double found = compressibility(packing);
    const double expected = (1 + packing * packing / 8) / ((1 - packing) * (1 - packing));
    std::printf("%7.1f  %8.3f  %9.3f\n", packing, found, expected);
    worst = std::max(worst, std::abs(found / expected - 1));
  }
  return worst < 0.02 ? 0 : 1;
}
