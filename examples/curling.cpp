// Curling: the game brakes all stones by one call in each frame, and its opponent looks ahead: it tries its
// throws in clones of the game. At last the end is played again from a saved game, and ends alike to the bit.
#include <kinesphere/game_world.hpp>
#include <kinesphere/response.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

using namespace kinesphere;

constexpr double radius = 0.145, house = 1.83;
constexpr Vec3 tee{0, 35, 0}, hack{0, 0, 0};

/// Lets the stones glide until all have stopped.
void play(GameWorld& game) {
  constexpr double dt = 1.0 / 60, friction = 0.1;
  std::vector<Vec3> velocities;
  for (bool moves = true; moves;) {
    game.step(dt).value();
    velocities.assign(game.velocities().begin(), game.velocities().end());
    moves = false;
    for (Vec3& velocity : velocities) {
      const double speed = norm(velocity);
      velocity = speed > friction * dt ? velocity * (1 - friction * dt / speed) : Vec3{};
      moves = moves || speed > 0;
    }
    game.set_velocities(velocities).value();
  }
}

void throw_stone(GameWorld& game, std::uint64_t team, double speed, double aim) {
  game.add({.radius = radius, .position = hack, .velocity = {aim * speed, speed, 0}, .user_data = team})
      .value();
}

/// Returns by how much this team's best stone is nearer to the tee than the other team's.
double lead(const GameWorld& game, std::uint64_t team) {
  double nearest[2] = {2 * house, 2 * house};
  for (std::size_t k = 0; k < game.ids().size(); ++k) {
    double& of_team = nearest[game.world().user_data(game.ids()[k]).value()];
    of_team = std::min(of_team, norm(game.positions()[k] - tee));
  }
  return nearest[1 - team] - nearest[team];
}

void throw_best(GameWorld& game, std::uint64_t team) {
  double best = -1e9, best_speed = 0, best_aim = 0;
  for (double speed = 2.55; speed < 3.2; speed += 0.06)
    for (double aim = -0.03; aim < 0.031; aim += 0.01) {
      GameWorld trial = game.clone().value();
      throw_stone(trial, team, speed, aim);
      play(trial);
      if (lead(trial, team) > best) best = lead(trial, team), best_speed = speed, best_aim = aim;
    }
  throw_stone(game, team, best_speed, best_aim);
  play(game);
}

int main() {
  GameWorld game = GameWorld::create({.world = {.box = Box{{-2.4, -2, 0}, {2.4, 40, 0}},
                                                .dimensions = 2,
                                                .contact_tolerance = 1e-5,
                                                .contacts = ContactEvents::impacts},
                                      .response = bouncing(0.9)})
                       .value();
  std::vector<std::byte> saved;
  for (int stone = 0; stone < 6; ++stone) {
    if (stone == 4) saved = game.save().value();
    throw_best(game, stone % 2);
    std::printf("stone %d: team %d leads by %.2f m\n", stone + 1, lead(game, 0) > 0 ? 0 : 1,
                std::abs(lead(game, 0)));
  }
  GameWorld again = GameWorld::restore(saved, bouncing(0.9)).value();
  for (const int team : {0, 1}) throw_best(again, team);
  const bool alike = std::ranges::equal(game.positions(), again.positions());
  std::printf("played again from the saved game: %s\n", alike ? "the same" : "another end");
  return alike && lead(game, 1) > 0 ? 0 : 1;
}
