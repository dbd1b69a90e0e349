// A game at 60 frames a second. It moves its balls as games do, v += g dt, x += v dt, and hands each frame
// over. Contacts come with their exact times between the last two frames and are answered there: fast balls
// never pass through each other or the walls.
#include <kinesphere/body_map.hpp>
#include <kinesphere/motion/frame_motion.hpp>
#include <kinesphere/random.hpp>
#include <kinesphere/response.hpp>
#include <kinesphere/world.hpp>

#include <algorithm>
#include <cstdio>
#include <vector>

using namespace kinesphere;

int main() {
  const double dt = 1.0 / 60;
  const Vec3 gravity{0, 0, -9.81};
  const Box room{{0, 0, 0}, {10, 10, 10}};
  const double radius = 0.2;

  // The game's own bodies.
  std::vector<Vec3> position, velocity;
  Random random(7);
  for (int x = 0; x < 6; ++x)
    for (int y = 0; y < 6; ++y)
      for (int z = 0; z < 6; ++z) {
        position.push_back({0.5 + 1.8 * x, 0.5 + 1.8 * y, 1.0 + 1.5 * z});
        velocity.push_back(60 * random.point_in_ball());  // up to a unit, five radii, a frame
      }

  FrameMotion frames = FrameMotion::create({.start = position}).value();
  World world =
      World::create({.box = room, .contact_tolerance = 1e-3, .contacts = ContactEvents::impacts}).value();
  BodyMap bodies;
  bodies.add_all(world, frames, {.radius = radius}).value();

  double deepest = 0.0, time = 0.0;
  for (int frame = 1; frame <= 600; ++frame) {
    for (std::size_t k = 0; k < position.size(); ++k) {
      velocity[k] += gravity * dt;
      position[k] += velocity[k] * dt;
    }
    time += dt;
    bodies.push(world, frames, position, time).value();
    const auto set_velocity = [&](BodyId ball, const Vec3& bounced) {
      velocity[ball.index] = bounced;
      bodies.set_velocity(world, ball, bounced).value();
    };
    for (const Event& event : world.events(time, bodies.probe())) {
      if (event.kind != EventKind::contact_begin && event.kind != EventKind::wall_begin) continue;
      const Bounce after = bounce(event, 0.8);
      set_velocity(event.first, after.first_velocity);
      if (event.second != no_body) set_velocity(event.second, after.second_velocity);
    }
    position = frames.latest();

    for (const Vec3& p : position)  // here the game draws them
      deepest = std::max(deepest, radius - std::min({p.x, p.y, p.z, 10 - p.x, 10 - p.y, 10 - p.z}));
  }

  const Counters& counters = world.counters();
  std::printf("%llu bounces between balls, %llu off walls, in 600 frames\n",
              static_cast<unsigned long long>(counters.count(EventKind::contact_begin)),
              static_cast<unsigned long long>(counters.count(EventKind::wall_begin)));
  std::printf("no ball was ever deeper in a wall than %.4f\n", deepest);
  std::printf("%llu broken promises\n",
              static_cast<unsigned long long>(counters.count(EventKind::bound_violation)));
  return deepest <= 1e-3 && counters.count(EventKind::bound_violation) == 0 ? 0 : 1;
}
