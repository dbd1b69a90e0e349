// Balls that a Core moves: where they truly are, and what they do when they touch. A small client of the
// core, for tests.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/core.hpp"
#include "kinesphere/random.hpp"

namespace kinesphere::core_test {

struct TrueBall {
  double radius = 1.0;
  double mass = 1.0;
  Vec3 planned_acceleration{};
  double acceleration_limit = 0.0;
  double position_error = 0.0;
  double velocity_error = 0.0;
  State state{};      ///< at `time`
  double time = 0.0;  ///< of `state`
  bool present = true;
  bool stays_flat = false;  ///< moves in the plane z = 0
};

/// How balls move: with their planned acceleration, and another one within their limit that changes at the
/// multiples of `interval`.
class TrueMotion {
 public:
  static constexpr double interval = 0.125;

  TrueMotion(std::vector<TrueBall> all, std::uint64_t seed) : balls(std::move(all)), seed_(seed) {}

  State at(std::uint32_t number, double time) const {
    TrueBall ball = balls[number];
    move(ball, number, time);
    return ball.state;
  }
  void set_velocity(std::uint32_t number, double time, const Vec3& velocity) {
    move(balls[number], number, time);
    balls[number].state.velocity = velocity;
  }

  std::vector<TrueBall> balls;

 private:
  void move(TrueBall& ball, std::uint32_t number, double time) const {
    while (ball.time < time) {
      const double index = std::floor(ball.time / interval);
      const double end = std::min(time, (index + 1.0) * interval), step = end - ball.time;
      Random random = Random::at(seed_, number, static_cast<std::uint64_t>(index));
      Vec3 acceleration =
          ball.planned_acceleration + random.point_in_ball() * (ball.acceleration_limit * (1.0 - 0x1p-40));
      if (ball.stays_flat) acceleration.z = 0.0;
      ball.state.position += (ball.state.velocity + acceleration * (0.5 * step)) * step;
      ball.state.velocity += acceleration * step;
      ball.time = end;
    }
  }

  std::uint64_t seed_;
};

struct Bounce {
  double time;
  std::uint32_t first, second;  ///< in ascending order; core::none as the second for a wall
  Wall wall;
  double gap;  ///< true gap (length)

  bool is_of(const Bounce& other) const {
    return first == other.first && second == other.second && wall == other.wall;
  }
};

/// The part of `velocity` after an elastic impact of two masses that approach along `normal`.
inline void bounce_off(Vec3& first, Vec3& second, double mass, double other, const Vec3& normal) {
  const double approach = dot(first - second, normal), push = 2.0 * approach / (mass + other);
  first -= normal * (push * other);
  second += normal * (push * mass);
}

class BouncingBalls final : core::Reporter {
 public:
  BouncingBalls(const WorldDefinition& definition, TrueMotion motion)
      : truth(std::move(motion)), definition_(definition), core_(definition, *this) {
    for (std::uint32_t k = 0; k < truth.balls.size(); ++k) core_.add(bound(k));
  }

  core::Core& core() { return core_; }
  TrueMotion truth;
  std::vector<Bounce> bounces;

  /// Plays until then. Every approach within the tolerance is a bounce.
  void play(double until) {
    while (const auto near = core_.next(until)) answer(*near);
  }
  /// True gap of two balls at the present (length).
  double gap(std::uint32_t a, std::uint32_t b) const {
    return norm(way(a, b)) - truth.balls[a].radius - truth.balls[b].radius;
  }
  /// Least true gap of any two balls, and of any ball and wall, at the present.
  double least_gap() const {
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t a = 0; a < truth.balls.size(); ++a) {
      if (!truth.balls[a].present) continue;
      for (std::uint32_t b = 0; b < a; ++b)
        if (truth.balls[b].present) least = std::min(least, gap(a, b));
      if (!definition_.box) continue;
      for (int axis = 0; axis < definition_.dimensions; ++axis) {
        if (definition_.periodic[axis]) continue;
        const double at = truth.at(a, core_.time()).position[axis], radius = truth.balls[a].radius;
        least = std::min(
            {least, at - definition_.box->lower[axis] - radius, definition_.box->upper[axis] - at - radius});
      }
    }
    return least;
  }
  double energy() const {
    double sum = 0.0;
    for (std::uint32_t k = 0; k < truth.balls.size(); ++k)
      sum += 0.5 * truth.balls[k].mass * norm_squared(truth.at(k, core_.time()).velocity);
    return sum;
  }
  Bound bound(std::uint32_t number) const {
    const TrueBall& ball = truth.balls[number];
    return {.time = core_.time(),
            .position = ball.state.position,
            .velocity = ball.state.velocity,
            .planned_acceleration = ball.planned_acceleration,
            .radius = ball.radius + ball.position_error,
            .growth_speed = ball.velocity_error,
            .acceleration_limit = ball.acceleration_limit};
  }

 private:
  /// Reports lie anywhere within their errors.
  State report(std::uint32_t number, double time) override {
    State state = truth.at(number, time);
    const TrueBall& ball = truth.balls[number];
    Random random(static_cast<std::uint64_t>(time * 1e9) + number);
    const auto error = [&](double most) { return random.point_in_ball() * (most * (1.0 - 0x1p-30)); };
    if (ball.position_error > 0.0) state.position += error(ball.position_error);
    if (ball.velocity_error > 0.0) state.velocity += error(ball.velocity_error);
    if (ball.stays_flat) state.position.z = state.velocity.z = 0.0;
    return state;
  }

