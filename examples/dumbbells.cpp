// A gas of dumbbells, each of two balls joined by a rod: they fly and turn freely and bounce without loss,
// off each other and off the walls. The gas keeps its energy, and it shares it: three fifths of the energy
// are in the flight and two fifths in the rotation (equipartition: a dumbbell flies in three directions and
// turns about two axes).
#include <kinesphere/kinesphere.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

using namespace kinesphere;

int main(int count, char** arguments) {
  const int side = count > 1 ? std::atoi(arguments[1]) : 4;  // dumbbells on each edge of the box
  const int wanted = count > 2 ? std::atoi(arguments[2]) : 20000;
  const double spacing = 2.5, radius = 0.3, half = 0.5;

  // All energy is in the flight at first.
  std::vector<State> start;
  Random random(7);
  for (int k = 0; k < side * side * side; ++k)
    start.push_back(
        {{spacing * (k % side + 0.5), spacing * (k / side % side + 0.5), spacing * (k / side / side + 0.5)},
         random.unit_vector()});
  Ballistic motion = Ballistic::create({.start = start}).value();
  World world = World::create({.box = Box{{0, 0, 0}, Vec3{1, 1, 1} * (side * spacing)}}).value();
  BodyMap bodies;
  for (std::uint32_t k = 0; k < start.size(); ++k) {
    const RigidBody dumbbell{
        .parts = {{{-half, 0, 0}, {-half, 0, 0}, radius}, {{half, 0, 0}, {half, 0, 0}, radius}},
        .rotation = {.orientation = rotation_by(3.0 * random.point_in_ball())},
        .inertia = {0, half * half, half * half}};  // two masses of 1/2, half apart
    bodies.add_rigid_body(world, motion, k, dumbbell).value();
  }

  int contacts = 0;
  double flight = 0, rotation = 0;
  const auto measure = [&] {
    flight = rotation = 0;
    for (const BodyId id : world.bodies()) {
      flight += 0.5 * norm_squared(bodies.state(id, world.time()).velocity);
      rotation += 0.5 * half * half * norm_squared(world.body(id)->rigid->rotation.angular_velocity);
    }
  };
  measure();
  const double before = flight + rotation;
  auto source = bodies.source();
  while (contacts < wanted)
    world
        .run(
            world.time() + 1, source,
            [](const Event& event) {
              const bool begins =
                  event.kind == EventKind::contact_begin || event.kind == EventKind::wall_begin;
              return begins ? response_of(event, bounce(event, 1.0)) : Response{};
            },
            [&](const Event& event) { contacts += event.kind == EventKind::contact_begin; })
        .value();
  measure();
  const double error = std::abs((flight + rotation) / before - 1);
  std::printf("%d contacts; energy kept to %.1e; %.3f of it in the flight\n", contacts, error,
              flight / (flight + rotation));
  return error < 1e-9 && std::abs(flight / (flight + rotation) - 0.6) < 0.1 ? 0 : 1;
}
