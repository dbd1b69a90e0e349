// A random crowd with random velocity changes, additions and removals, for tests of queries.
#pragma once

#include <vector>

#include "support/playground.hpp"

namespace kinesphere {

struct CrowdKind {
  ContactEvents mode;
  bool walls;
  double noise;  ///< largest position and velocity error
  std::size_t bodies;
  std::uint64_t seed;
};

inline std::ostream& operator<<(std::ostream& out, const CrowdKind& kind) {
  return out << (kind.mode == ContactEvents::impacts ? "impacts" : "begin_and_end")
             << (kind.walls ? ", walls" : "") << ", noise " << kind.noise << ", " << kind.bodies
             << " bodies, seed " << kind.seed;
}

class Crowd : public Playground {
 public:
  static constexpr double eps = 1e-5;
  static constexpr double size = 10.0;

  explicit Crowd(const CrowdKind& kind)
      : Playground({.box = kind.walls ? std::optional(Box{{0, 0, 0}, {size, size, size}}) : std::nullopt,
                    .contact_tolerance = eps,
                    .separation_distance = 4.0 * eps + 8.0 * kind.noise,
                    .contacts = kind.mode,
                    .start_time = -1.0}),
        random(kind.seed),
        errors_(kind.seed + 1000),
        noise_(kind.noise) {
    distort = [this](BodyId, double, State& state) {
      state.position += 0.999 * noise_ * errors_.point_in_ball();
      state.velocity += 0.999 * noise_ * errors_.point_in_ball();
    };
    for (std::size_t k = 0; k < kind.bodies; ++k) join();
  }

  void join() {
    const double limit = random.uniform() < 0.3 ? 0.0 : 3.0 * random.uniform();
    const Vec3 plan = random.uniform() < 0.3 ? Vec3{0, 0, -2} : Vec3{};
    const BodyDefinition body{.radius = random.uniform() < 0.1 ? 1.5 : 0.4 * random.uniform(),
                              .acceleration_limit = limit,
                              .planned_acceleration = plan,
                              .position_error = noise_,
                              .velocity_error = noise_,
                              .position = any_point(),
                              .velocity = 3.0 * random.point_in_ball()};
    add(body, plan + 0.999 * limit * random.point_in_ball());
  }

  /// Makes one random change that needs no advance.
  void change() {
    const double choice = random.uniform();
    if (choice < 0.2 && world.size() > 5)
      world.remove(any()).value();
    else if (choice < 0.4)
      join();
    else if (choice < 0.8)
      set_velocity(any(), 3.0 * random.point_in_ball());
    else
      steer(any());
  }

  void steer(BodyId id) {
    const BodyDefinition promise = world.body(id).value().definition;
    Playground::steer(
        id, promise.planned_acceleration + 0.999 * promise.acceleration_limit * random.point_in_ball());
  }

  /// In a mode that repeats begins, the bodies have to separate.
  void bounce(const Event& event) {
    const bool begins = event.kind == EventKind::contact_begin || event.kind == EventKind::wall_begin;
    if (world.definition().contacts != ContactEvents::impacts || !begins) return;
    const Vec3 change = event.normal * event.approach_speed;
    set_velocity(event.first, state(event.first).velocity - change);
    if (event.second != no_body) set_velocity(event.second, state(event.second).velocity + change);
  }

  BodyId any() {
    const std::vector<BodyId> ids = world.bodies();
    return ids[random.bits() % ids.size()];
  }

  Vec3 any_point() { return {size * random.uniform(), size * random.uniform(), size * random.uniform()}; }

  Random random;

 private:
  Random errors_;  ///< errors of reports; a generator of its own, so that the number of reports has no effect
  double noise_;
};

inline auto crowd_kinds() {
  using enum ContactEvents;
  return testing::Values(CrowdKind{begin_and_end, true, 0.0, 40, 1},
                         CrowdKind{begin_and_end, false, 0.0, 40, 12},
                         CrowdKind{begin_and_end, true, 1e-3, 40, 13}, CrowdKind{impacts, true, 0.0, 40, 4},
                         CrowdKind{impacts, false, 0.0, 40, 15}, CrowdKind{begin_and_end, true, 0.0, 6, 6});
}

}  // namespace kinesphere
