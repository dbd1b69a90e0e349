// Cars whose poses a simulator gives twenty times a second: positions and orientations, and nothing in
// between. One turns beside another, and the tail that swings out meets it between two poses.
#include <kinesphere/body_map.hpp>
#include <kinesphere/motion/frame_motion.hpp>
#include <kinesphere/world.hpp>

#include <cstdio>
#include <numbers>
#include <vector>

using namespace kinesphere;

int main() {
  // A car that stands, and one beside it that turns on the spot.
  std::vector<Vec3> positions{{0, 0, 0}, {0, 2.9, 0}};
  std::vector<Quaternion> rotations(2);

  World world = World::create({.contact_tolerance = 1e-3, .contacts = ContactEvents::impacts}).value();
  BodyMap bodies;
  FrameMotion frames = FrameMotion::create({.start = positions, .rotations = rotations}).value();
  const RigidBody car{.parts = {box_part({{-2, -0.9, -0.7}, {2, 0.9, 0.7}}, 0.05)}};
  for (std::uint32_t k = 0; k < positions.size(); ++k) bodies.add_rigid_body(world, frames, k, car).value();

  double time = 0.0, met = 0.0;
  for (int pose = 1; pose <= 40 && met == 0.0; ++pose) {
    time += 1.0 / 20;
    rotations[1] = rotation_by({0, 0, 0.25 * std::numbers::pi * time});  // an eighth of a turn a second
    bodies.push(world, frames, positions, rotations, time).value();
    for (const Event& event : world.events(time, bodies.probe())) {
      std::printf("pose %d: a corner meets the other car at %.4f s, at a speed of %.2f\n", pose, event.time,
                  event.approach_speed);
      met = event.time;
    }
  }
  return met > 0.0 ? 0 : 1;
}
