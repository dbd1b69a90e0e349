// FrameMotion: interpolation between the last two frames of a game.
#include "kinesphere/motion/frame_motion.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "input/input_check.hpp"
#include "kinesphere/world.hpp"
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

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr Vec3 no_position{not_a_number, not_a_number, not_a_number};

bool has_nan(const Vec3& vector) {
  return std::isnan(vector.x) || std::isnan(vector.y) || std::isnan(vector.z);
}

/// Informs the world of the velocities of those of these bodies that are enabled there.
Result<void> inform(World& world, std::vector<BodyId> bodies, std::vector<Vec3> velocities) {
  auto informed = world.set_velocities(bodies, velocities);
  if (informed || informed.error().code != ErrorCode::disabled_body) return informed;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const auto view = world.body(bodies[k]);
    if (view && !view->enabled) continue;
    bodies[kept] = bodies[k];
    velocities[kept++] = velocities[k];
  }
  return world.set_velocities(std::span(bodies).first(kept), std::span(velocities).first(kept));
}

/// Returns the error of a push without a world for a body with a new velocity.
Error untold(std::uint32_t body, const std::string& reason) {
  return {ErrorCode::out_of_range,
          "positions",
          {body, 0},
          "push: positions of body " + std::to_string(body) + " give it a new velocity" + reason +
              ", which its world has to know: call push(world, positions), or BodyMap::push"};
}

}  // namespace

Result<FrameMotion> FrameMotion::create(FrameMotionDefinition definition) {
  InputCheck check("FrameMotion::create");
  check.finite({"start_time"}, definition.start_time)
      .positive({"interval"}, definition.interval)
      .not_negative({"position_error"}, definition.position_error);
  std::vector<double>& limits = definition.acceleration_limits;
  if (limits.empty()) limits.assign(definition.start.size(), infinity);
  check.require(limits.size() == definition.start.size(), ErrorCode::out_of_range, {"acceleration_limits"},
                "must have no entry or one per body,", definition.start.size(), limits.size());
  for (std::uint32_t body = 0; body < limits.size(); ++body)
    check.not_negative_or_infinite({"acceleration_limits", {body, 0}}, limits[body]);
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

Result<FrameMotion::NextFrame> FrameMotion::next_frame(std::string_view call,
                                                       std::span<const Vec3> positions) const {
  InputCheck check(call);
  check.require(positions.size() == size(), ErrorCode::out_of_range, {"positions"},
                "must have one entry per body,", size(), positions.size());
  if (check.error()) return *check.error();
  NextFrame next;
  for (std::uint32_t body = 0; body < size(); ++body) {
    const Subject subject{"positions", {body, 0}};
    if (!contains(body)) {
      check.require(has_nan(positions[body]), ErrorCode::stale_body, subject,
                    "must be NaN, because the body has been removed", positions[body]);
      if (check.error()) return *check.error();
      continue;
    }
    if (check.finite(subject, positions[body]).error()) return *check.error();
    const Vec3 velocity = (positions[body] - latest_[body]) / interval_;
    if (limits_[body] == infinity) {
      if (velocity == chords_[body].velocity) continue;
    } else {
      const auto found = violation(body, positions[body]);
      if (!found) continue;
      next.violations.push_back(*found);
    }
    next.bodies.push_back(body);
    next.velocities.push_back(velocity);
  }
  return next;
}

void FrameMotion::append(NextFrame next, std::span<const Vec3> positions) {
  violations_ = std::move(next.violations);
  violation_count_ += violations_.size();
  const double begin = latest_time();
  for (std::uint32_t body = 0; body < size(); ++body) {
    if (!contains(body)) continue;
    chords_[body] = {begin, latest_[body], (positions[body] - latest_[body]) / interval_};
    latest_[body] = positions[body];
    pushed_[body] = positions[body];
  }
  ++latest_frame_;
  free_.insert(free_.end(), removed_.begin(), removed_.end());
  removed_.clear();
}

Result<void> FrameMotion::push(std::string_view call, World& world, std::span<const BodyId> ids,
                               std::span<const Vec3> positions) {
  auto next = next_frame(call, positions);
  if (!next) return next.error();
  // A world that was moved from has no time to compare; a call for no body returns its error.
  if (auto idle = world.set_velocities({}, {}); !idle) return idle;
  InputCheck check(call);
  check.require(world.time() == latest_time(), ErrorCode::out_of_range, {"world"},
                "must have advanced to the latest frame,", latest_time(), world.time());
  std::vector<BodyId> informed;
  informed.reserve(next->bodies.size());
  for (const std::uint32_t body : next->bodies) {
    check.require(ids[body] != no_body, ErrorCode::unknown_body, {"frames", {body, 0}},
                  "must have been added to the world through this map", "not known to it");
    informed.push_back(ids[body]);
  }
  if (check.error()) return *check.error();
  if (const auto told = inform(world, std::move(informed), std::move(next->velocities)); !told) {
    Error error = told.error();
    error.message = std::string(call) + ": " + error.message;
    return error;
  }
  append(std::move(*next), positions);
  return {};
}

Result<void> FrameMotion::push(World& world, std::span<const Vec3> positions) {
  std::vector<BodyId> ids;
  ids.reserve(size());
  for (std::uint32_t body = 0; body < size(); ++body) ids.push_back({body, 0});
  return push("push", world, ids, positions);
}

Result<void> FrameMotion::push(std::span<const Vec3> positions) {
  auto next = next_frame("push", positions);
  if (!next) return next.error();
  if (!next->violations.empty()) {
    const FrameViolation& first = next->violations.front();
    return untold(first.body, " (acceleration " + text_of(first.acceleration) + ", with a limit of " +
                                  text_of(limits_[first.body]) + ")");
  }
  if (!next->bodies.empty()) return untold(next->bodies.front(), "");
  append(std::move(*next), positions);
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
  const bool limited = limits_[body] < infinity;
  return {.acceleration_limit = limited ? limits_[body] : 0.0,
          .position_error = position_error_,
          .velocity_error = limited ? limits_[body] * interval_ + 2.0 * position_error_ / interval_ : 0.0,
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
  latest_[body] = no_position;
  removed_.push_back(body);
  return {};
}

Result<std::uint32_t> FrameMotion::add(double t, const State& state, double acceleration_limit) {
  constexpr std::string_view call = "FrameMotion::add";
  if (const auto error = wrong_time(call, no_body, "t", t, {previous_time(), latest_time()})) return *error;
  if (const auto error = wrong_state(call, no_body, state)) return *error;
  InputCheck check(call);
  if (check.not_negative_or_infinite({"acceleration_limit"}, acceleration_limit).error())
    return *check.error();
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
