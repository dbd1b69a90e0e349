// Billiards: a table with six pockets, and a player who tries each shot in a copy of the game before taking
// it. Copies continue to the last bit, so the shot on the table ends as the shot in the copy did.
#include <kinesphere/game_world.hpp>
#include <kinesphere/response.hpp>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

using namespace kinesphere;

namespace {

constexpr double radius = 0.0286, length = 2.54, width = 1.27;
constexpr std::uint64_t cue = 0, pocket = 99;

/// Rolls on until all balls have stopped. Returns how many went into pockets; the cue ball counts as minus
/// five.
int play(GameWorld& game) {
  constexpr double dt = 1.0 / 60, friction = 0.3;
  int sunk = 0;
  std::vector<Vec3> velocities;
  for (bool moves = true; moves;) {
    for (const Event& event : game.step(dt).value()) {
      if (event.kind != EventKind::sensor_enter) continue;
      const bool is_first = event.first_user_data != pocket;
      sunk += (is_first ? event.first_user_data : event.second_user_data) == cue ? -5 : 1;
      game.remove(is_first ? event.first : event.second).value();
    }
    velocities.assign(game.velocities().begin(), game.velocities().end());
    moves = false;
    for (Vec3& velocity : velocities) {
      const double speed = norm(velocity);
      velocity = speed > friction * dt ? velocity * (1 - friction * dt / speed) : Vec3{};
      moves = moves || speed > 0;
    }
    game.set_velocities(velocities).value();
  }
  return sunk;
}

}  // namespace

int main() {
  GameWorld game = GameWorld::create({.world = {.box = Box{{0, 0, 0}, {length, width, 0}},
                                                .dimensions = 2,
                                                .contact_tolerance = 1e-7,
                                                .contacts = ContactEvents::impacts},
                                      .response = bouncing(0.95)})
                       .value();
  // A ball is in a pocket once its centre is within 0.06 of the pocket's.
  for (const double x : {0.0, length / 2, length})
    for (const double y : {0.0, width}) game.add_zone(Ball{{x, y, 0}, 0.06 - radius + 0.02}, pocket).value();
  const BodyId white =
      game.add({.radius = radius, .position = {0.6, 0.62, 0}, .velocity = {5, 0.02, 0}, .user_data = cue})
          .value();
  for (int row = 0; row < 5; ++row)
    for (int k = 0; k <= row; ++k) {
      const double spacing = radius + 1e-4;
      const Vec3 place{1.9 + row * std::sqrt(3.0) * spacing, width / 2 + (2 * k - row) * spacing, 0};
      game.add({.radius = radius, .position = place, .user_data = 1}).value();
    }
  int left = 15 - play(game), shots = 0, tried = 0;
  std::printf("break: %d balls left\n", left);
  bool as_foreseen = true;
  for (; left > 0 && shots < 30; ++shots) {
    int best = -99;
    Vec3 best_shot;
    for (int angle = 0; angle < 180 && best < 2; ++angle, ++tried) {
      const double turn = angle * std::numbers::pi / 90;
      const Vec3 shot{2.5 * std::cos(turn), 2.5 * std::sin(turn), 0};
      GameWorld trial = game.clone().value();
      trial.set_velocity(white, shot).value();
      if (const int sunk = play(trial); sunk > best) best = sunk, best_shot = shot;
    }
    game.set_velocity(white, best_shot).value();
    const int sunk = play(game);
    as_foreseen = as_foreseen && sunk == best;
    left -= sunk;
  }
  std::printf("%d shots after %d trials, %d balls left, all as foreseen: %s\n", shots, tried, left,
              as_foreseen ? "yes" : "no");
  return left == 0 && as_foreseen ? 0 : 1;
}
