// Hard spheres in a box that repeats: event-driven molecular dynamics in thirty lines. The pressure comes
// from the collisions (the virial) and is compared with the equation of state of Carnahan and Starling
// (1969).
#include <kinesphere/kinesphere.hpp>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

using namespace kinesphere;

int main() {
  const int count = 500;
  const double filled = 0.25, diameter = 1.0;
  const double length = std::cbrt(count * std::numbers::pi / 6 / filled);
  const Box box{{0, 0, 0}, {length, length, length}};
  const Axes everywhere{true, true, true};
  const std::vector<double> radii(count, diameter / 2);
  const std::vector<Vec3> centres = place_spheres(radii, box, {.periodic = everywhere, .seed = 1}).value();

  std::vector<State> start;
  Random random(1);
  Vec3 drift;
  for (const Vec3& centre : centres) {
    start.push_back({centre, random.point_in_ball()});
    drift += start.back().velocity / count;
  }
  double energy = 0;
  for (State& state : start) energy += 0.5 * norm_squared(state.velocity -= drift);

  Ballistic spheres = Ballistic::create({.start = start}).value();
  World world =
      World::create({.box = box, .periodic = everywhere, .contacts = ContactEvents::impacts}).value();
  for (std::uint32_t k = 0; k < spheres.size(); ++k) {
    BodyDefinition sphere = spheres.definition(k, 0.0);
    sphere.radius = radii[k];
    world.add(sphere).value();
  }

  const double warm_up = 20.0, end = 120.0;
  double virial = 0;
  long long collisions = 0;
  for (const Event& event : world.events(end, spheres.probe())) {
    if (event.kind != EventKind::contact_begin) continue;
    const Bounce after = bounce(event, 1.0);
    for (const auto& [id, velocity] :
         {std::pair(event.first, after.first_velocity), std::pair(event.second, after.second_velocity)}) {
      spheres.set_velocity(id.index, event.time, velocity).value();
      world.set_velocity(id, velocity).value();
    }
    if (event.time < warm_up) continue;
    ++collisions;
    virial += dot(after.second_velocity - event.second_state.velocity,
                  event.second_state.position - event.first_state.position);
  }

  const double z = 1 + virial / (2 * energy * (end - warm_up));
  const double f = filled, expected = (1 + f + f * f - f * f * f) / std::pow(1 - f, 3);
  std::printf("%lld collisions of %d spheres\n", collisions, count);
  std::printf("compressibility factor %.3f, Carnahan-Starling %.3f\n", z, expected);
  return std::abs(z / expected - 1) < 0.02 ? 0 : 1;
}
