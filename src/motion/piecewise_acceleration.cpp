// Walking along pieces of constant acceleration.
#include "kinesphere/motion/piecewise_acceleration.hpp"

#include <cassert>
#include <cmath>

#include "number/infinity.hpp"

namespace kinesphere {

namespace {

/// Begins later than any time that may be asked for, so it is never the right piece.
const Segment no_piece{
    .begin = infinity, .end = infinity, .position = {}, .velocity = {}, .acceleration = {}, .jerk = {}};

}  // namespace

PiecewiseAcceleration::PiecewiseAcceleration(const std::vector<State>& start, double start_time,
                                             double interval)
    : interval_(interval) {
  courses_.reserve(start.size());
  for (const State& state : start) courses_.push_back({start_time, state, no_piece});
}

State PiecewiseAcceleration::state(std::uint32_t body, double t) const {
  return piece_at(body, t).state_at(t);
}

Trajectory PiecewiseAcceleration::trajectory(std::uint32_t body, double begin, double end) const {
  assert(begin <= end);
  Trajectory result{piece_at(body, begin)};
  while (result.back().end < end) result.push_back(piece_after(body, result.back()));
  result.back().end = end;
  return result;
}

bool PiecewiseAcceleration::set_velocity(std::uint32_t body, double t, const Vec3& velocity) {
  if (!std::isfinite(t) || t < last_change(body) || !is_finite(velocity)) return false;
  restart(body, t, {state(body, t).position, velocity});
  return true;
}

void PiecewiseAcceleration::restart(std::uint32_t body, double t, const State& state) {
  courses_[body] = {t, state, no_piece};
}

BodyDefinition PiecewiseAcceleration::definition_with(std::uint32_t body, double t, double acceleration_limit,
                                                      const Vec3& planned_acceleration) const {
  const State now = state(body, t);
  return {.acceleration_limit = acceleration_limit,
          .planned_acceleration = planned_acceleration,
          .position = now.position,
          .velocity = now.velocity};
}

const Segment& PiecewiseAcceleration::piece_at(std::uint32_t body, double t) const {
  Course& course = courses_[body];
  assert(std::isfinite(t) && t >= course.since);
  if (t < course.piece.begin) course.piece = piece_from(body, course.since, course.state);
  while (course.piece.end <= t) course.piece = piece_after(body, course.piece);
  return course.piece;
}

Segment PiecewiseAcceleration::piece_from(std::uint32_t body, double t, const State& state) const {
  const std::int64_t k = interval_number(t);
  return {.begin = t,
          .end = static_cast<double>(k + 1) * interval_,
          .position = state.position,
          .velocity = state.velocity,
          .acceleration = acceleration(body, k, state),
          .jerk = {}};
}

Segment PiecewiseAcceleration::piece_after(std::uint32_t body, const Segment& piece) const {
  return piece_from(body, piece.end, piece.state_at(piece.end));
}

/// The k with k * interval <= t < (k + 1) * interval, the products as rounded. The rounded quotient is wrong
/// by at most one; for an infinite interval it is 0, and no comparison below holds.
std::int64_t PiecewiseAcceleration::interval_number(double t) const {
  const auto k = static_cast<std::int64_t>(std::floor(t / interval_));
  if (static_cast<double>(k) * interval_ > t) return k - 1;
  if (static_cast<double>(k + 1) * interval_ <= t) return k + 1;
  return k;
}

}  // namespace kinesphere
