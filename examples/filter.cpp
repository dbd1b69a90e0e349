// Bullets that pass through friends. Red fires through its own row at the blue one; half-way through the game
// the shields of red are switched off.
#include <kinesphere/world.hpp>

#include <cstdio>
#include <map>
#include <string>

using namespace kinesphere;

constexpr std::uint64_t red = 1, blue = 2, red_bullet = 4;

int main() {
  World world = World::create({.contact_tolerance = 1e-4}).value();
  std::map<BodyId, std::string> name;
  for (int k = 0; k < 5; ++k) {
    name[world.add({.radius = 1, .position = {10, 4.0 * k, 0}, .filter = {.category = red, .mask = blue}})
             .value()] = "red";
    name[world.add({.radius = 1, .position = {40, 4.0 * k, 0}, .filter = {.category = blue}}).value()] =
        "blue";
  }

  // A body without a name is a bullet and flies straight on, at 900 units a second, from its start.
  struct Shot {
    double time;
    Vec3 from;
  };
  std::map<BodyId, Shot> shots;
  const Vec3 velocity{900, 0, 0};
  auto probe = [&](std::span<const BodyId> ids, double time, std::span<State> states) {
    for (std::size_t k = 0; k < ids.size(); ++k) {
      const auto shot = shots.find(ids[k]);
      states[k] = shot == shots.end()
                      ? State{world.body(ids[k]).value().definition.position, {}}
                      : State{shot->second.from + velocity * (time - shot->second.time), velocity};
    }
  };

  std::map<std::string, int> hits_before, hits_after;
  for (int round = 0; round < 100; ++round) {
    const double now = 0.01 * round;
    if (round == 50) {  // takes effect at once, also for bullets in flight
      for (const auto& [id, side] : name)
        if (side == "red") world.change(id, {.filter = Filter{.category = red}}).value();
    }
    const Vec3 muzzle{0, 4.0 * (round % 5) + 0.3, 0};
    const BodyId bullet = world
                              .add({.radius = 0.02,
                                    .position = muzzle,
                                    .velocity = velocity,
                                    .filter = {.category = red_bullet, .mask = red | blue}})
                              .value();
    shots[bullet] = {now, muzzle};

    for (const Event& event : world.events(now + 0.01, probe)) {
      if (event.kind != EventKind::contact_begin) continue;
      const bool first_is_bullet = shots.count(event.first) != 0;
      const BodyId hit = first_is_bullet ? event.second : event.first;
      ++(round < 50 ? hits_before : hits_after)[name[hit]];
      world.remove(first_is_bullet ? event.first : event.second).value();
    }
  }

  std::printf("shields on:  %d hits on red, %d on blue\n", hits_before["red"], hits_before["blue"]);
  std::printf("shields off: %d hits on red, %d on blue\n", hits_after["red"], hits_after["blue"]);
  return hits_before["red"] == 0 && hits_before["blue"] >= 45 && hits_after["red"] >= 45 ? 0 : 1;
}
