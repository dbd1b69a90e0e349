// Balls that a Core moves: where they truly are, and what they do when they touch. A small client of the
// core, for tests.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "contact/contact_event.hpp"
#include "contact/contact_predictor.hpp"
#include "core/core.hpp"
#include "kinesphere/certificates.hpp"
#include "kinesphere/random.hpp"
#include "kinesphere/workers.hpp"

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

class BouncingBalls final : core::Host {
 public:
  BouncingBalls(const WorldDefinition& definition, TrueMotion motion)
      : truth(std::move(motion)), definition_(definition), core_(definition) {
    for (std::uint32_t k = 0; k < truth.balls.size(); ++k) enter(k);
  }

  const core::Core& core() const { return core_; }
  TrueMotion truth;
  std::vector<Bounce> bounces;
  std::uint64_t probes = 0;
  Counters work;
  Workers* workers = nullptr;  ///< that share what many balls need; nullptr for none

  /// Plays until then. Every approach within the tolerance is a bounce.
  void play(double until) {
    for (;;) {
      settle();
      const double next = core_.next_due(until);
      if (!(next <= until)) break;
      core_.set_time(std::max(next, core_.time()));
      EXPECT_TRUE(core_.handle_next(*this));
    }
    core_.set_time(until);
  }
  const char* audit() {
    settle();
    return core_.audit([](std::uint32_t, std::uint32_t) { return core::Core::Claim::meet_as_balls; });
  }
  void enter(std::uint32_t number) {
    truth.balls[number].present = true;
    core_.enter(number, bound(number), false, true);
    core_.set_kind(number, false, false, true);
    note_change(number);
  }
  void leave(std::uint32_t number) {
    truth.balls[number].present = false;
    core_.leave(number);
    changed_.erase(number);
  }
  /// The true ball has been put elsewhere.
  void move(std::uint32_t number) {
    core_.set_bound(number, bound(number));
    note_change(number);
  }
  /// From now on the ball moves so. Its next report lies anywhere within its errors.
  void turn(std::uint32_t number, const Vec3& velocity) {
    truth.set_velocity(number, core_.time(), velocity);
    Bound changed = bound(number);
    const State now = report_of(number, core_.time());
    const Vec3 expected = core_.balls().position(number);
    changed.position = expected + core_.balls().nearest(now.position - expected);
    changed.velocity = now.velocity;
    core_.set_bound(number, changed);
    note_change(number);
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
  State report_of(std::uint32_t number, double time) const {
    State state = truth.at(number, time);
    const TrueBall& ball = truth.balls[number];
    Random random(static_cast<std::uint64_t>(time * 1e9) + number);
    const auto error = [&](double most) { return random.point_in_ball() * (most * (1.0 - 0x1p-30)); };
    if (ball.position_error > 0.0) state.position += error(ball.position_error);
    if (ball.velocity_error > 0.0) state.velocity += error(ball.velocity_error);
    if (ball.stays_flat) state.position.z = state.velocity.z = 0.0;
    return state;
  }
  void settle() {
    if (changed_.empty()) return;
    const std::vector<std::uint32_t> changed(changed_.begin(), changed_.end());
    changed_.clear();
    PoolLease lease(workers);
    core_.settle(changed, *this, lease);
  }
  void note_change(std::uint32_t number) {
    changed_.insert(number);
    for (auto pair = put_off_.begin(); pair != put_off_.end();) {
      const bool concerns = pair->first.first == number || pair->first.second == number;
      pair = concerns ? put_off_.erase(pair) : std::next(pair);
    }
  }

  // What the core asks. Walls count as a partner, core::none.
  bool answers_threads() const override { return true; }
  void linked_with(std::uint32_t, std::vector<std::uint32_t>&) override {}
  std::size_t keep_partners(std::uint32_t, std::span<std::uint32_t> others) override { return others.size(); }
  double unchanged_until(std::uint32_t a, std::uint32_t b) override {
    if (const auto known = put_off_.find(std::minmax(a, b)); known != put_off_.end())
      if (known->second > core_.time()) return known->second;
    const auto& balls = core_.balls();
    const bool parts =
        b != core::none && balls.is_exact(a) && balls.is_exact(b) && balls.plan(a) == balls.plan(b) &&
        recede_for_good(State{{}, balls.velocity(a)}, State{balls.between(a, b), balls.velocity(b)});
    return parts ? std::numeric_limits<double>::infinity() : core_.time();
  }
  Result<double> recheck(std::uint32_t a, std::uint32_t b) override { return put_off(a, b, answer(a, b)); }
  double walls_unchanged_until(std::uint32_t ball) override { return unchanged_until(ball, core::none); }
  Result<double> recheck_walls(std::uint32_t ball) override {
    if (!is_fresh(ball)) probe(ball);
    double until = std::numeric_limits<double>::infinity();
    for (const Wall wall : walls)
      if (stands(*walls_of(definition_), wall)) until = std::min(until, answer_wall(ball, wall));
    // A ball that has bounced off one of them may be back at any time.
    if (changed_.contains(ball)) return std::numeric_limits<double>::infinity();
    return put_off(ball, core::none, until);
  }
  Result<bool> report(std::span<const std::uint32_t> balls, Reason) override {
    for (const std::uint32_t ball : balls) probe(ball);
    return true;
  }
  void note_image(std::uint32_t, const Vec3&) override {}
  Counters& work_counters(std::uint32_t) override { return work; }

  double put_off(std::uint32_t a, std::uint32_t b, double until) {
    if (until < std::numeric_limits<double>::infinity()) put_off_[std::minmax(a, b)] = until;
    return until;
  }
  bool is_fresh(std::uint32_t number) const {
    return core_.balls()[number].time == core_.time() || core_.balls().is_exact(number);
  }
  void probe(std::uint32_t number) {
    ++probes;
    State state = report_of(number, core_.time());
    const Vec3 expected = core_.balls().position(number);
    state.position = expected + core_.balls().nearest(state.position - expected);
    core_.report(number, state);
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

  /// Lets the ball bounce off a wall that it touches and approaches. Returns when to look again.
  double answer_wall(std::uint32_t number, Wall wall) {
    const TrueBall& ball = truth.balls[number];
    const double now = core_.time();
    const int index = static_cast<int>(wall) - 1, axis = index / 2;
    const State state = truth.at(number, now);
    const double at = state.position[axis];
    const double face =
        index % 2 == 1 ? definition_.box->upper[axis] - at : at - definition_.box->lower[axis];
    const double approach = index % 2 == 1 ? state.velocity[axis] : -state.velocity[axis];
    const double gap = face - ball.radius,
                 acceleration = ball.acceleration_limit + norm(ball.planned_acceleration);
    const double error = ball.position_error + definition_.contact_tolerance;
    if (gap > error) {
      const double speed = std::max(approach, 0.0) + ball.velocity_error;
      const double room = gap - 0.9 * error;
      return now + 2.0 * room / (speed + std::sqrt(speed * speed + 2.0 * acceleration * room) + 1e-9);
    }
    if (!(approach > 0.0))
      return now + least_wait(acceleration, std::max(ball.velocity_error - approach, 0.0));
    bounces.push_back({now, number, core::none, wall, gap});
    Vec3 velocity = state.velocity;
    velocity[axis] = -velocity[axis];
    turn(number, velocity);
    return std::numeric_limits<double>::infinity();
  }

  /// Lets two balls that touch and approach bounce. Returns when to look again.
  double answer(std::uint32_t a, std::uint32_t b) {
    const TrueBall& first = truth.balls[a];
    const TrueBall& second = truth.balls[b];
    const double now = core_.time();
    Vec3 velocity = truth.at(a, now).velocity, other = truth.at(b, now).velocity;
    const Vec3 offset = way(a, b), normal = offset / norm(offset);
    const double approach = dot(velocity - other, normal);
    if (!(approach > 0.0)) {
      const double acceleration = first.acceleration_limit + second.acceleration_limit +
                                  norm(first.planned_acceleration) + norm(second.planned_acceleration);
      return now + least_wait(acceleration, first.velocity_error + second.velocity_error);
    }
    bounces.push_back({now, std::min(a, b), std::max(a, b), Wall::none, gap(a, b)});
    bounce_off(velocity, other, first.mass, second.mass, normal);
    turn(a, velocity);
    turn(b, other);
    return std::numeric_limits<double>::infinity();
  }

  WorldDefinition definition_;
  core::Core core_;
  std::set<std::uint32_t> changed_;
  /// Pairs that are in touch, and until when nothing happens between the two.
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> put_off_;
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
