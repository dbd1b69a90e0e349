// Balls that grow until they jam (Lubachevsky and Stillinger, 1990): equal balls fly in a box that repeats,
// bounce off each other and grow, until none can move. Fast growth jams them at random places, which fill
// about 0.64 of the box; slow growth would give them time to order.
// Usage: example_packing [number of balls [rate of the radii]]
#include <kinesphere/kinesphere.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <vector>

using namespace kinesphere;

int main(int arguments, char** argument) {
  const int count = arguments > 1 ? std::atoi(argument[1]) : 1000;
  const double rate = arguments > 2 ? std::atof(argument[2]) : 0.02;  // beside speeds of about 1
  const Box box{{0, 0, 0}, Vec3{1, 1, 1} * std::cbrt(count)};
  const Axes everywhere{true, true, true};
  const auto filled_at = [](double radius) { return 4 * std::numbers::pi / 3 * radius * radius * radius; };
  const std::vector<double> radii(count, 0.2);
  std::vector<State> start;
  Random random(1);
  for (const Vec3& centre : place_spheres(radii, box, {.periodic = everywhere, .seed = 1}).value())
    start.push_back({centre, random.unit_vector()});
  Ballistic balls = Ballistic::create({.start = start}).value();
  World world =
      World::create({.box = box, .periodic = everywhere, .contacts = ContactEvents::impacts}).value();
  BodyMap bodies;
  const auto ids = bodies.add_all(world, balls, {.radius = radii[0], .radius_rate = rate}).value();

  // Each bounce adds the energy of the growth, so the balls are slowed down now and then.
  const auto slow_down = [&] {
    double energy = 0;
    for (const BodyId id : ids) energy += norm_squared(bodies.state(id, world.time()).velocity) / count;
    for (const BodyId id : ids)
      bodies.set_velocity(world, id, bodies.state(id, world.time()).velocity / std::sqrt(energy)).value();
  };
  long long collisions = 0;
  double radius = radii[0], pressure = 0, momentum = 0, since = 0;
  // The last free volume, of a share of 3 / pressure, closes the slower the smaller it is.
  for (const Event& event : world.events(1e3, bodies.probe())) {
    if (event.kind != EventKind::contact_begin) continue;
    const Bounce after = bounce(event, 1.0);
    bodies.set_velocity(world, event.first, after.first_velocity).value();
    bodies.set_velocity(world, event.second, after.second_velocity).value();
    momentum += norm(after.second_velocity - event.second_state.velocity);
    if (++collisions % (50LL * count) != 0) continue;
    radius = world.body(ids[0])->definition.radius;
    pressure = 1 + 2 * radius * momentum / (count * (event.time - since));
    std::printf("after %4lld collisions of each: %.4f filled, pressure %.3g\n", 2 * collisions / count,
                filled_at(radius), pressure);
    if (pressure > 1e5) break;
    slow_down();
    momentum = 0;
    since = event.time;
  }
  const double filled = filled_at(radius);
  std::printf("%d balls jam at %.4f\n", count, filled);
  return filled > 0.63 && filled < 0.65 ? 0 : 1;
}
