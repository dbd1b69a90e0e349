// 2000 balls in a box, which the world runs by itself: a program that only responds to events with velocities
// needs no loop.
#include <kinesphere/kinesphere.hpp>

#include <algorithm>
#include <cstdio>
#include <thread>
#include <vector>

using namespace kinesphere;

int main() {
  constexpr std::uint32_t balls = 2000;
  Random random(1);
  RandomForcesDefinition forces;
  for (std::uint32_t k = 0; k < balls; ++k) {
    const Vec3 cell{1.0 + 2.0 * (k % 13), 1.0 + 2.0 * (k / 13 % 13), 1.0 + 2.0 * (k / 169 % 13)};
    forces.start.push_back({cell, 3.0 * random.point_in_ball()});
    forces.acceleration_limits.push_back(5.0);
  }
  RandomForces motion = RandomForces::create(forces).value();
  World world =
      World::create({.box = Box{{0, 0, 0}, {26, 26, 26}}, .contacts = ContactEvents::impacts}).value();
  for (std::uint32_t k = 0; k < balls; ++k) {
    BodyDefinition ball = motion.definition(k, 0.0);
    ball.radius = random.uniform(0.3, 0.8);
    ball.mass = ball.radius * ball.radius * ball.radius;
    world.add(ball).value();
  }

  SingleMotionSource mover(motion);
  // Depends on the event alone: equal events must get equal responses, at any time and in any thread.
  const auto respond = [](const Event& event) -> Response {
    if (event.kind != EventKind::contact_begin && event.kind != EventKind::wall_begin) return {};
    return response_of(event, bounce(event, 0.9));
  };
  double hardest = 0.0;
  const auto sink = [&](const Event& event) { hardest = std::max(hardest, event.approach_speed); };

  Workers workers = Workers::create(std::clamp(int(std::thread::hardware_concurrency()), 2, 8)).value();
  world.use_workers(&workers).value();  // until use_workers(nullptr)
  for (const double until : {1.0, 2.0, 3.0}) {
    if (const auto run = world.run(until, mover, respond, sink, &workers); !run) {
      std::printf("%s\n", run.error().message.c_str());
      return 1;
    }
    const Counters& counters = world.counters();
    std::printf("%g s  %llu impacts  %llu at walls  the hardest at %.2f\n", world.time(),
                static_cast<unsigned long long>(counters.count(EventKind::contact_begin)),
                static_cast<unsigned long long>(counters.count(EventKind::wall_begin)), hardest);
  }
}
