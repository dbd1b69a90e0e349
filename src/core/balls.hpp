// Balls holds the records of all balls, and says where their bounds are at the present time.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bound/quick_reject.hpp"
#include "core/ball.hpp"
#include "core/near_lanes.hpp"
#include "kinesphere/bound.hpp"

namespace kinesphere::core {

class Balls {
 public:
  Balls(const Periods& periods, double time) : periods_(periods), now_(time) {}

  double time() const { return now_; }
  void set_time(double time) { now_ = time; }
  /// Images have slid so far (Periods).
  void set_slide(double slide) { periods_.slide = slide; }
  const Periods& periods() const { return periods_; }

  std::uint32_t size() const { return static_cast<std::uint32_t>(balls_.size()); }
  Ball& operator[](std::uint32_t number) { return balls_[number]; }
  const Ball& operator[](std::uint32_t number) const { return balls_[number]; }
  const std::vector<Ball>& all() const { return balls_; }
  /// Makes room for the balls below this number.
  void grow(std::uint32_t numbers) {
    if (numbers <= size()) return;
    balls_.resize(numbers);
    if (!drifts_.empty()) drifts_.resize(numbers);
  }
  std::size_t bytes() const { return balls_.capacity() * sizeof(Ball) + drifts_.capacity() * sizeof(Drift); }

  /// True if some bound has ever grown.
  bool any_grows() const { return grows_; }
  /// Returns the drifts by number; nullptr if no bound has ever had one.
  const Drift* drifts() const { return drifts_.empty() ? nullptr : drifts_.data(); }
  void set_bound(std::uint32_t number, const Bound& bound) {
    balls_[number].position = bound.position;
    balls_[number].velocity = bound.velocity;
    balls_[number].time = bound.time;
    balls_[number].radius = bound.radius;
    balls_[number].acceleration_limit = bound.acceleration_limit;
    grows_ = grows_ || !bound.is_exact();
    const Drift drift{bound.planned_acceleration, bound.growth_speed};
    if (drifts_.empty() && drift != Drift()) drifts_.resize(balls_.size());
    if (!drifts_.empty()) drifts_[number] = drift;
  }
  /// The ball is in this state now.
  void set_state(std::uint32_t number, const State& state) {
    balls_[number].position = state.position;
    balls_[number].velocity = state.velocity;
    balls_[number].time = now_;
  }

