// A crowd with all operations on a world, including failing probes and refused calls.
#pragma once

#include <limits>
#include <stdexcept>
#include <vector>

#include "kinesphere/certificates.hpp"
#include "kinesphere/queries.hpp"
#include "world/crowd.hpp"

namespace kinesphere {

/// A filter by the user data of bodies, so that another world can get it again.
inline PairFilter filter_of(const World& world) {
  return [&world](BodyId a, BodyId b) {
    const auto data = [&](BodyId id) { return world.contains(id) ? world.user_data(id).value() : 0; };
    return (a.index + b.index) % 2 == 1 || (data(a) == 0 && data(b) == 0);
  };
}

class Bustle : public Crowd {
 public:
  explicit Bustle(const CrowdKind& kind) : Crowd(kind) {
    distort = [this, noise = distort](BodyId id, double time, State& state) {
      noise(id, time, state);
      if (mischief_ == 0 || --mischief_ > 0) return;
      if (throws_) throw std::runtime_error("no answer");
      state.velocity.x = std::numeric_limits<double>::infinity();
    };
  }

  void go(double duration) {
    const double start = world.time();
    for (int stop = 1; stop <= 20; ++stop) {
      const double until = start + duration * stop / 20;
      for (int k = 0; k < 3; ++k) do_anything();
      while (const auto event = advance_somehow(until)) {
        if (world.contains(event->first) && is_enabled(event->first)) bounce_if_both(*event);
        if (random.uniform() < 0.2) do_anything();
      }
    }
  }

  const std::vector<Event>& events() const { return events_; }

 private:
  bool is_enabled(BodyId id) const { return world.body(id).value().enabled; }

  void bounce_if_both(const Event& event) {
    if (event.second == no_body || (world.contains(event.second) && is_enabled(event.second))) bounce(event);
  }

  /// Advances; the probe fails now and then, in both ways, and the call is then repeated.
  std::optional<Event> advance_somehow(double until) {
    for (;;) {
      mischief_ = random.uniform() < 0.2 ? 1 + static_cast<int>(random.bits() % 5) : 0;
      throws_ = random.uniform() < 0.5;
      try {
        auto event = world.advance(until, probe());
        if (!event) continue;
        if (*event) events_.push_back(**event);
        mischief_ = 0;
        return *event;
      } catch (const std::runtime_error&) {
      }
    }
  }

  void do_anything() {
    const BodyId id = any();
    const State state{any_point(), 2.0 * random.point_in_ball()};
    switch (random.bits() % 14) {
      case 0:
        if (!is_enabled(id)) {
          world.enable(id, state).value();
          return set_state(id, state);
        }
        return world.disable(id).value();
      case 1:
        if (!is_enabled(id)) return;
        world.teleport(id, state).value();
        return set_state(id, state);
      case 2:
        return world.change(id, {.radius = 0.5 * random.uniform()}).value();
      case 3: {
        const BodyDefinition now = world.body(id).value().definition;
        const Vec3 plan = random.point_in_ball();
        world.change(id, {.motion_limits = MotionLimits{2.0, plan, now.position_error, now.velocity_error}})
            .value();
        return Playground::steer(id, plan + 1.9 * random.point_in_ball());
      }
      case 4:
        return world.change(id, {.filter = Filter{1 + random.bits() % 3, 1 + random.bits() % 3, 0}}).value();
      case 5:
        if (random.uniform() < 0.3)
          return world.set_pair_filter(random.uniform() < 0.5 ? filter_of(world) : PairFilter()).value();
        world.change(id, {.user_data = random.bits() % 2}).value();
        return world.refresh_filter(id).value();
      case 6:
        return ask();
      case 7: {
        const BodyDefinition pair[2] = {{.radius = 0.2, .position = any_point()},
                                        {.radius = 0.1, .position = any_point()}};
        for (const BodyId added : world.add_all(pair).value())
          start_course(added, world.body(added).value().definition);
        return;
      }
      case 8: {
        const BodyId ids[] = {id};
        if (world.size() > 5) world.remove(ids).value();
        return;
      }
      case 9:
        // Refused calls must leave no trace.
        EXPECT_FALSE(world.change(id, {.radius = -1.0}));
        EXPECT_FALSE(world.advance(world.time() - 1.0, probe()));
        return;
      case 10:
        if (world.size() > 5) world.remove(id).value();
        return;
      case 11:
        return join();
      default:
        if (is_enabled(id)) set_velocity(id, 2.0 * random.point_in_ball());
    }
  }

  void ask() {
    (void)world.certificates(probe()).safe_until(any());
    (void)world.certificates(probe()).safe_until();
    (void)world.certificates(probe()).earliest_contact(any());
    (void)world.certificates(probe()).distance_limits(any(), any(), world.time() + 1.0);
    (void)world.queries(probe()).nearest(any_point(), 3);
    mischief_ = random.uniform() < 0.5 ? 2 : 0;
    throws_ = false;
    (void)world.queries(probe()).overlapping(any_point(), 3.0);
    mischief_ = 0;
    (void)world.queries(probe()).ray_cast(any_point(), {1, 0, 0}, 5.0);
  }

  std::vector<Event> events_;
  int mischief_ = 0;  ///< the probe fails after this many states; 0: never
  bool throws_ = false;
};

}  // namespace kinesphere
