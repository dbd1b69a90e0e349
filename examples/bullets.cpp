// A game moves its targets frame by frame and bounces them off walls that only the game has. Bullets of 300
// units a second, five a frame, fly by themselves, through a zone that reports each. A body map assigns each
// body of the world to its motion.
#include <kinesphere/kinesphere.hpp>

#include <cmath>
#include <cstdio>
#include <deque>
#include <vector>

using namespace kinesphere;

int main() {
  const double dt = 1.0 / 60;
  std::vector<Vec3> position, velocity;
  for (int k = 0; k < 12; ++k) {
    position.push_back({-9.0 + 1.5 * k, 0.0, -3.0 + 0.5 * k});
    velocity.push_back({3.0 - 0.5 * k, 0, 4});
  }
  FrameMotion frames = FrameMotion::create({.start = position, .interval = dt}).value();
  Ballistic bullets = Ballistic::create({}).value();

  World world = World::create({.contact_tolerance = 1e-4}).value();
  BodyMap bodies;
  const Filter target{.category = 1, .mask = 2}, bullet{.category = 2, .mask = 1};
  bodies.add_all(world, frames, {.radius = 0.3, .filter = target}).value();

  world.add_zone(Box{{-12, -1, -12}, {-11.99, 1, 12}}).value();

  int hits = 0, turns = 0, seen = 0;
  std::deque<BodyId> flying;
  for (int frame = 1; frame <= 600; ++frame) {
    for (std::size_t k = 0; k < position.size(); ++k) {
      position[k] += velocity[k] * dt;
      if (std::abs(position[k].x) > 10) velocity[k].x = -velocity[k].x, ++turns;
      if (std::abs(position[k].z) > 10) velocity[k].z = -velocity[k].z, ++turns;
    }
    bodies.push(world, frames, position).value();

    const double height = 9.0 * std::sin(frame);
    const auto number = bullets.add(world.time(), {{-15, 0, height}, {300, 0, 0}}).value();
    flying.push_back(bodies.add(world, bullets, number, {.radius = 0.02, .filter = bullet}).value());
    if (flying.size() > 6) {
      if (world.contains(flying.front())) bodies.remove(world, flying.front()).value();
      flying.pop_front();
    }

    for (const Event& event : world.events(frames.latest_time(), bodies.probe())) {
      if (event.kind == EventKind::sensor_enter) ++seen;
      if (event.kind != EventKind::contact_begin) continue;
      const bool first_is_bullet = bodies.find(event.first)->motion == &bullets;
      bodies.remove(world, first_is_bullet ? event.first : event.second).value();
      ++hits;
    }
    position = frames.latest();
  }
  std::printf("600 shots, %d seen by the zone, %d hits, %d turns at walls that the world does not know\n",
              seen, hits, turns);
  std::printf("%llu broken promises\n",
              static_cast<unsigned long long>(world.counters().count(EventKind::bound_violation)));
  return world.counters().count(EventKind::bound_violation) == 0 && seen == 600 && hits > 0 ? 0 : 1;
}
