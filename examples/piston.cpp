// A piston compresses a gas to half its volume. It is a moving shape of infinite mass: a plate that slides
// through the walls of the world. Compressed slowly, a gas of small balls keeps about T V^(2/3) (an adiabatic
// change), and what it gains in energy is the piston's work, contact for contact.
#include <kinesphere/kinesphere.hpp>

#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

using namespace kinesphere;

int main() {
  const int count = 300;
  const double side = 10, radius = 0.1, speed = 0.002;

  std::vector<State> start;
  Random random(1);
  const auto place = [&] { return random.uniform(radius, side - radius); };
  for (int k = 0; k < count; ++k) start.push_back({{place(), place(), place()}, random.unit_vector()});
  start.push_back({{side / 2, side / 2, side}, {0, 0, -speed}});  // the piston
  Ballistic motion = Ballistic::create({.start = start}).value();

  World world =
      World::create({.box = Box{{0, 0, 0}, {side, side, side}}, .contacts = ContactEvents::impacts}).value();
  BodyMap bodies;
  for (std::uint32_t k = 0; k < count; ++k) bodies.add(world, motion, k, {.radius = radius}).value();
  // The plate is wider than the box, and 1 thick. Its position is in the middle of its lower face.
  const MovingShape plate{{.mass = std::numeric_limits<double>::infinity()}, Box{{-6, -6, 0}, {6, 6, 1}}};
  const BodyId piston = bodies.add_moving_shape(world, motion, count, plate).value();

  double work = 0;
  auto source = bodies.source();
  const double end = side / 2 / speed;
  world
      .run(
          end, source, [](const Event& event) { return response_of(event, bounce(event, 1.0)); },
          [&](const Event& event) {
            if (event.first != piston && event.second != piston) return;
            // A ball of mass 1 turns around in the piston's frame: its push is twice the speed of approach.
            const Vec3 down = event.first == piston ? event.normal : -event.normal;
            work += 2 * event.approach_speed * dot(down, Vec3{0, 0, -speed});
          })
      .value();

  double energy = 0;
  for (std::uint32_t k = 0; k < count; ++k) energy += 0.5 * norm_squared(motion.state(k, end).velocity);
  const double before = 0.5 * count, warmer = energy / before;
  const double adiabatic = std::pow((side - 2 * radius) / (side / 2 - 2 * radius), 2.0 / 3.0);
  std::printf("temperature %.3f times as high, adiabatic %.3f\n", warmer, adiabatic);
  std::printf("gain of energy %.9f, work %.9f\n", energy - before, work);
  return std::abs(warmer / adiabatic - 1) < 0.02 && std::abs(energy - before - work) < 1e-9 * work ? 0 : 1;
}
