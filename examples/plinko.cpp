// Plinko: balls fall through a board of pegs, and are counted where they land. A ball that hits a peg leaves
// it with a part of its speed; `settling` brings to rest what would hop upon a peg for ever.
#include <kinesphere/game_world.hpp>
#include <kinesphere/random.hpp>
#include <kinesphere/response.hpp>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

using namespace kinesphere;

int main() {
  const double dt = 1.0 / 60;
  const int rows = 10, columns = 13;
  GameWorld game = GameWorld::create({.world = {.box = Box{{-7, -1, 0}, {7, 14, 0}},
                                                .dimensions = 2,
                                                .contact_tolerance = 1e-4,
                                                .contacts = ContactEvents::impacts},
                                      .gravity = {0, -9.81, 0},
                                      .response = settling(0.4, 0.1)})
                       .value();
  for (int row = 0; row < rows; ++row)
    for (int k = 0; k < columns - row % 2; ++k)
      game.add_static({.shape = Ball{{k - 0.5 * (columns - 1) + 0.5 * (row % 2), 1.5 + 0.9 * row, 0}, 0.12}})
          .value();
  const BodyId tray = game.add_zone(Box{{-7, -1, 0}, {7, 0, 0}}).value();

  Random random(11);
  std::vector<int> bins(columns);
  int dropped = 0, landed = 0;
  for (int frame = 0; frame < 60 * 120 && landed < 300; ++frame) {
    if (frame % 6 == 0 && dropped < 300) {
      // Balls do not meet each other: neither has the category of the other in its mask.
      game.add({.radius = 0.2,
                .position = {0.2 * random.point_in_ball().x, 12, 0},
                .filter = {.category = 2, .mask = 1}})
          .value();
      ++dropped;
    }
    for (const Event& event : game.step(dt).value()) {
      if (event.kind != EventKind::sensor_enter) continue;
      const BodyId ball = event.partner_of(tray);
      const double x = game.state(ball).position.x;
      ++bins[static_cast<std::size_t>(std::clamp(x + 0.5 * columns, 0.0, columns - 1.0))];
      ++landed;
      game.remove(ball).value();
    }
  }
  for (const int count : bins)
    std::printf("%3d %s\n", count, std::string(static_cast<std::size_t>(count), '*').c_str());
  std::printf("%d of %d balls have landed, %zu are in the air\n", landed, dropped, game.positions().size());
  const auto top = std::max_element(bins.begin(), bins.end()) - bins.begin();
  return landed == 300 && 4 <= top && top <= 8 ? 0 : 1;
}
