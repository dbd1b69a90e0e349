// Bullets that vanish where they hit, rocks that burst, and things to pick up, in a game that the world runs
// by itself. The outcome is the same with any number of threads, to the last bit.
#include <kinesphere/kinesphere.hpp>

#include <cstdio>

using namespace kinesphere;

enum Kind : std::uint64_t { ship = 1, bullet, rock, fragment, pick_up };  // the user data of bodies

Response respond(const Event& event) {
  const auto is = [&](Kind kind) { return event.first_user_data == kind || event.second_user_data == kind; };
  Response response;
  const auto remove = [&](Kind kind) {
    (event.first_user_data == kind ? response.first_action : response.second_action) = BodyAction::remove;
  };
  if (event.kind == EventKind::sensor_enter) {
    remove(pick_up);
  } else if (event.kind != EventKind::contact_begin && event.kind != EventKind::wall_begin) {
    return {};
  } else if (is(bullet)) {
    remove(bullet);
    if (is(rock)) {
      remove(rock);
      response.stop = true;  // the sink adds fragments
    }
  } else {
    response = response_of(event, bounce(event, 1.0));
  }
  return response;
}

std::uint64_t play(int threads) {
  constexpr double size = 60.0;
  Random random(3);
  const auto anywhere = [&] { return Vec3{size, size, size} * 0.5 + 28.0 * random.point_in_ball(); };
  Ballistic motion = Ballistic::create({}).value();
  World world = World::create({.box = Box{{0, 0, 0}, {size, size, size}}}).value();
  BodyMap bodies;
  const auto add = [&](const State& state, double radius, Kind kind) {
    const BodyDefinition like{.radius = radius,
                              .filter = {.category = std::uint64_t{1} << kind,
                                         .mask = kind == pick_up  ? std::uint64_t{1} << ship
                                                 : kind == bullet ? 3u << rock
                                                                  : ~std::uint64_t{0}},
                              .solid = kind != pick_up,
                              .sensor_class = SensorClass(kind == pick_up ? 1 : 0),
                              .user_data = kind};
    const std::uint32_t number = motion.add(world.time(), state).value();
    bodies.add(world, motion, number, like).value();
  };
  world.set_sensor(1, {.distances = {0.0}}).value();
  for (int k = 0; k < 40; ++k) add({anywhere(), 20.0 * random.point_in_ball()}, 0.5, ship);
  for (int k = 0; k < 2000; ++k) add({anywhere(), 2.0 * random.point_in_ball()}, 0.5, rock);
  for (int k = 0; k < 300; ++k) add({anywhere(), {}}, 1.5, pick_up);

  EventHash hash;
  int picked = 0, burst = 0;
  const auto sink = [&](const Event& event) {
    hash.add(event);
    bodies.remove_gone(world, event, respond).value();
    if (event.kind == EventKind::sensor_enter) ++picked;
    if (!respond(event).stop) return;
    ++burst;
    for (const double side : {-0.5, 0.5}) add({event.point, {side, side, 2.0 * side}}, 0.2, fragment);
  };
  Workers workers = Workers::create(threads).value();
  auto source = bodies.source();
  for (int frame = 1; frame <= 120; ++frame) {
    for (int k = 0; k < 10; ++k) {
      const double angle = 0.05 * frame + 0.6 * k;
      const Vec3 muzzle{1.0, 3.0 + 6.0 * k, 30.0};
      add({muzzle, Vec3{80.0, 20.0 * angle - 70.0, 8.0 * k - 40.0}}, 0.05, bullet);
    }
    world.run(frame / 60.0, source, respond, sink, &workers).value();
  }
  std::printf("%d threads: %d picked up, %d rocks have burst, %zu bodies are left\n", threads, picked, burst,
              world.size());
  return hash.value();
}

int main() { return play(2) == play(3) ? 0 : 1; }
