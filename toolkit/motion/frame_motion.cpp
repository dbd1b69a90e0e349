// FrameMotion: interpolation between the last two frames of a game.
#include "kinesphere/motion/frame_motion.hpp"

#include <algorithm>
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

/// Lengths of quaternions between 1 and this far from it are normalised (relative), as in a World.
constexpr double nearly_one = 1e-6;

double length_of(const Quaternion& rotation) {
  return std::sqrt(rotation.w * rotation.w + norm_squared(Vec3{rotation.x, rotation.y, rotation.z}));
}

Quaternion normalized(const Quaternion& rotation) { return after(rotation, Quaternion{}); }

void check_orientation(InputCheck& check, const Subject& subject, const Quaternion& orientation) {
  const double length = length_of(orientation);
  check.finite(subject, length)
      .require(std::abs(length - 1.0) <= nearly_one, ErrorCode::out_of_range, subject, "must have length 1",
               length);
}

/// Returns the vector about which, and by whose length (radians), the shorter way from one orientation to
/// another turns.
Vec3 turn_between(const Quaternion& from, const Quaternion& to) {
  Quaternion turn = after(to, {from.w, -from.x, -from.y, -from.z});
  if (turn.w < 0.0) turn = {-turn.w, -turn.x, -turn.y, -turn.z};
  const Vec3 axis{turn.x, turn.y, turn.z};
  const double sine = norm(axis);
  // Directions of axes shorter than this would be lost to underflow.
  if (sine < 1e-150) return 2.0 * axis;
  return axis * (angle_between(to, from) / sine);
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

/// A rigid body of a world, and what the world has to be informed of.
struct TurnedBody {
  BodyId id;
  BodyChange change;
};

/// Returns those of these bodies that the world can turn: enabled ones that are rigid.
Result<std::vector<TurnedBody>> rigid_ones(const World& world, std::span<const BodyId> bodies,
                                           std::span<const Vec3> angular_velocities) {
  std::vector<TurnedBody> rigid;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const BodyChange change{.angular_velocity = angular_velocities[k]};
    const auto valid = world.check_change(bodies[k], change);
    if (valid) {
      rigid.push_back({bodies[k], change});
    } else if (const ErrorCode code = valid.error().code;
               code != ErrorCode::disabled_body && code != ErrorCode::unsupported) {
      return valid.error();
    }
  }
  return rigid;
}

/// Returns the error of a push without a world for a body whose positions or rotations give it a new
/// velocity.
Error untold(std::string_view argument, std::uint32_t body, const std::string& velocity) {
  return {ErrorCode::out_of_range,
          std::string(argument),
          {body, 0},
          "push: " + std::string(argument) + " of body " + std::to_string(body) + " give it a new " +
              velocity + ", which its world has to know: call push(world, positions), or BodyMap::push"};
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
  if (definition.rotations) {
    std::vector<Quaternion>& rotations = *definition.rotations;
    check.require(rotations.size() == definition.start.size(), ErrorCode::out_of_range, {"rotations"},
                  "must have one entry per body,", definition.start.size(), rotations.size());
    for (std::uint32_t body = 0; body < rotations.size(); ++body)
      check_orientation(check, {"rotations", {body, 0}}, rotations[body]);
    for (Quaternion& rotation : rotations) rotation = normalized(rotation);
  }
  if (check.error()) return *check.error();
  return FrameMotion(std::move(definition));
}

FrameMotion::FrameMotion(FrameMotionDefinition definition)
    : latest_(std::move(definition.start)),
      pushed_(latest_),
      limits_(std::move(definition.acceleration_limits)),
      interval_(definition.interval),
      position_error_(definition.position_error),
      start_time_(definition.start_time),
      previous_time_(start_time_),
      latest_time_(start_time_),
      has_rotations_(definition.rotations.has_value()) {
  chords_.resize(latest_.size());
  jumps_.resize(latest_.size());
  if (has_rotations_) latest_rotations_ = std::move(*definition.rotations);
  for (const Quaternion& rotation : latest_rotations_) turns_.push_back({start_time_, rotation, {}});
  for (std::size_t body = 0; body < latest_.size(); ++body) {
    const Vec3 velocity = definition.velocities.empty() ? Vec3{} : definition.velocities[body];
    chords_[body] = {start_time_, latest_[body], velocity};
  }
}

double FrameMotion::time_of(std::uint64_t frame) const {
  return start_time_ + static_cast<double>(frame) * interval_;
}

/// Returns the sum of the body's jumps of velocity that counts at the begin of the next frame: after jumps
/// w_1, w_2, ... before frames of the lengths d_1, d_2, ... the largest w_i + ... + w_k - A (d_i + ... +
/// d_(k-1)) is w_k and what is left of the one before after A d_(k-1).
double FrameMotion::jumps_before(std::uint32_t body) const {
  if (latest_frame_ == 0) return 0.0;
  // Equal frames permit jumps of A dt and four position errors without informing the world.
  if (has_equal_frames_) return 4.0 * position_error_ / interval_;
  return std::max(0.0, jumps_[body] - limits_[body] * length());
}

