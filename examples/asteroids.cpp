// Asteroids: space that repeats, a ship with an engine, bullets that last for a second, and rocks that burst
// into two. The response removes what is hit, at the very time of the hit; the loop adds the fragments.
#include <kinesphere/game_world.hpp>
#include <kinesphere/random.hpp>
#include <kinesphere/response.hpp>

#include <cmath>
#include <cstdio>
#include <deque>

using namespace kinesphere;

enum Kind : std::uint64_t { ship = 1, bullet, rock };

Response respond(const Event& event) {
  if (event.kind != EventKind::contact_begin) return {};
  const bool first_shoots = event.first_user_data == bullet, second_shoots = event.second_user_data == bullet;
  if (!first_shoots && !second_shoots) return response_of(event, bounce(event, 1.0));
  return {.first_action = BodyAction::remove, .second_action = BodyAction::remove};
}

int main() {
  const double dt = 1.0 / 60, edge = 100;
  GameWorld game = GameWorld::create({.world = {.box = Box{{0, 0, 0}, {edge, edge, 0}},
                                                .periodic = {.x = true, .y = true},
                                                .dimensions = 2,
                                                .contact_tolerance = 1e-3,
                                                .contacts = ContactEvents::impacts},
                                      .response = respond})
                       .value();
  Random random(5);
  const auto drift = [&] {
    const Vec3 velocity = 8.0 * random.point_in_ball();
    return Vec3{velocity.x, velocity.y, 0};
  };
  const auto add_rock = [&](const Vec3& position, double radius) {
    game.add({.radius = radius,
              .position = position,
              .velocity = drift(),
              .filter = {.category = 1 << rock},
              .user_data = rock,
              .mass = radius * radius})
        .value();
  };
  for (int k = 0; k < 12; ++k) add_rock({20.0 + 20 * (k % 4), 20.0 + 30 * (k / 4), 0}, 4);
  const BodyId player =
      game.add({.radius = 1, .position = {8, 8, 0}, .filter = {.category = 1 << ship}, .user_data = ship})
          .value();

  int shots = 0, hits = 0, bumps = 0;
  std::deque<BodyId> flying;
  for (int frame = 0; frame < 60 * 60; ++frame) {
    const double heading = 0.03 * frame;
    const Vec3 ahead{std::cos(heading), std::sin(heading), 0};
    const State now = game.state(player);
    game.set_acceleration(player, 6.0 * ahead - 0.5 * now.velocity).value();
    if (frame % 10 == 0) {
      flying.push_back(game.add({.radius = 0.1,
                                 .position = now.position + 1.2 * ahead,
                                 .velocity = now.velocity + 60.0 * ahead,
                                 .filter = {.category = 1 << bullet, .mask = 1 << rock},
                                 .user_data = bullet})
                           .value());
      ++shots;
    }
    if (flying.size() > 6) {  // a bullet that has hit is gone already
      if (game.index_of(flying.front())) game.remove(flying.front()).value();
      flying.pop_front();
    }
    const double end = game.time() + dt;
    while (const auto next = game.advance(end).value()) {
      const Event& event = *next;
      if (event.kind != EventKind::contact_begin) continue;
      if (event.first_user_data == ship || event.second_user_data == ship) ++bumps;
      if (respond(event).first_action != BodyAction::remove) continue;
      ++hits;
      const bool first_is_rock = event.first_user_data == rock;
      const double mass = first_is_rock ? event.first_mass : event.second_mass;
      const Vec3 place = (first_is_rock ? event.first_state : event.second_state).position;
      const double radius = std::sqrt(mass / 2);
      if (radius < 1.2) continue;
      for (const double side : {-radius, radius}) add_rock(place + Vec3{0, side, 0}, radius);
    }
  }
  std::printf("%d shots, %d hits, %d bumps; %zu bodies left\n", shots, hits, bumps, game.ids().size());
  return hits > 0 && game.world().counters().count(EventKind::bound_violation) == 0 ? 0 : 1;
}
