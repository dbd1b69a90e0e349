// Two drones, one circling and one hovering in its way. The world gets their limits, but not their paths.
#include <kinesphere/world.hpp>

#include <cmath>
#include <cstdio>

using namespace kinesphere;

int main() {
  World world = World::create({.contact_tolerance = 1e-6}).value();
  // A circle of radius 20 flown at speed 10 takes an acceleration of 5.
  const BodyId circling =
      world.add({.radius = 1, .acceleration_limit = 5.001, .position = {20, 0, 0}, .velocity = {0, 10, 0}})
          .value();
  world.add({.radius = 1, .acceleration_limit = 0.5, .position = {-20, 1.5, 0}}).value();

  // Called only when it can matter; gives the true positions and velocities of bodies.
  auto probe = [&](std::span<const BodyId> ids, double t, std::span<State> states) {
    const double c = std::cos(t / 2), s = std::sin(t / 2);
    for (std::size_t k = 0; k < ids.size(); ++k)
      states[k] = ids[k] == circling ? State{{20 * c, 20 * s, 0}, {-10 * s, 10 * c, 0}}
                                     : State{{-20, 1.5, 0}, {0, 0, 0}};
  };
  for (const Event& event : world.events(30.0, probe)) {
    if (event.kind == EventKind::bound_violation) std::puts("A drone accelerates more than promised:");
    std::printf("%9.6f s  %-13s  gap %.1e, closing at %.3f\n", event.time, name_of(event.kind).data(),
                event.gap, event.approach_speed);
  }
  std::printf("%llu probes in 30 s\n", static_cast<unsigned long long>(world.counters().probes));
}