/// Returns the violation if the next frame, of this length, puts the body at `position`, or nothing if that
/// is allowed. Between frames the chord velocity changes by at most A times the longer frame, and the end
/// moves by that times the length. The position errors are one of the new position, one of the latest, which
/// also begins the way, and two in the velocity of the chord before.
std::optional<FrameViolation> FrameMotion::violation(std::uint32_t body, const Vec3& position,
                                                     double length) const {
  const Vec3& before = latest_[body];
  const double last = latest_frame_ == 0 ? length : this->length();
  const double longer = std::max(last, length);
  const Vec3 way = chords_[body].velocity * length;
  const Vec3 deviation = position - before - way;
  const double errors = 2.0 * position_error_ * (1.0 + length / last);
  const double allowed = limits_[body] * longer * length + errors;
  if (norm_squared(deviation) <= allowed * allowed) return std::nullopt;
  // Margin for rounding in the game: a few units in the last place of the summands.
  const double rounding = 1e-9 * allowed + 0x1p-48 * (norm_one(position) + norm_one(before) + norm_one(way));
  const double distance = norm(deviation);
  if (distance <= allowed + rounding) return std::nullopt;
  return FrameViolation{.body = body,
                        .excess = distance - allowed,
                        .acceleration = (distance - errors) / (longer * length),
                        .velocity = (position - before) / length};
}

/// Notes the velocity that the next frame gives to a body.
void FrameMotion::move(NextFrame& next, std::uint32_t body, const Vec3& position) const {
  const Vec3 velocity = (position - latest_[body]) / next.length;
  const auto inform = [&] {
    next.bodies.push_back(body);
    next.velocities.push_back(velocity);
  };
  if (limits_[body] == infinity) {
    if (velocity != chords_[body].velocity) inform();
    return;
  }
  const auto found = violation(body, position, next.length);
  if (found) next.violations.push_back(*found);
  bool is_covered = !found;
  if (!next.has_equal_frames) {
    const Vec3& before = chords_[body].velocity;
    const double jumps = jumps_before(body) + norm(velocity - before);
    // The margin for rounding in the game of violation().
    const double sizes = (norm_one(position) + norm_one(latest_[body])) / next.length + norm_one(before);
    is_covered = is_covered && jumps <= (1.0 + 1e-9) * velocity_error(body) + 0x1p-48 * sizes;
    next.jumps[body] = is_covered ? jumps : 0.0;
  }
  if (!is_covered) inform();
}

/// Notes how a body turns in the next frame.
void FrameMotion::turn(NextFrame& next, std::uint32_t body, const Quaternion& orientation) const {
  const Vec3 spin = turn_between(latest_rotations_[body], normalized(orientation)) / next.length;
  if (spin == turns_[body].angular_velocity) return;
  next.turned.push_back(body);
  next.angular_velocities.push_back(spin);
}

Result<FrameMotion::NextFrame> FrameMotion::next_frame(std::string_view call, const Given& given) const {
  const std::span<const Vec3> positions = given.positions;
  const double after_interval = has_equal_frames_ ? time_of(latest_frame_ + 1) : latest_time_ + interval_;
  NextFrame next{.time = given.time.value_or(after_interval),
                 .length = interval_,
                 .has_equal_frames = has_equal_frames_};
  if (!has_equal_frames_ || next.time != after_interval) {
    next.length = next.time - latest_time_;
    next.has_equal_frames = false;
    next.jumps.resize(size());
  }
  InputCheck check(call);
  check.finite({"time"}, next.time)
      .require(next.time > latest_time_, ErrorCode::time_backwards, {given.time ? "time" : "interval"},
               "must bring the next frame after the latest one, at", latest_time_, next.time)
      .require(positions.size() == size(), ErrorCode::out_of_range, {"positions"},
               "must have one entry per body,", size(), positions.size())
      .require(has_rotations_ || given.rotations.empty(), ErrorCode::out_of_range, {"rotations"},
               "must be given for frame 0, too, or for no frame, but has entries", given.rotations.size())
      .require(!has_rotations_ || given.rotations.size() == size(), ErrorCode::out_of_range, {"rotations"},
               "must have one entry per body,", size(), given.rotations.size());
  if (check.error()) return *check.error();
  for (std::uint32_t body = 0; body < size(); ++body) {
    const Subject subject{"positions", {body, 0}};
    if (!contains(body)) {
      check.require(has_nan(positions[body]), ErrorCode::stale_body, subject,
                    "must be NaN, because the body has been removed", positions[body]);
      if (check.error()) return *check.error();
      continue;
    }
    if (check.finite(subject, positions[body]).error()) return *check.error();
    if (has_rotations_) {
      check_orientation(check, {"rotations", {body, 0}}, given.rotations[body]);
      if (check.error()) return *check.error();
      turn(next, body, given.rotations[body]);
    }
    move(next, body, positions[body]);
  }
  return next;
}

