// Ships in a harbour, 30 to 400 m long: capsules that turn slowly. Two pass each other at 77 m, which
// circles around them would call a collision; a third runs into the long one's side.
#include <kinesphere/kinesphere.hpp>

#include <cmath>
#include <cstdio>
#include <vector>

using namespace kinesphere;

int main() {
  struct Ship {
    const char* name;
    double length, beam;
    State start;
    double heading, rate_of_turn;  // radians, from east to north
  };
  const double degree = 3.14159265358979323846 / 180;
  const std::vector<Ship> ships{
      {"tanker", 400, 60, {{0, 0, 0}, {0, 6, 0}}, 90 * degree, 0},
      {"ferry", 160, 26, {{120, 900, 0}, {0, -9, 0}}, -90 * degree, 0},
      {"tug", 30, 10, {{-520, 520, 0}, {5, 0.4, 0}}, 6 * degree, 0.5 * degree},
  };
  // In the plane; a contact counts within a centimetre. Nobody knows the courses, only that a ship changes
  // its velocity by at most 0.05 m/s^2 and turns by at most 2 degrees a second, with at most 0.5 degrees /
  // s^2.
  World world = World::create({.dimensions = 2, .contact_tolerance = 0.01}).value();
  std::vector<BodyId> ids;
  const auto rotation_of = [&](const Ship& ship, double t) {
    return Rotation{rotation_by({0, 0, ship.heading + ship.rate_of_turn * t}), {0, 0, ship.rate_of_turn}};
  };
  for (const Ship& ship : ships) {
    const double half = (ship.length - ship.beam) / 2;
    ids.push_back(world
                      .add_rigid_body({.body = {.acceleration_limit = 0.05,
                                                .position = ship.start.position,
                                                .velocity = ship.start.velocity},
                                       .parts = {{{-half, 0, 0}, {half, 0, 0}, ship.beam / 2}},
                                       .rotation = rotation_of(ship, 0),
                                       .angular_acceleration_limit = 0.5 * degree,
                                       .largest_angular_speed = 2 * degree})
                      .value());
  }
  const auto ship_of = [&](BodyId id) -> const Ship& {
    return ships[static_cast<std::size_t>(std::find(ids.begin(), ids.end(), id) - ids.begin())];
  };
  world
      .set_rotation_probe([&](std::span<const BodyId> asked, double t, std::span<Rotation> rotations) {
        for (std::size_t k = 0; k < asked.size(); ++k) rotations[k] = rotation_of(ship_of(asked[k]), t);
      })
      .value();
  const auto probe = [&](std::span<const BodyId> asked, double t, std::span<State> states) {
    for (std::size_t k = 0; k < asked.size(); ++k) {
      const State& start = ship_of(asked[k]).start;
      states[k] = {start.position + start.velocity * t, start.velocity};
    }
  };

  double least = 1e9;
  for (int second = 1; second <= 100; ++second) {
    while (const auto event = world.advance(second, probe).value())
      std::printf("%6.2f s: %s and %s %s at (%.1f, %.1f)\n", event->time, ship_of(event->first).name,
                  ship_of(event->second).name, event->kind == EventKind::contact_begin ? "touch" : "part",
                  event->point.x, event->point.y);
    least = std::min(least, world.certificates(probe).distance_limits(ids[0], ids[1], second)->lower);
  }
  std::printf("tanker and ferry pass each other at %.1f m; circles around them would overlap\n", least);
  std::printf("%llu probes\n", static_cast<unsigned long long>(world.counters().probes));
  return least > 70 && least < 80 ? 0 : 1;
}