  Bound bound(std::uint32_t number) const {
    const Ball& ball = balls_[number];
    return {.time = ball.time,
            .position = ball.position,
            .velocity = ball.velocity,
            .planned_acceleration = plan(number),
            .radius = ball.radius,
            .growth_speed = drifts_.empty() ? 0.0 : drifts_[number].growth_speed,
            .acceleration_limit = ball.acceleration_limit};
  }
  /// The bound from now on.
  [[gnu::always_inline]] BoundAt bound_now(std::uint32_t number) const {
    const Ball& ball = balls_[number];
    const double since = now_ - ball.time, limit = ball.acceleration_limit;
    Vec3 centre = ball.position + ball.velocity * since, velocity = ball.velocity, plan{};
    double growth = 0.5 * limit * since * since, speed = limit * since;
    if (!drifts_.empty()) {
      plan = drifts_[number].planned_acceleration;
      centre += plan * (0.5 * since * since);
      velocity += plan * since;
      growth += drifts_[number].growth_speed * since;
      speed += drifts_[number].growth_speed;
    }
    return {centre, velocity, plan, ball.radius + growth, speed, limit};
  }
  /// What concerns all pairs now, for near_lanes.hpp. It holds until a ball enters or the clock advances.
  PairQuery pair_query(double margin, double near) const {
    return {.now = now_,
            .margin = margin,
            .near = near,
            .grows = grows_,
            .drifts = drifts(),
            .periods = &periods_};
  }
  Drift drift(std::uint32_t number) const { return drifts_.empty() ? Drift() : drifts_[number]; }
  /// Adopts a ball of others, at the same time.
  void adopt(std::uint32_t number, const Ball& ball, const Drift& drift) {
    balls_[number] = ball;
    balls_[number].list = balls_[number].slot = none;
    if (drifts_.empty() && drift != Drift()) drifts_.resize(balls_.size());
    if (!drifts_.empty()) drifts_[number] = drift;
  }
  /// Expects balls with bounds that grow, and that drift.
  void expect(bool grows, bool drifts) {
    grows_ = grows_ || grows;
    if (drifts) drifts_.resize(balls_.size());
  }
  Vec3 plan(std::uint32_t number) const {
    return drifts_.empty() ? Vec3{} : drifts_[number].planned_acceleration;
  }
  /// Centre of the bound now.
  Vec3 position(std::uint32_t number) const {
    const Ball& ball = balls_[number];
    const double since = now_ - ball.time;
    const Vec3 straight = ball.position + ball.velocity * since;
    return drifts_.empty() ? straight : straight + plan(number) * (0.5 * since * since);
  }
  Vec3 velocity(std::uint32_t number) const {
    const Ball& ball = balls_[number];
    return drifts_.empty() ? ball.velocity : ball.velocity + plan(number) * (now_ - ball.time);
  }
  /// How far the bound has grown since the last report (length).
  double growth(std::uint32_t number) const {
    const Ball& ball = balls_[number];
    const double since = now_ - ball.time, growth = 0.5 * ball.acceleration_limit * since * since;
    return drifts_.empty() ? growth : growth + drifts_[number].growth_speed * since;
  }
  /// How fast the bound grows now (length / time).
  double growth_speed(std::uint32_t number) const {
    const Ball& ball = balls_[number];
    const double speed = ball.acceleration_limit * (now_ - ball.time);
    return drifts_.empty() ? speed : speed + drifts_[number].growth_speed;
  }
  /// True if the bound does not grow.
  bool is_exact(std::uint32_t number) const {
    return balls_[number].acceleration_limit == 0.0 &&
           (drifts_.empty() || drifts_[number].growth_speed == 0.0);
  }
  // The way to the nearest image. Where images slide: how many rows of them it is away, and the way there.
  double rows(const Vec3& way) const { return nearest_count(way.y, periods_.inverse.y); }
  Vec3 nearest_in_rows(Vec3 way) const {
    way.x -= periods_.slide * rows(way);
    return nearest(way);
  }
  [[gnu::always_inline]] Vec3 nearest(Vec3 way) const {
    if (periods_.any)
      for (int axis = 0; axis < 3; ++axis)
        way[axis] = nearest_image(way[axis], periods_.length[axis], periods_.inverse[axis]);
    return way;
  }
  /// Returns the vector from the centre of one bound to that of the nearest image of another.
  Vec3 between(std::uint32_t from, std::uint32_t to) const {
    const Vec3 way = position(to) - position(from);
    return periods_.slides ? nearest_in_rows(way) : nearest(way);
  }

  static void serialize(auto& self, auto& archive) { archive(self.balls_, self.drifts_, self.grows_); }
  /// Validates a record that was read from bytes.
  bool is_valid(std::uint32_t number) const {
    const Ball& ball = balls_[number];
    if (!ball.is_present()) return true;
    const auto is_ordinary = [](double value) { return std::abs(value) < 0x1p62; };
    return is_finite(ball.position) && is_finite(ball.velocity) && std::isfinite(ball.time) &&
           ball.time <= now_ && ball.radius >= 0.0 && std::isfinite(ball.radius) &&
           ball.acceleration_limit >= 0.0 && std::isfinite(ball.acceleration_limit) &&
           is_ordinary(ball.centre[0]) && is_ordinary(ball.centre[1]) && is_ordinary(ball.centre[2]) &&
           is_ordinary(ball.region) && ball.due >= now_ && ball.second >= ball.due && ball.own >= ball.second;
  }
  bool has_valid_drifts() const { return drifts_.empty() || drifts_.size() == balls_.size(); }

 private:
  std::vector<Ball> balls_;
  std::vector<Drift> drifts_;  ///< by number; empty as long as no bound has drifted
  Periods periods_;
  double now_;
  bool grows_ = false;
};

}  // namespace kinesphere::core
