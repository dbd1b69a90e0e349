// FrameMotion: interpolation between the last two frames of a game.
#include "kinesphere/motion/frame_motion.hpp"

#include <utility>

#include "input/input_check.hpp"
#include "motion/body_bytes.hpp"
#include "motion/checks.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

namespace {

void check_vectors(InputCheck& check, std::string_view argument, std::span<const Vec3> vectors) {
  for (std::uint32_t body = 0; body < vectors.size(); ++body) {
    check.finite({argument, {body, 0}}, vectors[body]);
  }
}

}  // namespace

Result<FrameMotion> FrameMotion::create(FrameMotionDefinition definition) {
  InputCheck check("FrameMotion::create");
  check.finite({"start_time"}, definition.start_time)
      .positive({"interval"}, definition.interval)
      .not_negative({"position_error"}, definition.position_error)
      .acceleration_limits(definition.acceleration_limits, definition.start.size());
  check_vectors(check, "start", definition.start);
  const std::vector<Vec3>& velocities = definition.velocities;
  check.require(velocities.empty() || velocities.size() == definition.start.size(), ErrorCode::out_of_range,
                {"velocities"}, "must have no entry or one per body,", definition.start.size(),
                velocities.size());
  check_vectors(check, "velocities", velocities);
  if (check.error()) return *check.error();
  return FrameMotion(std::move(definition));
}

FrameMotion::FrameMotion(FrameMotionDefinition definition)
    : latest_(std::move(definition.start)),
      pushed_(latest_),
      limits_(std::move(definition.acceleration_limits)),
      refuse_violations_(definition.refuse_violations),
      interval_(definition.interval),
      position_error_(definition.position_error),
      start_time_(definition.start_time) {
  chords_.resize(latest_.size());
  for (std::size_t body = 0; body < latest_.size(); ++body) {
    const Vec3 velocity = definition.velocities.empty() ? Vec3{} : definition.velocities[body];
    chords_[body] = {start_time_, latest_[body], velocity};
  }
}

double FrameMotion::time_of(std::uint64_t frame) const {
  return start_time_ + static_cast<double>(frame) * interval_;
}

double FrameMotion::previous_time() const { return time_of(latest_frame_ == 0 ? 0 : latest_frame_ - 1); }

double FrameMotion::latest_time() const { return time_of(latest_frame_); }

/// Returns the violation if the next frame puts the body at `position`, or nothing if that is allowed.
/// Between frames the chord velocity changes by at most A dt, so the end moves by at most A dt^2. The four
/// position errors are one of p_(k+1), two of p_k and one of p_(k-1).
std::optional<FrameViolation> FrameMotion::violation(std::uint32_t body, const Vec3& position) const {
  const Vec3& before = latest_[body];
  const Vec3 way = chords_[body].velocity * interval_;
  const Vec3 deviation = position - before - way;
  const double allowed = limits_[body] * interval_ * interval_ + 4.0 * position_error_;
  if (norm_squared(deviation) <= allowed * allowed) return std::nullopt;
  // Margin for rounding in the game: a few units in the last place of the summands.
  const double rounding = 1e-9 * allowed + 0x1p-48 * (norm_one(position) + norm_one(before) + norm_one(way));
  const double length = norm(deviation);
  if (length <= allowed + rounding) return std::nullopt;
  return FrameViolation{.body = body,
                        .excess = length - allowed,
                        .acceleration = (length - 4.0 * position_error_) / (interval_ * interval_),
                        .velocity = (position - before) / interval_};
}

Result<void> FrameMotion::push(std::span<const Vec3> positions) {
  InputCheck check("push");
  check.require(positions.size() == size(), ErrorCode::out_of_range, {"positions"},
                "must have one entry per body,", size(), positions.size());
  if (check.error()) return *check.error();
  std::vector<FrameViolation> violations;
  for (std::uint32_t body = 0; body < size(); ++body) {
    if (!contains(body)) continue;
    if (check.finite({"positions", {body, 0}}, positions[body]).error()) return *check.error();
    if (const auto found = violation(body, positions[body])) violations.push_back(*found);
  }
  if (refuse_violations_ && !violations.empty()) {
    const FrameViolation& first = violations.front();
    check.require(false, ErrorCode::out_of_range, {"positions", {first.body, 0}, "acceleration"},
                  "must be at most its limit", limits_[first.body], first.acceleration);
    return *check.error();
  }
  violations_ = std::move(violations);
  violation_count_ += violations_.size();
  const double begin = latest_time();
  for (std::uint32_t body = 0; body < size(); ++body) {
    if (!contains(body)) continue;
    chords_[body] = {begin, latest_[body], (positions[body] - latest_[body]) / interval_};
    latest_[body] = positions[body];
    pushed_[body] = positions[body];
  }
  ++latest_frame_;
  return {};
}

bool FrameMotion::contains(std::uint32_t body) const {
  return body < size() && chords_[body].begin < infinity;
}

const FrameMotion::Chord& FrameMotion::known_chord(std::uint32_t body, double t, std::string_view call,
                                                   std::string_view argument) const {
  const double latest = latest_time();
  if (body >= size() || !(chords_[body].begin <= t && t <= latest)) [[unlikely]]
    refuse_question(call, *this, body, argument, t, {body < size() ? chords_[body].begin : t, latest});
  return chords_[body];
}

BodyDefinition FrameMotion::definition(std::uint32_t body, double t) const {
  const Chord& chord = known_chord(body, t, "FrameMotion::definition", "t");
  return {.acceleration_limit = limits_[body],
          .position_error = position_error_,
          .velocity_error = limits_[body] * interval_ + 2.0 * position_error_ / interval_,
          .position = chord.segment(t).state_at(t).position,
          .velocity = chord.velocity};
}