  /// From the true centre of one ball to that of the nearest image of the other.
  Vec3 way(std::uint32_t a, std::uint32_t b) const {
    Vec3 way = truth.at(b, core_.time()).position - truth.at(a, core_.time()).position;
    for (int axis = 0; axis < 3; ++axis) {
      if (!definition_.periodic[axis]) continue;
      const double period = definition_.box->upper[axis] - definition_.box->lower[axis];
      way[axis] -= period * std::round(way[axis] / period);
    }
    return way;
  }

  /// A ball that is pressed upon another within the tolerance waits for as long as it sinks by an eighth.
  double least_wait(double acceleration, double speed_error) const {
    const double sinking = 0.125 * definition_.contact_tolerance;
    const double root = std::sqrt(speed_error * speed_error + 2.0 * acceleration * sinking);
    return root + speed_error > 0.0 ? 2.0 * sinking / (root + speed_error) : 1e3;
  }

  void turn(std::uint32_t number, const Vec3& velocity) {
    truth.set_velocity(number, core_.time(), velocity);
    if (truth.balls[number].position_error > 0.0 || truth.balls[number].velocity_error > 0.0) {
      // The core knows no state to go on from: it gets another bound.
      Bound changed = bound(number);
      const State now = report(number, core_.time());
      changed.position = now.position;
      changed.velocity = now.velocity;
      core_.replace(number, changed);
    } else {
      core_.set_velocity(number, velocity);
    }
  }

  void answer(const core::Near& near) {
    const TrueBall& first = truth.balls[near.first];
    const double now = core_.time();
    Vec3 velocity = truth.at(near.first, now).velocity;
    if (near.wall != Wall::none) {
      const int wall = static_cast<int>(near.wall) - 1, axis = wall / 2;
      const double approach = wall % 2 == 1 ? velocity[axis] : -velocity[axis];
      const double acceleration = first.acceleration_limit + norm(first.planned_acceleration);
      if (!(approach > 0.0))
        return core_.put_off(near, now + least_wait(acceleration, first.velocity_error - approach));
      const double at = truth.at(near.first, now).position[axis];
      const double face =
          wall % 2 == 1 ? definition_.box->upper[axis] - at : at - definition_.box->lower[axis];
      bounces.push_back({now, near.first, core::none, near.wall, face - first.radius});
      velocity[axis] = -velocity[axis];
      return turn(near.first, velocity);
    }
    const TrueBall& second = truth.balls[near.second];
    Vec3 other = truth.at(near.second, now).velocity;
    const Vec3 offset = way(near.first, near.second), normal = offset / norm(offset);
    const double approach = dot(velocity - other, normal);
    if (!(approach > 0.0)) {
      const double acceleration = first.acceleration_limit + second.acceleration_limit +
                                  norm(first.planned_acceleration) + norm(second.planned_acceleration);
      const double error = first.velocity_error + second.velocity_error;
      return core_.put_off(near, now + least_wait(acceleration, error));
    }
    bounces.push_back({now, std::min(near.first, near.second), std::max(near.first, near.second), Wall::none,
                       gap(near.first, near.second)});
    bounce_off(velocity, other, first.mass, second.mass, normal);
    turn(near.first, velocity);
    turn(near.second, other);
  }

  WorldDefinition definition_;
  core::Core core_;
};

/// Balls at random places of a box, apart from each other.
struct Crowd {
  std::uint32_t count = 40;
  double least_radius = 0.3, largest_radius = 0.6;
  double speed = 1.0;
  double acceleration = 0.0;  ///< largest limit
  double plan = 0.0;          ///< largest planned acceleration
  double position_error = 0.0, velocity_error = 0.0;
};

inline std::vector<TrueBall> random_balls(const Crowd& crowd, const WorldDefinition& definition,
                                          std::uint64_t seed) {
  const Box box = definition.box.value_or(Box{{-8.0, -8.0, -8.0}, {8.0, 8.0, 8.0}});
  const bool flat = definition.dimensions == 2;
  Random random(seed);
  std::vector<TrueBall> balls;
  while (balls.size() < crowd.count) {
    TrueBall ball;
    ball.radius = crowd.least_radius * std::pow(crowd.largest_radius / crowd.least_radius, random.uniform());
    ball.mass = ball.radius * ball.radius * ball.radius;
    for (int axis = 0; axis < (flat ? 2 : 3); ++axis) {
      const double room = 1.01 * ball.radius + 4.0 * crowd.position_error;
      ball.state.position[axis] = random.uniform(box.lower[axis] + room, box.upper[axis] - room);
    }
    ball.state.velocity = random.point_in_ball() * crowd.speed;
    ball.acceleration_limit = crowd.acceleration * random.uniform();
    ball.planned_acceleration = random.point_in_ball() * crowd.plan;
    ball.position_error = crowd.position_error * random.uniform();
    ball.velocity_error = crowd.velocity_error * random.uniform();
    if (flat) ball.state.velocity.z = ball.planned_acceleration.z = 0.0;
    ball.stays_flat = flat;
    const auto is_near = [&](const TrueBall& other) {
      return norm(other.state.position - ball.state.position) <
             1.02 * (other.radius + ball.radius) + 8.0 * crowd.position_error;
    };
    if (std::none_of(balls.begin(), balls.end(), is_near)) balls.push_back(ball);
  }
  return balls;
}

}  // namespace kinesphere::core_test
