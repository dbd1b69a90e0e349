#include "motion.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>

#include "exchange.hpp"
#include "input/input_check.hpp"
#include "kinesphere/motion/ballistic.hpp"
#include "kinesphere/motion/frame_motion.hpp"
#include "kinesphere/motion/random_forces.hpp"
#include "kinesphere/motion/recorded_tracks.hpp"
#include "kinesphere/motion/steered_motion.hpp"
#include "rigid_bodies.hpp"

namespace kinesphere::browser {
namespace {

/// Reads six numbers for each state.
std::vector<State> states_at(const double* numbers, std::size_t count) {
  std::vector<State> states;
  states.reserve(count);
  for (std::size_t k = 0; k < count; ++k) states.push_back(state_at(numbers + 6 * k));
  return states;
}

template <class Created>
MotionHandle* handle_of(Result<Created> created) {
  if (!is_good(created)) return nullptr;
  return new MotionHandle{std::make_unique<Created>(std::move(*created))};
}

Error unknown_body() {
  return {ErrorCode::unknown_body, "body", no_body, "Motion: body must be that of a body of the motion"};
}

bool has(const Motion& motion, double body) {
  return body >= 0.0 && body < static_cast<double>(motion.size()) &&
         body == static_cast<std::uint32_t>(body) && motion.contains(static_cast<std::uint32_t>(body));
}

bool knows(const MotionHandle& handle, double body) {
  return has(*handle.motion, body) || fail(unknown_body());
}

/// Returns the motion if it is of that kind; else null, and stores an error that names the missing ability.
template <class Kind>
Kind* as(const MotionHandle& handle, const char* refusal) {
  auto* const motion = dynamic_cast<Kind*>(handle.motion.get());
  if (motion == nullptr) fail({ErrorCode::unsupported, "motion", no_body, refusal});
  return motion;
}

struct Span {
  double begin;
  double end;
};

/// Returns the times at which the motion has states of the body.
Span known_span(const Motion& motion, std::uint32_t body) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (!can_be_changed(motion)) return {-infinity, infinity};
  const auto* const frames = dynamic_cast<const FrameMotion*>(&motion);
  return {motion.origin(body).time, frames != nullptr ? frames->latest_time() : infinity};
}

double clamped(double time, const Span& span) { return std::min(std::max(time, span.begin), span.end); }

}  // namespace

bool can_be_changed(const Motion& motion) { return dynamic_cast<const PiecewiseMotion*>(&motion) == nullptr; }

std::optional<Error> why_unknown(const Motion& motion, double body, double time) {
  if (!has(motion, body)) return unknown_body();
  const auto number = static_cast<std::uint32_t>(body);
  const Span span = known_span(motion, number);
  if (span.begin <= time && time <= span.end) return std::nullopt;
  return Error{ErrorCode::out_of_range,
               "motion",
               {number, 0},
               "Motion: body " + std::to_string(number) + " is known from time " + text_of(span.begin) +
                   " to " + text_of(span.end) + ", but is asked for at " + text_of(time)};
}

void put_nearest_state(const Motion* motion, double body, double time, double* state) {
  if (motion == nullptr || !has(*motion, body)) {
    std::fill_n(state, 6, std::numeric_limits<double>::quiet_NaN());
    return;
  }
  const auto number = static_cast<std::uint32_t>(body);
  put(motion->state(number, clamped(time, known_span(*motion, number))), state);
}

KINESPHERE_EXPORT(motion_ballistic)
MotionHandle* motion_ballistic(std::size_t count, const double* states, const double* gravity, double start) {
  return handle_of(Ballistic::create(
      {.start = states_at(states, count), .gravity = vector_at(gravity), .start_time = start}));
}

KINESPHERE_EXPORT(motion_random_forces)
MotionHandle* motion_random_forces(std::size_t count, const double* states, const double* limits,
                                   double interval, double seed, double start) {
  return handle_of(RandomForces::create({.start = states_at(states, count),
                                         .acceleration_limits = {limits, limits + count},
                                         .interval = interval,
                                         .seed = static_cast<std::uint64_t>(seed),
                                         .start_time = start}));
}