void FrameMotion::append(NextFrame next, const Given& given) {
  violations_ = std::move(next.violations);
  violation_count_ += violations_.size();
  const double begin = latest_time_;
  for (std::uint32_t body = 0; body < size(); ++body) {
    if (!contains(body)) continue;
    const Vec3& position = given.positions[body];
    chords_[body] = {begin, latest_[body], (position - latest_[body]) / next.length};
    latest_[body] = position;
    pushed_[body] = position;
    if (!has_rotations_) continue;
    const Quaternion orientation = normalized(given.rotations[body]);
    const Quaternion& last = latest_rotations_[body];
    turns_[body] = {begin, last, turn_between(last, orientation) / next.length};
    latest_rotations_[body] = orientation;
  }
  if (!next.has_equal_frames) jumps_ = std::move(next.jumps);
  has_equal_frames_ = next.has_equal_frames;
  previous_time_ = begin;
  latest_time_ = next.time;
  ++latest_frame_;
  free_.insert(free_.end(), removed_.begin(), removed_.end());
  removed_.clear();
}

Result<void> FrameMotion::push(std::string_view call, World& world, std::span<const BodyId> ids,
                               const Given& given) {
  auto next = next_frame(call, given);
  if (!next) return next.error();
  // A world that was moved from has no time to compare; a call for no body returns its error.
  if (auto idle = world.set_velocities({}, {}); !idle) return idle;
  InputCheck check(call);
  check.require(world.time() == latest_time(), ErrorCode::out_of_range, {"world"},
                "must have advanced to the latest frame,", latest_time(), world.time());
  const auto ids_of = [&](std::span<const std::uint32_t> bodies) {
    std::vector<BodyId> named;
    named.reserve(bodies.size());
    for (const std::uint32_t body : bodies) {
      check.require(ids[body] != no_body, ErrorCode::unknown_body, {"frames", {body, 0}},
                    "must have been added to the world through this map", "not known to it");
      named.push_back(ids[body]);
    }
    return named;
  };
  std::vector<BodyId> informed = ids_of(next->bodies);
  const std::vector<BodyId> turned = ids_of(next->turned);
  if (check.error()) return *check.error();
  const auto named = [call](Error error) {
    error.message = std::string(call) + ": " + error.message;
    return error;
  };
  const auto rigid = rigid_ones(world, turned, next->angular_velocities);
  if (!rigid) return named(rigid.error());
  if (const auto told = inform(world, std::move(informed), std::move(next->velocities)); !told)
    return named(told.error());
  // The checks above have accepted these, so that no error leaves the world changed.
  for (const TurnedBody& body : *rigid) world.change(body.id, body.change).value();
  append(std::move(*next), given);
  return {};
}

Result<void> FrameMotion::push(World& world, std::span<const Vec3> positions,
                               std::span<const Quaternion> rotations, std::optional<double> time) {
  std::vector<BodyId> ids;
  ids.reserve(size());
  for (std::uint32_t body = 0; body < size(); ++body) ids.push_back({body, 0});
  return push("push", world, ids, {positions, rotations, time});
}

Result<void> FrameMotion::push(World& world, std::span<const Vec3> positions, std::optional<double> time) {
  return push(world, positions, {}, time);
}

Result<void> FrameMotion::push(std::span<const Vec3> positions, std::span<const Quaternion> rotations,
                               std::optional<double> time) {
  const Given given{positions, rotations, time};
  auto next = next_frame("push", given);
  if (!next) return next.error();
  if (!next->violations.empty()) {
    const FrameViolation& first = next->violations.front();
    return untold("positions", first.body,
                  "velocity (acceleration " + text_of(first.acceleration) + ", with a limit of " +
                      text_of(limits_[first.body]) + ")");
  }
  if (!next->bodies.empty()) return untold("positions", next->bodies.front(), "velocity");
  if (!next->turned.empty()) return untold("rotations", next->turned.front(), "angular velocity");
  append(std::move(*next), given);
  return {};
}

