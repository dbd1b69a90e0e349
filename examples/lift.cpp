// A lift: a platform whose motion the world does not know, only that it accelerates by at most 1. Balls lie
// on it and ride up and down; one is shot through the shaft so fast that a loop of 60 Hz would take it
// through the floor.
#include <kinesphere/kinesphere.hpp>

#include <cmath>
#include <cstdio>
#include <limits>
#include <map>

using namespace kinesphere;

int main() {
  const Vec3 gravity{0, 0, -9.81};
  World world = World::create({.contacts = ContactEvents::impacts}).value();

  // The game's own state: the lift's course, and where each ball was last thrown from.
  const auto lift_at = [](double t) {
    return State{{0, 0, 2 - 2 * std::cos(0.7 * t)}, {0, 0, 1.4 * std::sin(0.7 * t)}};
  };
  struct Throw {
    double time;
    State state;
  };
  std::map<BodyId, Throw> balls;
  const auto ball_at = [&](BodyId id, double t) {
    const auto& [since, state] = balls.at(id);
    const double s = t - since;
    return State{state.position + (state.velocity + gravity * (0.5 * s)) * s, state.velocity + gravity * s};
  };

  const MovingShape platform{{.acceleration_limit = 1.0, .mass = std::numeric_limits<double>::infinity()},
                             Box{{-3, -3, -0.1}, {3, 3, 0}}};
  const BodyId lift = world.add_moving_shape(platform).value();
  const auto add_ball = [&](const State& state) {
    const BodyId id = world
                          .add({.radius = 0.25,
                                .planned_acceleration = gravity,
                                .position = state.position,
                                .velocity = state.velocity})
                          .value();
    balls[id] = {0.0, state};
  };
  for (const double x : {-2.0, -1.0, 0.0, 1.0}) add_ball({{x, 0, 0.5}, {}});
  add_ball({{2, 0, 60}, {0, 0, -600}});

  const Probe probe = [&](std::span<const BodyId> ids, double t, std::span<State> states) {
    for (std::size_t k = 0; k < ids.size(); ++k) states[k] = ids[k] == lift ? lift_at(t) : ball_at(ids[k], t);
  };
  double hardest = 0;
  int contacts = 0;
  for (const Event& event : world.events(30.0, probe)) {
    if (event.kind != EventKind::contact_begin) continue;
    ++contacts;
    hardest = std::max(hardest, event.approach_speed);
    const Bounce after = settle(event, 0.3, 0.05);
    const auto turn = [&](BodyId id, const State& state, const Vec3& velocity) {
      if (id == lift) return;
      balls[id] = {event.time, {state.position, velocity}};
      world.set_velocity(id, velocity).value();
    };
    turn(event.first, event.first_state, after.first_velocity);
    turn(event.second, event.second_state, after.second_velocity);
  }

  double lowest = std::numeric_limits<double>::infinity();
  for (const auto& [id, thrown] : balls)
    lowest = std::min(lowest, ball_at(id, world.time()).position.z - 0.25 - lift_at(world.time()).position.z);
  std::printf("%d contacts, the hardest at %.0f; after 30 s no ball is below the floor: %s\n", contacts,
              hardest, lowest > -1e-5 ? "true" : "false");
  return lowest > -1e-5 && hardest > 500 ? 0 : 1;
}
