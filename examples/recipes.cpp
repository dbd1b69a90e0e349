// A small game level: a plate that is passed from below and stands from above, resting and walking off its
// edge, a pit that sends the player back to the start, and a platform that carries.
#include <kinesphere/body_map.hpp>
#include <kinesphere/motion/steered_motion.hpp>
#include <kinesphere/world.hpp>

#include <cstdio>
#include <vector>

using namespace kinesphere;

int main() {
  const Vec3 gravity{0, 0, -10};
  constexpr std::uint32_t player = 0, platform = 1;
  const State start{{0, 0, 0.3}, {0, 0, 8}}, respawn{{4, 0, 5}, {}};
  SteeredMotion motion =
      SteeredMotion::create({.start = {start, {{4, 0, -3}, {0, 0, 0.5}}}, .acceleration_limits = {10, 0}})
          .value();
  motion.steer(player, 0.0, gravity).value();

  World world = World::create({.contact_tolerance = 1e-4}).value();
  BodyMap bodies;
  const std::vector<BodyId> ids = bodies.add_all(world, motion, std::vector{0.3, 1.0}).value();
  const BodyId plate = world.add_static({.shape = Box{{-1, -1, 2}, {1, 1, 2.2}}}).value();
  constexpr SensorClass pit = 1;
  world.set_sensor(pit, {.distances = {0.0}}).value();
  const Box below{{-50, -50, -12}, {50, 50, -10}};
  world.add_static({.shape = below, .solid = false, .sensor_class = pit}).value();

  int landings = 0, falls = 0, rides = 0;
  const auto play_until = [&](double until) {
    while (const auto event = world.advance(until, bodies.probe()).value()) {
      if (event->kind == EventKind::sensor_enter) {
        bodies.teleport(world, ids[player], respawn).value();
        ++falls;
      } else if (event->kind == EventKind::contact_end) {
        motion.steer(player, event->time, gravity).value();
      } else if (event->kind == EventKind::contact_begin && event->second == plate) {
        if (event->normal.z > 0) continue;  // from below: it passes
        bodies.set_velocity(world, ids[player], {}).value();
        motion.steer(player, event->time, {}).value();
        world.sleep(ids[player]).value();
        ++landings;
      } else if (event->kind == EventKind::contact_begin) {
        bodies.set_velocity(world, ids[player], motion.state(platform, event->time).velocity).value();
        motion.steer(player, event->time, {}).value();
        ++rides;
      }
    }
  };
  play_until(3.0);
  std::printf("landed on the plate %d time, at a height of %.2f\n", landings,
              motion.state(player, 3.0).position.z);
  bodies.set_velocity(world, ids[player], {2, 0, 0}).value();  // walks off the edge: this wakes it
  play_until(12.0);
  std::printf("fell into the pit %d time, stepped onto the platform %d time\n", falls, rides);
  const double above = motion.state(player, 12.0).position.z - motion.state(platform, 12.0).position.z;
  std::printf("%.2f above its middle, after %llu probes in 12 s\n", above,
              static_cast<unsigned long long>(world.counters().probes));
  return landings == 1 && falls == 1 && rides == 1 ? 0 : 1;
}
