// A horde: hundreds of walkers are steered to the player anew in each frame, by one call, push each other,
// and are shot. The events of a frame are looked at after it.
#include <kinesphere/game_world.hpp>
#include <kinesphere/queries.hpp>
#include <kinesphere/response.hpp>

#include <cmath>
#include <cstdio>
#include <vector>

using namespace kinesphere;

enum Kind : std::uint64_t { hero = 1, walker, bullet };

int main() {
  const double dt = 1.0 / 60;
  GameWorld game = GameWorld::create({.world = {.box = Box{{0, 0, 0}, {60, 60, 0}},
                                                .dimensions = 2,
                                                .contact_tolerance = 1e-3,
                                                .contacts = ContactEvents::impacts},
                                      .response = settling(0.3, 0.1)})
                       .value();
  const Filter living{.category = 1, .mask = 3}, shot{.category = 2, .mask = 1};
  const BodyId player =
      game.add({.radius = 0.5, .position = {30, 30, 0}, .filter = living, .user_data = hero}).value();
  for (int k = 0; k < 400; ++k)
    game.add({.radius = 0.4,
              .position = {1.5 + 3 * (k % 20), 1.5 + 3 * (k / 20), 0},
              .filter = living,
              .user_data = walker})
        .value();

  int shots = 0, killed = 0, bites = 0, seen = 0;
  std::vector<Vec3> wanted;
  std::vector<RayQuery> rays;
  for (int frame = 0; frame < 60 * 12; ++frame) {
    // Steering: one velocity for each body, in the order of game.ids().
    const Vec3 goal = game.state(player).position;
    wanted.assign(game.velocities().begin(), game.velocities().end());
    rays.clear();
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      const std::uint64_t kind = game.world().user_data(game.ids()[k]).value();
      const Vec3 way = goal - game.positions()[k];
      if (kind == walker) wanted[k] += (way * (2.0 / (1e-3 + norm(way))) - wanted[k]) * 0.1;
      if (kind == walker) rays.push_back({game.positions()[k], way, norm(way), 0.0, game.ids()[k]});
      if (kind == hero) wanted[k] = {4 * std::cos(0.01 * frame), 4 * std::sin(0.01 * frame), 0};
    }
    game.set_velocities(wanted).value();

    // All walkers look for the player at once: who stands before others sees it.
    const auto sights = game.queries().ray_cast_all(rays).value();
    for (std::size_t k = 0; k < sights.size(); ++k) seen += !sights[k].empty() && sights[k][0].body == player;

    const auto near = game.queries().nearest(goal, 1, {.filter = shot, .except = player}).value();
    if (frame % 6 == 0 && !near.empty()) {
      const Vec3 way = game.state(near[0].body).position - goal;
      game.add({.radius = 0.05,
                .position = goal + way * (0.6 / norm(way)),
                .velocity = way * (50 / norm(way)),
                .filter = shot,
                .user_data = bullet})
          .value();
      ++shots;
    }
    for (const Event& event : game.step(dt).value()) {
      const auto is = [&](Kind kind) {
        return event.first_user_data == kind || event.second_user_data == kind;
      };
      if (event.kind == EventKind::contact_begin && is(hero) && is(walker)) ++bites;
      if (!is(bullet) || (event.kind != EventKind::contact_begin && event.kind != EventKind::wall_begin))
        continue;
      // It may have hit another one earlier in this frame; then it is gone.
      const BodyId shell = event.first_user_data == bullet ? event.first : event.second;
      if (!game.index_of(shell)) continue;
      game.remove(shell).value();
      if (is(walker) && game.index_of(event.partner_of(shell))) {
        game.remove(event.partner_of(shell)).value();
        ++killed;
      }
    }
  }
  std::printf("%d shots, %d walkers killed, %d bites, seen %d times; %zu bodies left\n", shots, killed, bites,
              seen, game.ids().size());
  return killed > 0 && game.world().counters().count(EventKind::bound_violation) == 0 ? 0 : 1;
}
