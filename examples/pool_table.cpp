// A pool table. Balls slow down by friction and stop; a stopped ball is put to sleep and costs nothing: it is
// not probed until something touches it.
#include <kinesphere/kinesphere.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

using namespace kinesphere;

constexpr double friction = 0.3;  // deceleration of a rolling ball

struct RollingBall {
  double since = 0;
  State start{};

  double stops() const { return since + norm(start.velocity) / friction; }
  State at(double time) const {
    const double speed = norm(start.velocity), s = std::min(time, stops()) - since;
    if (speed == 0) return start;
    const Vec3 along = start.velocity / speed;
    return {start.position + along * ((speed - 0.5 * friction * s) * s),
            along * std::max(0.0, speed - friction * s)};
  }
};

int main() {
  const double radius = 0.0286, spacing = radius + 1e-4;
  World table = World::create({.box = Box{{0, 0, 0}, {2.54, 1.27, 0}},
                               .dimensions = 2,
                               .contact_tolerance = 1e-7,
                               .contacts = ContactMode::impacts})
                    .value();
  std::vector<RollingBall> balls;
  const auto place = [&](double x, double y, const Vec3& velocity) {
    balls.push_back({0, {{x, y, 0}, velocity}});
    const double limit = 1.01 * friction;
    return table.add({radius, limit, {}, 0, 0, {x, y, 0}, velocity}).value();
  };
  for (int row = 0; row < 5; ++row)
    for (int k = 0; k <= row; ++k)
      table.sleep(place(1.9 + row * std::sqrt(3.0) * spacing, 0.635 + (2 * k - row) * spacing, {})).value();
  place(0.6, 0.62, {4, 0, 0});

  const auto probe = [&](std::span<const BodyId> ids, double time, std::span<State> states) {
    for (std::size_t k = 0; k < ids.size(); ++k) states[k] = balls[ids[k].index].at(time);
  };
  const auto set_velocity = [&](BodyId ball, double time, const Vec3& velocity) {
    balls[ball.index] = {time, {balls[ball.index].at(time).position, velocity}};
    table.set_velocity(ball, velocity).value();
  };

  int clicks = 0, cushions = 0;
  for (BodyId stopping{};;) {
    double until = 1e9;  // time at which the next ball stops
    for (const BodyId ball : table.bodies())
      if (!table.body(ball)->sleeping && balls[ball.index].stops() < until)
        until = balls[(stopping = ball).index].stops();
    if (until == 1e9) break;
    const auto event = table.advance(until, probe).value();
    if (!event) table.sleep(stopping).value();
    if (!event || (event->kind != EventKind::contact_begin && event->kind != EventKind::wall_begin)) continue;
    ++(event->second == no_body ? cushions : clicks);
    const Bounce after = bounce(*event, 0.95);
    set_velocity(event->first, event->time, after.first_velocity);
    if (event->second != no_body) set_velocity(event->second, event->time, after.second_velocity);
  }
  (void)table.advance(table.time(), probe).value();  // the last ball is probed once more
  const double quiet = table.time(), probes = static_cast<double>(table.counters().probes);
  for (const Event& event : table.events(quiet + 3600, probe)) std::puts(name_of(event.kind).data());
  const double later = static_cast<double>(table.counters().probes) - probes;
  std::printf("%d clicks and %d cushions, and all balls rest after %.2f s\n", clicks, cushions, quiet);
  std::printf("%.0f reports until then, %.0f in the hour after\n", probes, later);
  return later == 0 ? 0 : 1;
}
