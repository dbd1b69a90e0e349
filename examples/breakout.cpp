// Breakout: a ball breaks bricks, a paddle that moves sends it back, and a zone below takes it. The paddle
// aims by where it is hit, so the game answers events in the loop.
#include <kinesphere/game_world.hpp>
#include <kinesphere/response.hpp>

#include <algorithm>
#include <cstdio>
#include <limits>

using namespace kinesphere;

enum Kind : std::uint64_t { ball_kind = 1, paddle_kind, brick_kind, pit_kind };

int main() {
  const double dt = 1.0 / 60, width = 20, speed = 40;
  GameWorld game = GameWorld::create({.world = {.box = Box{{0, -5, 0}, {width, 30, 0}},
                                                .dimensions = 2,
                                                .contact_tolerance = 1e-4,
                                                .contacts = ContactEvents::impacts},
                                      .response = bouncing(1.0)})
                       .value();
  int bricks = 0;
  for (double y = 18; y < 26; y += 1.0)
    for (double x = 1; x < width - 1; x += 2.0, ++bricks)
      game.add_static({.shape = Box{{x, y, 0}, {x + 1.9, y + 0.9, 0}}, .user_data = brick_kind}).value();
  game.add_zone(Box{{0, -5, 0}, {width, -3, 0}}, pit_kind).value();
  const BodyId paddle = game.add_moving_shape({.body = {.position = {width / 2, 0, 0},
                                                        .user_data = paddle_kind,
                                                        .mass = std::numeric_limits<double>::infinity()},
                                               .shape = Box{{-2, -0.3, 0}, {2, 0.3, 0}}})
                            .value();
  const State serve{{width / 2, 5, 0}, {0.3 * speed, 0.9 * speed, 0}};
  const BodyId ball =
      game.add(
              {.radius = 0.3, .position = serve.position, .velocity = serve.velocity, .user_data = ball_kind})
          .value();

  int broken = 0, returned = 0, lost = 0, frame = 0;
  for (; frame < 60 * 120 && broken < bricks; ++frame) {
    // The player: the paddle runs below the ball, a little late.
    const double way = game.state(ball).position.x - game.state(paddle).position.x;
    game.set_velocity(paddle, {std::clamp(10 * way, -18.0, 18.0), 0, 0}).value();
    const double end = game.time() + dt;
    while (const auto next = game.advance(end).value()) {
      const Event& event = *next;
      const auto is = [&](Kind kind) {
        return event.first_user_data == kind || event.second_user_data == kind;
      };
      if (event.kind == EventKind::sensor_enter && is(ball_kind)) {
        ++lost;
        game.teleport(ball, serve).value();
      } else if (event.kind == EventKind::contact_begin && is(brick_kind)) {
        ++broken;
        game.remove(event.first_user_data == brick_kind ? event.first : event.second).value();
      } else if (event.kind == EventKind::contact_begin && is(paddle_kind)) {
        ++returned;
        const double off = (event.point.x - game.state(paddle).position.x) / 2;
        const Vec3 aim{off, 1.0, 0};
        game.set_velocity(ball, aim * (speed / norm(aim))).value();
      }
    }
  }
  std::printf("%d of %d bricks broken in %.0f s, %d balls sent back, %d lost\n", broken, bricks, frame * dt,
              returned, lost);
  return broken > bricks / 2 && game.world().counters().count(EventKind::bound_violation) == 0 ? 0 : 1;
}
