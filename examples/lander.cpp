// Lander: a ship comes down upon hills, and has to touch the pad slowly. The hills are one chain of segments,
// the engine is an acceleration, and fuel is what it has burnt. A pilot of ten lines steers; without one the
// ship crashes.
#include <kinesphere/game_world.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <vector>

using namespace kinesphere;

namespace {

constexpr double dt = 1.0 / 60, weight = 1.6, strongest = 4.0;
constexpr Vec3 pad{62, 8, 0};

struct Landing {
  Vec3 place{};
  double speed = 0, fuel = 0, time = 0;
};

/// Flies until the ship touches the ground.
Landing fly(bool has_pilot) {
  GameWorld game = GameWorld::create({.world = {.dimensions = 2, .contacts = ContactEvents::impacts},
                                      .gravity = {0, -weight, 0}})
                       .value();
  std::vector<Vec3> hills;
  for (int x = 0; x <= 100; ++x)
    hills.push_back(
        {1.0 * x, x >= 60 && x <= 64 ? pad.y : 8 + 3 * std::sin(0.3 * x) * std::sin(0.11 * x), 0});
  game.add_static({.shape = Mesh::chain(hills).value()}).value();
  const BodyId ship = game.add({.radius = 0.5, .position = {8, 40, 0}, .velocity = {6, 0, 0}}).value();

  Landing landing;
  while (game.time() < 120) {
    const State now = game.state(ship);
    Vec3 engine;
    if (has_pilot) {
      // First above the pad, then down: as fast as half of the engine can stop.
      const Vec3 way = pad + Vec3{0, 0.5, 0} - now.position;
      const bool is_above = std::abs(way.x) < 1.5;
      const double sink = is_above ? std::sqrt(std::max(0.0, -way.y)) : 2.0;
      const Vec3 wanted{std::clamp(0.4 * way.x, -6.0, 6.0), is_above || way.y < -15 ? -0.3 - sink : 0.0, 0};
      engine = 2.0 * (wanted - now.velocity) + Vec3{0, weight, 0};
      if (norm(engine) > strongest) engine = engine * (strongest / norm(engine));
    }
    game.set_acceleration(ship, engine).value();
    landing.fuel += norm(engine) * dt;
    const auto events = game.step(dt).value();
    if (events.empty()) continue;
    const Event& touch = events.front();
    return {touch.point, touch.approach_speed, landing.fuel, touch.time};
  }
  return landing;
}

}  // namespace

int main() {
  const Landing crash = fly(false), soft = fly(true);
  std::printf("without a pilot: %4.1f m/s at x = %.1f after %.1f s\n", crash.speed, crash.place.x,
              crash.time);
  std::printf("with a pilot:    %4.1f m/s at x = %.1f after %.1f s, fuel %.0f m/s\n", soft.speed,
              soft.place.x, soft.time, soft.fuel);
  return crash.speed > 8 && soft.speed < 1.5 && std::abs(soft.place.x - pad.x) < 2 ? 0 : 1;
}