KINESPHERE_EXPORT(motion_steered)
MotionHandle* motion_steered(std::size_t count, const double* states, const double* limits, double start) {
  return handle_of(SteeredMotion::create({.start = states_at(states, count),
                                          .acceleration_limits = {limits, limits + count},
                                          .start_time = start}));
}

/// `rotations` is null for frames without rotations.
KINESPHERE_EXPORT(motion_frames)
MotionHandle* motion_frames(std::size_t count, const double* states, const double* limits, double interval,
                            double position_error, std::size_t rotation_count, const double* rotations,
                            double start) {
  FrameMotionDefinition definition{.start = {},
                                   .acceleration_limits = {limits, limits + count},
                                   .interval = interval,
                                   .position_error = position_error,
                                   .start_time = start};
  for (const State& state : states_at(states, count)) {
    definition.start.push_back(state.position);
    definition.velocities.push_back(state.velocity);
  }
  if (rotations != nullptr) definition.rotations = quaternions_at(rotations, rotation_count);
  return handle_of(FrameMotion::create(std::move(definition)));
}

/// Four numbers for each sample: time and position. `lengths` has the number of samples of each track.
KINESPHERE_EXPORT(motion_tracks)
MotionHandle* motion_tracks(std::size_t count, const double* lengths, const double* samples) {
  std::vector<Track> tracks(count);
  for (std::size_t body = 0; body < count; ++body) {
    for (auto left = static_cast<std::size_t>(lengths[body]); left > 0; --left, samples += 4)
      tracks[body].push_back({samples[0], vector_at(samples + 1)});
  }
  return handle_of(RecordedTracks::create(tracks));
}

KINESPHERE_EXPORT(motion_clone) MotionHandle* motion_clone(const MotionHandle* handle) {
  return new MotionHandle{handle->motion->clone()};
}
KINESPHERE_EXPORT(motion_free) void motion_free(MotionHandle* handle) { delete handle; }
KINESPHERE_EXPORT(motion_size) std::size_t motion_size(const MotionHandle* handle) {
  return handle->motion->size();
}
KINESPHERE_EXPORT(motion_contains) bool motion_contains(const MotionHandle* handle, std::uint32_t body) {
  return handle->motion->contains(body);
}

/// States of the named bodies, or of bodies 0, 1, ... if `bodies` is null. An absent body gets NaN. At a time
/// without a state the nearest one is used.
KINESPHERE_EXPORT(motion_states)
void motion_states(const MotionHandle* handle, double time, std::size_t count, const double* bodies,
                   double* states) {
  for (std::size_t k = 0; k < count; ++k)
    put_nearest_state(handle->motion.get(), bodies != nullptr ? bodies[k] : static_cast<double>(k), time,
                      states + 6 * k);
}

/// The numbers of a definition except the radius: limit, plan (3), position error, velocity error, state (6).
KINESPHERE_EXPORT(motion_definition)
bool motion_definition(const MotionHandle* handle, double body, double time, double* numbers) {
  if (!knows(*handle, body)) return false;
  const auto number = static_cast<std::uint32_t>(body);
  const BodyDefinition definition =
      handle->motion->definition(number, clamped(time, known_span(*handle->motion, number)));
  numbers[0] = definition.acceleration_limit;
  put(definition.planned_acceleration, numbers + 1);
  numbers[4] = definition.position_error;
  numbers[5] = definition.velocity_error;
  put({definition.position, definition.velocity}, numbers + 6);
  return true;
}

KINESPHERE_EXPORT(motion_set_velocity)
bool motion_set_velocity(MotionHandle* handle, double body, double time, const double* velocity) {
  return knows(*handle, body) &&
         is_good(handle->motion->set_velocity(static_cast<std::uint32_t>(body), time, vector_at(velocity)));
}

KINESPHERE_EXPORT(motion_teleport)
bool motion_teleport(MotionHandle* handle, double body, double time, const double* state) {
  return knows(*handle, body) &&
         is_good(handle->motion->teleport(static_cast<std::uint32_t>(body), time, state_at(state)));
}

KINESPHERE_EXPORT(motion_remove) bool motion_remove(MotionHandle* handle, double body) {
  return knows(*handle, body) && is_good(handle->motion->remove(static_cast<std::uint32_t>(body)));
}

