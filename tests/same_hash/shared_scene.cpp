// The scene and the game that a program in each language runs, in C++: C, Rust, C# (tests/c, rust, csharp),
// Python and JavaScript (python/test, browser/test). Prints the hashes of their events, which
// shared_scene.txt has.
//
// The scene has 64 balls in a box, with random forces, bounces, a sensor and a zone. The game has 27 balls
// that fall upon a block, and are turned, removed and added. Numbers between 0 and 1 come from a generator
// that each language computes exactly: s = 16807 s mod 2147483647, divided by 2147483647.
#include <kinesphere/event_hash.hpp>
#include <kinesphere/kinesphere.hpp>

#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <vector>

using namespace kinesphere;

namespace {

double next_number() {
  static std::uint64_t state = 1;
  state = state * 16807 % 2147483647;
  return static_cast<double>(state) / 2147483647.0;
}

std::uint64_t play() {
  GameWorld game = GameWorld::create({.world = {.box = Box{{0, 0, 0}, {10, 10, 10}}},
                                      .gravity = {0, 0, -9.81},
                                      .response = bouncing(0.9)})
                       .value();
  game.add_static({.shape = Box{{4, 4, 0}, {6, 6, 1}}}).value();
  for (int k = 0; k < 27; ++k) {
    const Vec3 cell{static_cast<double>(k % 3), static_cast<double>(k / 3 % 3), static_cast<double>(k / 9)};
    BodyDefinition ball{.radius = 0.3 + 0.5 * next_number(), .position = Vec3{2, 2, 2} + cell * 3.0};
    ball.mass = ball.radius;
    for (int axis = 0; axis < 3; ++axis) ball.velocity[axis] = 10.0 * (next_number() - 0.5);
    game.add(ball).value();
  }
  EventHash hash;
  for (int frame = 0; frame < 128; ++frame) {
    if (frame % 16 == 0) {
      std::vector<Vec3> turned;
      for (const auto& [x, y, z] : game.velocities()) turned.push_back({y, z, x});
      game.set_velocities(turned).value();
    }
    if (frame == 32) game.remove(game.ids()[3]).value();
    if (frame == 64) game.add({.radius = 0.25, .position = {5, 5, 9.5}}).value();
    if (frame == 96) game.set_acceleration(game.ids()[0], {0, 0, 20}).value();
    for (const Event& event : game.step(0.015625).value()) hash.add(event);
  }
  return hash.value();
}

}  // namespace

int main() {
  std::vector<State> start;
  std::vector<double> radii;
  for (int k = 0; k < 64; ++k) {
    radii.push_back(0.5 + next_number());
    const Vec3 cell{static_cast<double>(k % 4), static_cast<double>(k / 4 % 4), static_cast<double>(k / 16)};
    State state{Vec3{2.5, 2.5, 2.5} + cell * 5.0, {}};
    for (int axis = 0; axis < 3; ++axis) state.velocity[axis] = 20.0 * (next_number() - 0.5);
    start.push_back(state);
  }

  Simulation simulation(World::create({.box = Box{{0, 0, 0}, {20, 20, 20}}}).value());
  simulation.world().set_sensor(0, {.distances = {0.5}}).value();
  const auto forces = simulation.add_motion(
      RandomForces::create(
          {.start = start, .acceleration_limits = std::vector<double>(64, 5.0), .interval = 0.2, .seed = 7})
          .value());
  for (const BodyId body : simulation.add_all(forces, radii).value())
    simulation.world().change(body, {.mass = radii[body.index]}).value();
  simulation.world().add_zone(Box{{5, 5, 5}, {15, 15, 15}}).value();

  EventHash hash;
  for (const Event& event : simulation.events(5.0)) {
    hash.add(event);
    if (event.kind != EventKind::contact_begin && event.kind != EventKind::wall_begin) continue;
    const Response after = response_of(event, bounce(event, 0.9));
    if (after.first_velocity) simulation.set_velocity(event.first, *after.first_velocity).value();
    if (after.second_velocity) simulation.set_velocity(event.second, *after.second_velocity).value();
  }
  std::printf("%016" PRIx64 "\n%016" PRIx64 "\n", hash.value(), play());
  return 0;
}
