// Fifteen balls lie in a rack. By their limits they could move, so the world would have to probe them all the
// time; but they sleep, and cost nothing until a thrown ball wakes them.
#include <kinesphere/response.hpp>
#include <kinesphere/world.hpp>

#include <cmath>
#include <cstdio>
#include <vector>

using namespace kinesphere;

int main() {
  World world = World::create({.contacts = ContactMode::impacts}).value();
  std::vector<State> state;
  std::vector<double> since;
  std::vector<BodyId> still;
  const auto add = [&](const Vec3& position, const Vec3& velocity) {
    state.push_back({position, velocity});
    since.push_back(world.time());
    return world.add({.radius = 1, .acceleration_limit = 1, .position = position, .velocity = velocity})
        .value();
  };
  for (int row = 0; row < 5; ++row)
    for (int k = 0; k <= row; ++k) still.push_back(add({row * std::sqrt(3.0), 2.0 * k - row, 0}, {}));

  const auto where = [&](BodyId ball, double time) {
    const auto [position, velocity] = state[ball.index];
    return State{position + velocity * (time - since[ball.index]), velocity};
  };
  const auto probe = [&](std::span<const BodyId> ids, double time, std::span<State> states) {
    for (std::size_t k = 0; k < ids.size(); ++k) states[k] = where(ids[k], time);
  };
  const auto turn = [&](BodyId ball, const Vec3& velocity) {
    state[ball.index] = {where(ball, world.time()).position, velocity};
    since[ball.index] = world.time();
    world.set_velocity(ball, velocity).value();
  };

  if (world.advance(1.0, probe).value()) return 1;
  for (const BodyId ball : still) world.sleep(ball).value();
  // The place of each sleeping ball is probed once more.
  if (world.advance(1.0, probe).value()) return 1;
  const auto awake_probes = world.counters().probes;
  if (world.advance(1000.0, probe).value()) return 1;
  const auto resting_probes = world.counters().probes - awake_probes;

  add({-20, 0.1, 0}, {10, 0, 0});
  int awake = 0, hits = 0;
  while (auto event = world.advance(1003.0, probe).value()) {
    if (event->kind == EventKind::woke) ++awake;
    if (event->kind != EventKind::contact_begin) continue;
    const Bounce after = bounce(*event, 0.95);
    turn(event->first, after.first_velocity);
    turn(event->second, after.second_velocity);
    ++hits;
  }
  std::printf("%llu probes in one second awake, %llu in 999 at rest; then %d balls woke, in %d hits\n",
              static_cast<unsigned long long>(awake_probes), static_cast<unsigned long long>(resting_probes),
              awake, hits);
  return resting_probes == 0 && awake == 15 ? 0 : 1;
}