KINESPHERE_EXPORT(motion_add)
double motion_add(MotionHandle* handle, double time, const double* state, double limit,
                  const double* orientation) {
  Result<std::uint32_t> added =
      Error{ErrorCode::unsupported, "motion", no_body, "Motion.add: this motion does not take bodies"};
  if (auto* const ballistic = dynamic_cast<Ballistic*>(handle->motion.get()))
    added = ballistic->add(time, state_at(state));
  if (auto* const forces = dynamic_cast<RandomForces*>(handle->motion.get()))
    added = forces->add(time, state_at(state), limit);
  if (auto* const steered = dynamic_cast<SteeredMotion*>(handle->motion.get()))
    added = steered->add(time, state_at(state), limit);
  if (auto* const frames = dynamic_cast<FrameMotion*>(handle->motion.get()))
    added = frames->add(time, state_at(state), limit, quaternions_at(orientation, 1).front());
  return is_good(added) ? *added : no_id;
}

KINESPHERE_EXPORT(motion_steer)
bool motion_steer(MotionHandle* handle, double body, double time, const double* acceleration) {
  auto* const steered = as<SteeredMotion>(*handle, "steer: this motion cannot be steered");
  return steered != nullptr && knows(*handle, body) &&
         is_good(steered->steer(static_cast<std::uint32_t>(body), time, vector_at(acceleration)));
}

/// Pushes to a world, or to none if `world` is null. `time` is null for a frame without a time of its own.
KINESPHERE_EXPORT(frames_push)
bool frames_push(MotionHandle* handle, World* world, std::size_t count, const double* positions,
                 const double* time, std::size_t rotation_count, const double* rotations) {
  auto* const frames = as<FrameMotion>(*handle, "push: this motion has no frames");
  if (frames == nullptr) return false;
  std::vector<Vec3> next;
  next.reserve(count);
  for (std::size_t k = 0; k < count; ++k) next.push_back(vector_at(positions + 3 * k));
  const auto turns = quaternions_at(rotations, rotation_count);
  const auto at = time != nullptr ? std::optional<double>(*time) : std::nullopt;
  return is_good(world != nullptr ? frames->push(*world, next, turns, at) : frames->push(next, turns, at));
}

/// Answers four numbers for each body: its orientation at the latest frame; nothing without rotations.
KINESPHERE_EXPORT(frames_latest_rotations) bool frames_latest_rotations(const MotionHandle* handle) {
  const auto* const frames = as<const FrameMotion>(*handle, "latestRotations: this motion has no frames");
  if (frames == nullptr) return false;
  answer().clear();
  for (const auto& [w, x, y, z] : frames->latest_rotations()) answer().insert(answer().end(), {w, x, y, z});
  return true;
}

/// Answers the times of the last frame but one and of the last, then three numbers for each body: its
/// position at the last.
KINESPHERE_EXPORT(frames_latest) bool frames_latest(const MotionHandle* handle) {
  const auto* const frames = as<const FrameMotion>(*handle, "latest: this motion has no frames");
  if (frames == nullptr) return false;
  answer() = {frames->previous_time(), frames->latest_time()};
  for (const Vec3& position : frames->latest())
    answer().insert(answer().end(), {position.x, position.y, position.z});
  return true;
}

/// Answers six numbers for each: body, excess, acceleration, velocity.
KINESPHERE_EXPORT(frames_violations) bool frames_violations(const MotionHandle* handle) {
  const auto* const frames = as<const FrameMotion>(*handle, "violations: this motion has no frames");
  if (frames == nullptr) return false;
  answer().clear();
  for (const FrameViolation& violation : frames->violations()) {
    const Vec3& velocity = violation.velocity;
    answer().insert(answer().end(), {static_cast<double>(violation.body), violation.excess,
                                     violation.acceleration, velocity.x, velocity.y, velocity.z});
  }
  return true;
}

/// Answers the times of the first and the last sample.
KINESPHERE_EXPORT(tracks_span) bool tracks_span(const MotionHandle* handle, double body) {
  const auto* const tracks = as<const RecordedTracks>(*handle, "span: this motion has no tracks");
  if (tracks == nullptr || !knows(*handle, body)) return false;
  const auto number = static_cast<std::uint32_t>(body);
  answer() = {tracks->first_time(number), tracks->last_time(number)};
  return true;
}

}  // namespace kinesphere::browser
