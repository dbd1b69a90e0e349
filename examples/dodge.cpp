// Dodge: boulders fall, and the player runs out of their way. Each frame it asks the world what would hit it
// first on three ways, which is exact: a boulder between two frames counts, too. Whoever stands still is hit
// soon.
#include <kinesphere/game_world.hpp>
#include <kinesphere/queries.hpp>
#include <kinesphere/random.hpp>

#include <algorithm>
#include <array>
#include <cstdio>

using namespace kinesphere;

namespace {

enum Kind : std::uint64_t { boulder, player, floor_kind };
constexpr double dt = 1.0 / 60, width = 30;

/// Removes a boulder at the floor; a boulder that meets the player is removed, too.
Response respond(const Event& event) {
  if (event.kind != EventKind::contact_begin) return {};
  Response response;
  if (event.first_user_data == boulder) response.first_action = BodyAction::remove;
  if (event.second_user_data == boulder) response.second_action = BodyAction::remove;
  return response;
}

/// Returns how often the player was hit in a minute.
int play(bool looks) {
  GameWorld game = GameWorld::create({.world = {.dimensions = 2, .contacts = ContactEvents::impacts},
                                      .gravity = {0, -10, 0},
                                      .response = respond})
                       .value();
  game.add_static({.shape = HalfSpace{{0, 1, 0}, 0}, .user_data = floor_kind}).value();
  // The player floats above the floor: it has no weight.
  const BodyId runner = game.add({.radius = 0.5,
                                  .planned_acceleration = -game.gravity(),
                                  .position = {width / 2, 0.6, 0},
                                  .user_data = player})
                            .value();
  Random random(7);
  int hits = 0;
  for (int frame = 0; frame < 60 * 60; ++frame) {
    if (frame % 6 == 0) {
      const Vec3 place{random.uniform(0, width), 25, 0};
      game.add({.radius = random.uniform(0.3, 0.8), .position = place, .filter = {.group = -1}}).value();
    }
    if (looks) {
      // The free height above three places, and the way to the best; the nearer one if they are alike.
      const State now = game.state(runner);
      double best = -1, way = 0;
      for (const double side : {0.0, -2.0, 2.0}) {
        const Vec3 there = now.position + Vec3{side, 0.7, 0};
        if (there.x < 1 || there.x > width - 1) continue;
        const auto hit = game.queries().sphere_cast(there, 0.7, {0, 1, 0}, 12, {.except = runner}).value();
        const double free = (hit.empty() ? 12 : hit.front().upper) - (side == 0 ? 0 : 1);
        if (free > best) best = free, way = side;
      }
      game.set_velocity(runner, {4 * way, 0, 0}).value();
    }
    for (const Event& event : game.step(dt).value())
      hits += event.kind == EventKind::contact_begin && (event.first == runner || event.second == runner);
  }
  return hits;
}

}  // namespace

int main() {
  const int still = play(false), running = play(true);
  std::printf("hit %d times standing still, %d times running\n", still, running);
  return still > 10 && running < still / 3 ? 0 : 1;
}
