// Pinball: a ball that bumpers make faster with each hit, walls as thin as lines, and two flippers. A loop of
// frames would lose such a ball through a wall; here it stays on the table until it drains between the
// flippers, which strike at the moment of the contact.
#include <kinesphere/game_world.hpp>
#include <kinesphere/random.hpp>
#include <kinesphere/response.hpp>

#include <algorithm>
#include <cstdio>
#include <vector>

using namespace kinesphere;

namespace {

enum Kind : std::uint64_t { ball_kind, wall_kind, bumper_kind, flipper_kind, target_kind, drain_kind };

/// Bumpers throw the ball away faster than it came, up to 60; all else dampens it.
Response respond(const Event& event) {
  if (event.kind != EventKind::contact_begin && event.kind != EventKind::wall_begin) return {};
  const std::uint64_t other =
      event.first_user_data == ball_kind ? event.second_user_data : event.first_user_data;
  const bool throws = other == bumper_kind && event.approach_speed < 50;
  return response_of(event, bounce(event, throws ? 1.2 : 0.7));
}

}  // namespace

int main() {
  const double dt = 1.0 / 60;
  GameWorld game = GameWorld::create({.world = {.box = Box{{0, -4, 0}, {20, 40, 0}},
                                                .dimensions = 2,
                                                .contact_tolerance = 1e-4,
                                                .contacts = ContactEvents::impacts},
                                      .gravity = {0, -15, 0},
                                      .response = respond})
                       .value();
  const auto wall = [&](const std::vector<Vec3>& corners, Kind kind) {
    game.add_static({.shape = Mesh::chain(corners).value(), .user_data = kind}).value();
  };
  wall({{0, 34, 0}, {2, 38, 0}, {6, 39.9, 0}, {14, 39.9, 0}, {18, 38, 0}, {20, 34, 0}}, wall_kind);
  wall({{0, 10, 0}, {5, 5.5, 0}}, wall_kind);
  wall({{20, 10, 0}, {15, 5.5, 0}}, wall_kind);
  wall({{5, 5.5, 0}, {8.9, 3.5, 0}}, flipper_kind);
  wall({{15, 5.5, 0}, {11.1, 3.5, 0}}, flipper_kind);
  for (const Vec3& centre :
       {Vec3{6, 28, 0}, Vec3{14, 28, 0}, Vec3{10, 22, 0}, Vec3{4.5, 18, 0}, Vec3{15.5, 18, 0}})
    game.add_static({.shape = Ball{centre, 1.4}, .user_data = bumper_kind}).value();
  for (int k = 0; k < 5; ++k)
    game.add_static({.shape = Box{{5.0 + 2 * k, 34, 0}, {6.6 + 2 * k, 34.3, 0}}, .user_data = target_kind})
        .value();
  game.add_zone(Box{{0, -4, 0}, {20, -1, 0}}, drain_kind).value();
  const State plunger{{18.5, 12, 0}, {-4, 34, 0}};
  const BodyId ball =
      game.add({.radius = 0.5, .position = plunger.position, .velocity = plunger.velocity}).value();

  Random player(3);
  int score = 0, targets = 0, strokes = 0, balls = 1;
  double fastest = 0;
  while (balls <= 3 && game.time() < 600) {
    const double end = game.time() + dt;
    while (const auto next = game.advance(end).value()) {
      const Event& event = *next;
      fastest = std::max(fastest, norm(game.state(ball).velocity));
      const std::uint64_t other = event.first == ball ? event.second_user_data : event.first_user_data;
      if (event.kind == EventKind::sensor_enter) {
        if (++balls <= 3) game.teleport(ball, plunger).value();
      } else if (event.kind != EventKind::contact_begin) {
        continue;
      } else if (other == bumper_kind) {
        score += 100;
      } else if (other == target_kind) {
        score += 1000, ++targets;
        game.remove(event.partner_of(ball)).value();
      } else if (other == flipper_kind && player.uniform() < 0.8) {
        // The player strikes in time, most of the time.
        game.set_velocity(ball, {player.uniform(-8, 8), player.uniform(28, 36), 0}).value();
        ++strokes;
      }
    }
  }
  std::printf("%d points: %d of 5 targets, %d strokes, in %.0f s; the ball was as fast as %.0f\n", score,
              targets, strokes, game.time(), fastest);
  return balls == 4 && score > 1000 && strokes > 5 ? 0 : 1;
}
