// 300 spheres in a box, pushed around by forces that the world does not know, bounce off each other and the
// walls.
#include <kinesphere/motion/random_forces.hpp>
#include <kinesphere/random.hpp>
#include <kinesphere/response.hpp>
#include <kinesphere/world.hpp>

#include <cstdio>
#include <vector>

using namespace kinesphere;

int main() {
  const Box box{{0, 0, 0}, {100, 100, 100}};
  std::vector<State> start;
  Random random(1);
  for (int x = 0; x < 10; ++x)
    for (int y = 0; y < 10; ++y)
      for (int z = 0; z < 3; ++z)
        start.push_back({{10.0 * x + 5, 10.0 * y + 5, 30.0 * z + 20}, random.point_in_ball() * 30});
  RandomForces motion =
      RandomForces::create({.start = start, .acceleration_limits = std::vector(start.size(), 20.0)}).value();

  World world =
      World::create({.box = box, .contacts = ContactEvents::impacts, .allow_overlap = false}).value();
  for (std::uint32_t body = 0; body < motion.size(); ++body) {
    BodyDefinition definition = motion.definition(body, 0.0);
    definition.radius = 2.0;
    world.add(definition).value();
  }

  const auto set_velocity = [&](BodyId body, double time, const Vec3& velocity) {
    motion.set_velocity(body.index, time, velocity).value();
    world.set_velocity(body, velocity).value();
  };
  for (const Event& event : world.events(10.0, motion.probe())) {
    if (event.kind != EventKind::contact_begin && event.kind != EventKind::wall_begin) continue;
    const Bounce after = bounce(event, 1.0);
    set_velocity(event.first, event.time, after.first_velocity);
    if (event.second != no_body) set_velocity(event.second, event.time, after.second_velocity);
  }

  const Counters& counters = world.counters();
  std::printf("%llu bounces between spheres, %llu off walls, %.1f probes per sphere and second\n",
              static_cast<unsigned long long>(counters.count(EventKind::contact_begin)),
              static_cast<unsigned long long>(counters.count(EventKind::wall_begin)),
              static_cast<double>(counters.probes) / (10.0 * static_cast<double>(world.size())));
}
