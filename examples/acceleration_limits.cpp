// What acceleration limits cost: fifteen balls that lie in a heap, and a gas whose limits are too wide.
// Prints the tables of docs/acceleration-limits.md; World::Inspection::busiest() names the reason in each.
#include <kinesphere/kinesphere.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

using namespace kinesphere;

struct Cost {
  std::uint64_t probes = 0;
  double seconds = 0.0;  // real time
  ProbeReason reason{};  // of the body that is probed most often
};

/// Fifteen balls of radius 1 lie in a heap for one second, with this limit, awake or asleep.
Cost heap(double limit, bool asleep) {
  World world = World::create({}).value();
  world.add_static({.shape = HalfSpace{{0, 0, 1}, 0}}).value();
  std::vector<State> places(1);
  for (int layer = 5; layer > 0; --layer)
    for (int k = 0; k < layer; ++k)
      places.push_back({{5.0 - layer + 2.0 * k, 0, 1 + (5 - layer) * std::sqrt(3.0)}, {}});
  for (std::size_t k = 1; k < places.size(); ++k)
    world.add({.acceleration_limit = limit, .position = places[k].position}).value();
  const auto probe = [&](std::span<const BodyId> ids, double, std::span<State> states) {
    for (std::size_t k = 0; k < ids.size(); ++k) states[k] = places[ids[k].index];
  };
  for (const Event& event : world.events(0.0, probe)) (void)event;
  if (asleep)
    for (const BodyId id : world.bodies())
      if (!world.body(id)->is_static) world.sleep(id).value();
  for (const Event& event : world.events(0.0, probe)) (void)event;

  world.set_profiling(true).value();
  const std::uint64_t before = world.counters().probes;
  const auto start = std::chrono::steady_clock::now();
  for (const Event& event : world.events(1.0, probe)) (void)event;
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  const std::vector<BusyBody> busiest = world.inspection().busiest(1).value();
  return {world.counters().probes - before, time.count(),
          busiest.empty() ? ProbeReason::travel : busiest.front().reason};
}

/// 512 balls fly about in a box for five seconds, with accelerations of up to 1, and bounce. Each declares
/// `width` times that.
Cost gas(double width) {
  constexpr int side = 8, count = side * side * side;
  constexpr double length = 32.0;
  std::vector<State> start;
  Random random(1);
  for (int k = 0; k < count; ++k)
    start.push_back(
        {Vec3{2.0 + 4.0 * (k % side), 2.0 + 4.0 * (k / side % side), 2.0 + 4.0 * (k / side / side)},
         4.0 * random.point_in_ball()});
  RandomForces motion =
      RandomForces::create({.start = start, .acceleration_limits = std::vector<double>(count, 1.0)}).value();
  World world = World::create({.box = Box{{0, 0, 0}, {length, length, length}}}).value();
  for (std::uint32_t number = 0; number < motion.size(); ++number) {
    BodyDefinition ball = motion.definition(number, 0.0);
    ball.radius = 0.5;
    ball.acceleration_limit *= width;
    world.add(ball).value();
  }
  world.set_profiling(true).value();
  SingleMotionSource source(motion);
  const auto respond = [](const Event& event) -> Response {
    if (event.kind != EventKind::contact_begin && event.kind != EventKind::wall_begin) return {};
    return response_of(event, bounce(event, 1.0));
  };
  const auto started = std::chrono::steady_clock::now();
  world.run(5.0, source, respond, [](const Event&) {}).value();
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - started;
  return {world.counters().probes, time.count(), world.inspection().busiest(1)->front().reason};
}

/// Returns the cost, with the least time of three runs.
template <class Run>
Cost best_of_three(Run run) {
  Cost best = run();
  for (int k = 0; k < 2; ++k) best.seconds = std::min(best.seconds, run().seconds);
  return best;
}

std::string reason(const Cost& cost) {
  return cost.probes == 0 ? "none was probed" : std::string(name_of(cost.reason));
}

void print_heap(const char* what, const Cost& cost) {
  std::printf("| %-18s | %7llu | %7.3f | %s |\n", what, static_cast<unsigned long long>(cost.probes),
              1e3 * cost.seconds, reason(cost).c_str());
}

int main() {
  std::puts("| heap               |  probes |      ms | busiest |");
  const Cost limited = best_of_three([] { return heap(10.0, false); });
  const Cost asleep = best_of_three([] { return heap(10.0, true); });
  print_heap("limit 10", limited);
  print_heap("limit 1", best_of_three([] { return heap(1.0, false); }));
  print_heap("limit 0", best_of_three([] { return heap(0.0, false); }));
  print_heap("limit 10, asleep", asleep);

  std::puts("\n| limit, times truth |  probes |    time | busiest |");
  Cost tight, loose;
  for (const int width : {1, 3, 10, 30, 100}) {
    const Cost cost = best_of_three([width] { return gas(width); });
    if (width == 1) tight = cost;
    if (width == 30) loose = cost;
    std::printf("| %-18d | %7llu | %7.2f | %s |\n", width, static_cast<unsigned long long>(cost.probes),
                cost.seconds / tight.seconds, reason(cost).c_str());
  }
  const bool as_described = asleep.probes == 0 && limited.reason == ProbeReason::touching &&
                            tight.reason != ProbeReason::loose_limit &&
                            loose.reason == ProbeReason::loose_limit;
  return as_described ? 0 : 1;
}
