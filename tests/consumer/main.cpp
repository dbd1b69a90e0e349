// Two ballistic spheres that meet head-on at t = 4, watched through the installed library.
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <kinesphere/version.hpp>
#include <kinesphere/world.hpp>
#include <span>

int main() {
  using namespace kinesphere;

  World world = World::create({}).value();
  world.add({.radius = 1, .position = {0, 0, 0}, .velocity = {1, 0, 0}}).value();
  world.add({.radius = 1, .position = {10, 0, 0}, .velocity = {-1, 0, 0}}).value();

  const State initial[] = {{{0, 0, 0}, {1, 0, 0}}, {{10, 0, 0}, {-1, 0, 0}}};
  auto probe = [&](std::span<const BodyId> ids, double time, std::span<State> states) {
    for (std::size_t k = 0; k < ids.size(); ++k) {
      const State& body = initial[ids[k].index];
      states[k] = {body.position + time * body.velocity, body.velocity};
    }
  };
  const auto event = world.advance(5.0, probe).value();
  if (!event || event->kind != EventKind::contact_begin || std::abs(event->time - 4.0) > 1e-5) {
    std::fputs("the contact at t = 4 was not found\n", stderr);
    return 1;
  }
  std::printf("kinesphere %s: contact at t = %.6f\n", version.data(), event->time);
  return 0;
}
