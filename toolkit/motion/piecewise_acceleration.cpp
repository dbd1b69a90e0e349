// PiecewiseAcceleration: evaluation along pieces of constant acceleration.
#include "kinesphere/motion/piecewise_acceleration.hpp"

#include <cassert>
#include <cmath>

#include "input/input_check.hpp"
#include "motion/checks.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

namespace {

/// Placeholder segment. It begins later than any valid time, so it never contains one.
const Segment no_piece{
    .begin = infinity, .end = infinity, .position = {}, .velocity = {}, .acceleration = {}, .jerk = {}};

/// Largest distance of a time from 0, in intervals; up to it, the ends of intervals are distinct doubles.
constexpr double farthest = 0x1p50;

}  // namespace

PiecewiseAcceleration::PiecewiseAcceleration(const std::vector<State>& start, double start_time,
                                             double interval)
    : interval_(interval) {
  paths_.reserve(start.size());
  for (const State& state : start) paths_.push_back({start_time, state, no_piece});
}

double PiecewiseAcceleration::latest_time() const { return farthest * interval_; }

bool PiecewiseAcceleration::contains(std::uint32_t body) const {
  return body < size() && paths_[body].since < infinity;
}

State PiecewiseAcceleration::state(std::uint32_t body, double t) const {
  return known_piece_at(body, t, "state", "t").state_at(t);
}

Trajectory PiecewiseAcceleration::trajectory(std::uint32_t body, double begin, double end) const {
  constexpr std::string_view call = "trajectory";
  Trajectory result{known_piece_at(body, begin, call, "begin")};
  if (!(std::isfinite(end) && end <= latest_time()))
    refuse_question(call, *this, body, "end", end, {begin, latest_time()});
  if (end < begin) refuse_order(call, body, begin, end);
  while (result.back().end < end) result.push_back(piece_after(body, result.back()));
  result.back().end = end;
  return result;
}

Result<void> PiecewiseAcceleration::check_change(std::string_view call, std::uint32_t body, double t) const {
  if (const auto error = wrong_body(call, *this, body)) return *error;
  if (const auto error = wrong_time(call, {body, 0}, "t", t, {last_change(body), latest_time()}))
    return *error;
  return {};
}

Result<void> PiecewiseAcceleration::set_velocity(std::uint32_t body, double t, const Vec3& velocity) {
  constexpr std::string_view call = "set_velocity";
  if (auto valid = check_change(call, body, t); !valid) return valid;
  InputCheck check(call);
  if (check.finite({"velocity", {body, 0}}, velocity).error()) return check.result();
  restart(body, t, {state(body, t).position, velocity});
  return {};
}

Result<void> PiecewiseAcceleration::teleport(std::uint32_t body, double t, const State& state) {
  constexpr std::string_view call = "teleport";
  if (auto valid = check_change(call, body, t); !valid) return valid;
  if (const auto error = wrong_state(call, {body, 0}, state)) return *error;
  restart(body, t, state);
  return {};
}

MotionOrigin PiecewiseAcceleration::origin(std::uint32_t body) const {
  if (const auto error = wrong_body("origin", *this, body)) detail::bad_result(*error);
  return {paths_[body].since, paths_[body].state};
}

Result<void> PiecewiseAcceleration::set_origin(std::uint32_t body, const MotionOrigin& origin) {
  constexpr std::string_view call = "set_origin";
  if (const auto error = wrong_body(call, *this, body)) return *error;
  if (const auto error = wrong_origin(call, {body, 0}, origin)) return *error;
  restart(body, origin.time, origin.state);
  return {};
}

Result<void> PiecewiseAcceleration::remove(std::uint32_t body) {
  if (const auto error = wrong_body("remove", *this, body)) return *error;
  paths_[body] = {infinity, {}, no_piece};
  free_.push_back(body);
  return {};
}

Result<std::uint32_t> PiecewiseAcceleration::add_body(std::string_view call, double t, const State& state) {
  InputCheck check(call);
  const double latest = latest_time();
  check.finite({"t"}, t).require(std::abs(t) <= latest, ErrorCode::out_of_range, {"t"},
                                 "must lie within 2^50 intervals of 0, that is within +-", latest, t);
  if (check.error()) return *check.error();
  if (const auto error = wrong_state(call, no_body, state)) return *error;
  auto body = static_cast<std::uint32_t>(size());
  if (free_.empty()) {
    paths_.emplace_back();
  } else {
    body = free_.back();
    free_.pop_back();
  }
  restart(body, t, state);
  return body;
}

void PiecewiseAcceleration::restart(std::uint32_t body, double t, const State& state) {
  paths_[body] = {t, state, no_piece};
}

BodyDefinition PiecewiseAcceleration::definition_with(std::uint32_t body, double t, double acceleration_limit,
                                                      const Vec3& planned_acceleration) const {
  const State now = known_piece_at(body, t, "definition", "t").state_at(t);
  return {.acceleration_limit = acceleration_limit,
          .planned_acceleration = planned_acceleration,
          .position = now.position,
          .velocity = now.velocity};
}

BodyDefinition PiecewiseAcceleration::definition_with(std::uint32_t body, double t,
                                                      const std::vector<double>& limits) const {
  BodyDefinition definition = definition_with(body, t, 0.0);
  definition.acceleration_limit = limits[body];
  return definition;
}

const Segment& PiecewiseAcceleration::known_piece_at(std::uint32_t body, double t, std::string_view call,
                                                     std::string_view argument) const {
  const double latest = latest_time();
  if (body >= size() || !(t >= paths_[body].since && t < infinity && t <= latest)) [[unlikely]]
    refuse_question(call, *this, body, argument, t, {body < size() ? paths_[body].since : t, latest});
  return piece_at(body, t);
}

const Segment& PiecewiseAcceleration::piece_at(std::uint32_t body, double t) const {
  Path& path = paths_[body];
  assert(std::isfinite(t) && t >= path.since);
  if (t < path.piece.begin) path.piece = piece_from(body, path.since, path.state);
  while (path.piece.end <= t) path.piece = piece_after(body, path.piece);
  return path.piece;
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

/// Returns the k with k * interval <= t < (k + 1) * interval, with rounded products. The rounded quotient is
/// wrong by at most one. An infinite interval gives 0, and no comparison below holds.
std::int64_t PiecewiseAcceleration::interval_number(double t) const {
  const auto k = static_cast<std::int64_t>(std::floor(t / interval_));
  if (static_cast<double>(k) * interval_ > t) return k - 1;
  if (static_cast<double>(k + 1) * interval_ <= t) return k + 1;
  return k;
}

}  // namespace kinesphere