Segment FrameMotion::Chord::segment(double end) const {
  return {
      .begin = begin, .end = end, .position = position, .velocity = velocity, .acceleration = {}, .jerk = {}};
}

State FrameMotion::state(std::uint32_t body, double t) const {
  return known_chord(body, t, "FrameMotion::state", "t").segment(t).state_at(t);
}

Trajectory FrameMotion::trajectory(std::uint32_t body, double begin, double end) const {
  constexpr std::string_view call = "FrameMotion::trajectory";
  known_chord(body, begin, call, "begin");
  const Chord& chord = known_chord(body, end, call, "end");
  if (end < begin) refuse_order(call, body, begin, end);
  return {chord.segment(end)};
}

Result<void> FrameMotion::check_change(std::string_view call, std::uint32_t body, double t) const {
  if (const auto error = wrong_body(call, *this, body)) return *error;
  if (const auto error = wrong_time(call, {body, 0}, "t", t, {chords_[body].begin, latest_time()}))
    return *error;
  return {};
}

/// Restarts the body's chord at time t. A body that continues as pushed ends exactly at the pushed position,
/// not at a rounded one.
void FrameMotion::restart_chord(std::uint32_t body, double t, const State& state) {
  chords_[body] = {t, state.position, state.velocity};
  const bool as_pushed = latest_frame_ > 0 && t == previous_time() &&
                         state.velocity == (pushed_[body] - state.position) / interval_;
  latest_[body] = as_pushed ? pushed_[body] : state.position + state.velocity * (latest_time() - t);
}

Result<void> FrameMotion::set_velocity(std::uint32_t body, double t, const Vec3& velocity) {
  constexpr std::string_view call = "FrameMotion::set_velocity";
  if (auto valid = check_change(call, body, t); !valid) return valid;
  InputCheck check(call);
  if (check.finite({"velocity", {body, 0}}, velocity).error()) return check.result();
  restart_chord(body, t, {state(body, t).position, velocity});
  return {};
}

Result<void> FrameMotion::teleport(std::uint32_t body, double t, const State& state) {
  constexpr std::string_view call = "FrameMotion::teleport";
  if (auto valid = check_change(call, body, t); !valid) return valid;
  if (const auto error = wrong_state(call, {body, 0}, state)) return *error;
  restart_chord(body, t, state);
  return {};
}

MotionOrigin FrameMotion::origin(std::uint32_t body) const {
  if (const auto error = wrong_body("FrameMotion::origin", *this, body)) detail::bad_result(*error);
  const Chord& chord = chords_[body];
  return {chord.begin, {chord.position, chord.velocity}};
}

Result<void> FrameMotion::set_origin(std::uint32_t body, const MotionOrigin& origin) {
  constexpr std::string_view call = "FrameMotion::set_origin";
  if (const auto error = wrong_body(call, *this, body)) return *error;
  if (const auto error = wrong_origin(call, {body, 0}, origin)) return *error;
  if (const auto error = wrong_time(call, {body, 0}, "origin", origin.time, {previous_time(), latest_time()}))
    return *error;
  restart_chord(body, origin.time, origin.state);
  return {};
}

Result<void> FrameMotion::remove(std::uint32_t body) {
  if (const auto error = wrong_body("FrameMotion::remove", *this, body)) return *error;
  chords_[body].begin = infinity;
  free_.push_back(body);
  return {};
}

Result<std::uint32_t> FrameMotion::add(double t, const State& state, double acceleration_limit) {
  constexpr std::string_view call = "FrameMotion::add";
  if (const auto error = wrong_time(call, no_body, "t", t, {previous_time(), latest_time()})) return *error;
  if (const auto error = wrong_state(call, no_body, state)) return *error;
  InputCheck check(call);
  if (check.not_negative({"acceleration_limit"}, acceleration_limit).error()) return *check.error();
  auto body = static_cast<std::uint32_t>(size());
  if (free_.empty()) {
    chords_.emplace_back();
    latest_.emplace_back();
    pushed_.emplace_back();
    limits_.emplace_back();
  } else {
    body = free_.back();
    free_.pop_back();
  }
  limits_[body] = acceleration_limit;
  restart_chord(body, t, state);
  return body;
}

Result<void> FrameMotion::write_body(std::uint32_t body, std::vector<std::byte>& bytes) const {
  if (const auto error = wrong_body("write_body", *this, body)) return *error;
  append_body(bytes, frames_mark, latest_frame_, origin(body), latest_[body], pushed_[body], limits_[body]);
  return {};
}

Result<std::uint32_t> FrameMotion::read_body(std::span<const std::byte>& bytes) {
  std::uint64_t frame = 0;
  MotionOrigin last;
  Vec3 latest, pushed;
  double limit = 0.0;
  const auto rest = take_body(bytes, frames_mark, frame, last, latest, pushed, limit);
  if (!rest) return rest.error();
  InputCheck check("FrameMotion");
  check
      .require(frame == latest_frame_, ErrorCode::out_of_range, {"frame"}, "must be the latest one here,",
               latest_frame_, frame)
      .finite({"latest position"}, latest)
      .finite({"pushed position"}, pushed);
  if (check.error()) return bad_bytes(*check.error());
  auto body = add(last.time, last.state, limit);
  if (!body) return bad_bytes(body.error());
  latest_[*body] = latest;
  pushed_[*body] = pushed;
  bytes = *rest;
  return body;
}

std::unique_ptr<Motion> FrameMotion::clone() const { return std::make_unique<FrameMotion>(*this); }

}  // namespace kinesphere
