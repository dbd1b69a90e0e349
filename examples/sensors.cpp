// A light barrier one centimetre thin and ten thousand bullets of 1000 units per second: how many are
// detected?
#include <kinesphere/random.hpp>
#include <kinesphere/world.hpp>

#include <cmath>
#include <cstdio>
#include <set>
#include <vector>

using namespace kinesphere;

constexpr int bullet_count = 10000;
constexpr double thickness = 0.01;
constexpr double bullet_radius = 0.005;
constexpr double seconds = 1.0;

/// Returns how many bullets are in the barrier at one of the steps of a loop with `rate` steps a second.
int seen_by_steps(const std::vector<State>& bullets, double rate) {
  std::set<std::size_t> seen;
  for (int step = 0; step <= seconds * rate; ++step)
    for (std::size_t k = 0; k < bullets.size(); ++k) {
      const double x = bullets[k].position.x + bullets[k].velocity.x * (step / rate);
      if (std::abs(x) <= 0.5 * thickness + bullet_radius) seen.insert(k);
    }
  return static_cast<int>(seen.size());
}

int main() {
  World world = World::create({}).value();
  // A zone senses, and nothing bounces off it. It does not move, so it is never probed.
  const Vec3 half{0.5 * thickness, 10, 10};
  const BodyId barrier = world.add_zone(Box{-half, half}).value();

  Random random(1);
  std::vector<State> bullets;
  std::vector<BodyDefinition> definitions;
  for (int k = 0; k < bullet_count; ++k) {
    const double way = random.uniform(1, 990);
    bullets.push_back({{-way, random.uniform(-9, 9), random.uniform(-9, 9)}, {1000, 0, 0}});
    // Bullets do not sense each other: no mask has bit 2.
    definitions.push_back({.radius = bullet_radius,
                           .position = bullets.back().position,
                           .velocity = bullets.back().velocity,
                           .filter = {.category = 2, .mask = 1}});
  }
  const std::vector<BodyId> ids = world.add_all(definitions).value();
  const auto probe = [&](std::span<const BodyId> asked, double time, std::span<State> states) {
    for (std::size_t k = 0; k < asked.size(); ++k) {
      states[k] = bullets[asked[k].index - ids.front().index];
      states[k].position += states[k].velocity * time;
    }
  };

  int entered = 0, left = 0;
  for (const Event& event : world.events(seconds, probe)) {
    if (!event.is_sensed_by(barrier)) continue;
    if (event.kind == EventKind::sensor_enter) ++entered;
    if (event.kind == EventKind::sensor_leave) ++left;
  }
  std::printf("of %d bullets\n", bullet_count);
  for (const double rate : {60.0, 240.0, 1000.0})
    std::printf("%6d  seen by a loop of %.0f Hz\n", seen_by_steps(bullets, rate), rate);
  std::printf("%6d  seen by the world, and %d seen leaving, with %.1f probes of each\n", entered, left,
              static_cast<double>(world.counters().probes) / bullet_count);
  return entered == bullet_count && left == bullet_count ? 0 : 1;
}