Result<void> FrameMotion::push(std::span<const Vec3> positions, std::optional<double> time) {
  return push(positions, {}, time);
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
          .velocity_error = limited ? velocity_error(body) : 0.0,
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

std::optional<Rotation> FrameMotion::rotation(std::uint32_t body, double t) const {
  known_chord(body, t, "FrameMotion::rotation", "t");
  if (!has_rotations_) return std::nullopt;
  const auto& [begin, orientation, angular_velocity] = turns_[body];
  return Rotation{after(rotation_by(angular_velocity * (t - begin)), orientation), angular_velocity};
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
                         state.velocity == (pushed_[body] - state.position) / length();
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

Result<std::uint32_t> FrameMotion::add(double t, const State& state, double acceleration_limit,
                                       const Quaternion& orientation) {
  constexpr std::string_view call = "FrameMotion::add";
  if (const auto error = wrong_time(call, no_body, "t", t, {previous_time(), latest_time()})) return *error;
  if (const auto error = wrong_state(call, no_body, state)) return *error;
  InputCheck check(call);
  check.not_negative_or_infinite({"acceleration_limit"}, acceleration_limit);
  check_orientation(check, {"orientation"}, orientation);
  if (check.error()) return *check.error();
  auto body = static_cast<std::uint32_t>(size());
  if (free_.empty()) {
    chords_.emplace_back();
    latest_.emplace_back();
    pushed_.emplace_back();
    limits_.emplace_back();
    jumps_.emplace_back();
    if (has_rotations_) turns_.emplace_back();
    if (has_rotations_) latest_rotations_.emplace_back();
  } else {
    body = free_.back();
    free_.pop_back();
  }
  limits_[body] = acceleration_limit;
  jumps_[body] = 0.0;
  if (has_rotations_) {
    latest_rotations_[body] = normalized(orientation);
    turns_[body] = {t, latest_rotations_[body], {}};
  }
  restart_chord(body, t, state);
  return body;
}

Result<void> FrameMotion::write_body(std::uint32_t body, std::vector<std::byte>& bytes) const {
  if (const auto error = wrong_body("write_body", *this, body)) return *error;
  append_body(bytes, frames_mark, latest_frame_, previous_time_, latest_time_, has_equal_frames_,
              origin(body), latest_[body], pushed_[body], limits_[body], jumps_[body], has_rotations_);
  if (has_rotations_) {
    const auto& [begin, orientation, angular_velocity] = turns_[body];
    append_fields(bytes, begin, orientation, angular_velocity, latest_rotations_[body]);
  }
  return {};
}

Result<std::uint32_t> FrameMotion::read_body(std::span<const std::byte>& bytes) {
  std::uint64_t frame = 0;
  double previous_time = 0.0, latest_time = 0.0, limit = 0.0, jumps = 0.0;
  bool has_equal_frames = false, has_rotations = false;
  MotionOrigin last;
  Vec3 latest, pushed;
  auto rest = take_body(bytes, frames_mark, frame, previous_time, latest_time, has_equal_frames, last, latest,
                        pushed, limit, jumps, has_rotations);
  Turn turn{};
  Quaternion latest_rotation;
  if (rest && has_rotations)
    rest = take_fields(*rest, turn.begin, turn.orientation, turn.angular_velocity, latest_rotation);
  if (!rest) return rest.error();
  InputCheck check("FrameMotion");
  check
      .require(frame == latest_frame_, ErrorCode::out_of_range, {"frame"}, "must be the latest one here,",
               latest_frame_, frame)
      .require(previous_time == previous_time_, ErrorCode::out_of_range, {"previous_time"},
               "must be that of the frame here,", previous_time_, previous_time)
      .require(latest_time == latest_time_, ErrorCode::out_of_range, {"latest_time"},
               "must be that of the frame here,", latest_time_, latest_time)
      .require(has_equal_frames == has_equal_frames_, ErrorCode::out_of_range, {"has_equal_frames"},
               "must be that of the motion here", has_equal_frames ? "true" : "false")
      .require(has_rotations == has_rotations_, ErrorCode::out_of_range, {"rotations"},
               "must be known as in the motion here", has_rotations ? "known" : "not known")
      .finite({"latest position"}, latest)
      .finite({"pushed position"}, pushed)
      .not_negative({"jumps"}, jumps);
  if (has_rotations) {
    check.finite({"turn"}, turn.angular_velocity)
        .require(turn.begin >= previous_time_ && turn.begin <= latest_time_, ErrorCode::out_of_range,
                 {"turn"}, "must begin in the latest frame", turn.begin);
    check_orientation(check, {"orientation"}, turn.orientation);
    check_orientation(check, {"orientation"}, latest_rotation);
  }
  if (check.error()) return bad_bytes(*check.error());
  auto body = add(last.time, last.state, limit);
  if (!body) return bad_bytes(body.error());
  latest_[*body] = latest;
  pushed_[*body] = pushed;
  jumps_[*body] = jumps;
  if (has_rotations) {
    turns_[*body] = turn;
    latest_rotations_[*body] = latest_rotation;
  }
  bytes = *rest;
  return body;
}

std::unique_ptr<Motion> FrameMotion::clone() const { return std::make_unique<FrameMotion>(*this); }

}  // namespace kinesphere
