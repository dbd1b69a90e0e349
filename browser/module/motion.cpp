// Motions that JavaScript owns: in C they belong to a world.
#include <algorithm>
#include <limits>
#include <optional>
#include <string>

#include "input/input_check.hpp"
#include "kinesphere/motion/ballistic.hpp"
#include "kinesphere/motion/frame_motion.hpp"
#include "kinesphere/motion/random_forces.hpp"
#include "kinesphere/motion/recorded_tracks.hpp"
#include "kinesphere/motion/steered_motion.hpp"
#include "module.hpp"

namespace kinesphere::browser {
namespace {

template <class Created>
ks_status make(MotionHandle** made, Result<Created> created) {
  return c::guarded([&] { *made = new MotionHandle{std::make_shared<Created>(std::move(created).value())}; });
}

/// Returns the motion if it is of that kind; else throws an error that names the missing ability.
template <class Kind>
Kind& as(const MotionHandle* handle, const char* refusal) {
  auto* const motion = dynamic_cast<Kind*>(handle->motion.get());
  if (motion == nullptr) detail::bad_result({ErrorCode::unsupported, "motion", no_body, refusal});
  return *motion;
}

bool can_be_changed(const Motion& motion) { return dynamic_cast<const PiecewiseMotion*>(&motion) == nullptr; }

void require_body(const Motion& motion, std::uint32_t body) {
  if (body < motion.size() && motion.contains(body)) return;
  detail::bad_result(
      {ErrorCode::unknown_body, "body", no_body, "Motion: body must be that of a body of the motion"});
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

/// Calls change(motion) for a motion that has the body.
template <class Change>
ks_status change(MotionHandle* handle, std::uint32_t body, const Change& change) {
  return c::guarded([&] {
    require_body(*handle->motion, body);
    change(*handle->motion).value();
  });
}

}  // namespace

void require_known(const Motion& motion, std::uint32_t body, double time) {
  require_body(motion, body);
  const Span span = known_span(motion, body);
  if (span.begin <= time && time <= span.end) return;
  detail::bad_result({ErrorCode::out_of_range,
                      "motion",
                      {body, 0},
                      "Motion: body " + std::to_string(body) + " is known from time " + text_of(span.begin) +
                          " to " + text_of(span.end) + ", but is asked for at " + text_of(time)});
}

State nearest_state(const Motion& motion, std::uint32_t body, double time) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  if (body >= motion.size() || !motion.contains(body)) return {{nan, nan, nan}, {nan, nan, nan}};
  return motion.state(body, clamped(time, known_span(motion, body)));
}

void MovedBodies::states(std::span<const BodyId> ids, double time, std::span<State> states) {
  for (std::size_t k = 0; k < ids.size(); ++k) {
    const auto [motion, number] = find(ids[k]);
    try {
      require_known(*motion, number, time);
    } catch (const BadResult& bad) {
      Error error = bad.error();
      error.body = ids[k];
      throw BadResult(std::move(error));
    }
    states[k] = motion->state(number, time);
  }
}
MotionOrigin MovedBodies::origin(BodyId body) const {
  const auto [motion, number] = find(body);
  return motion->origin(number);
}
void MovedBodies::set_origin(BodyId body, const MotionOrigin& origin) {
  const auto [motion, number] = find(body);
  motion->set_origin(number, origin).value();
}
void MovedBodies::require_possible(const Event& event, const Response& response) const {
  if ((!response.first_velocity || can_be_changed(*find(event.first).motion)) &&
      (!response.second_velocity || event.second == no_body || can_be_changed(*find(event.second).motion)))
    return;
  detail::bad_result(
      {ErrorCode::unsupported, "respond", no_body,
       "run: respond: the bodies of this motion go their own way, and cannot be given velocities"});
}
void MovedBodies::forget_gone(World& world, const Event& event, const Response& response) {
  if (map_ != nullptr) (void)map_->remove_gone(world, event, [&](const Event&) { return response; });
}
MovedBody MovedBodies::find(BodyId body) const {
  if (map_ == nullptr) return {motion_, body.index};
  const auto found = map_->find(body);
  if (!found) {
    detail::bad_result({ErrorCode::unknown_body, "body", body,
                        "BodyMap: body " + std::to_string(body.index) +
                            " of the world was not added through this map, or has been removed from it"});
  }
  return *found;
}

KINESPHERE_EXPORT(motion_ballistic)
ks_status motion_ballistic(std::size_t count, const State* states, const Vec3* gravity, double start,
                           MotionHandle** made) {
  return make(
      made, Ballistic::create({.start = {states, states + count}, .gravity = *gravity, .start_time = start}));
}
KINESPHERE_EXPORT(motion_random_forces)
ks_status motion_random_forces(std::size_t count, const State* states, const double* limits, double interval,
                               double seed, double start, MotionHandle** made) {
  return make(made, RandomForces::create({.start = {states, states + count},
                                          .acceleration_limits = {limits, limits + count},
                                          .interval = interval,
                                          .seed = static_cast<std::uint64_t>(seed),
                                          .start_time = start}));
}
KINESPHERE_EXPORT(motion_steered)
ks_status motion_steered(std::size_t count, const State* states, const double* limits, double start,
                         MotionHandle** made) {
  return make(made, SteeredMotion::create({.start = {states, states + count},
                                           .acceleration_limits = {limits, limits + count},
                                           .start_time = start}));
}
/// `rotations` is null for frames without rotations.
KINESPHERE_EXPORT(motion_frames)
ks_status motion_frames(std::size_t count, const State* states, const double* limits, double interval,
                        double position_error, std::size_t rotation_count, const Quaternion* rotations,
                        double start, MotionHandle** made) {
  FrameMotionDefinition definition{.start = {},
                                   .acceleration_limits = {limits, limits + count},
                                   .interval = interval,
                                   .position_error = position_error,
                                   .start_time = start};
  for (const State& state : std::span(states, count)) {
    definition.start.push_back(state.position);
    definition.velocities.push_back(state.velocity);
  }
  if (rotations != nullptr) definition.rotations = {rotations, rotations + rotation_count};
  return make(made, FrameMotion::create(std::move(definition)));
}
/// Four numbers for each sample: time and position. `lengths` has the number of samples of each track.
KINESPHERE_EXPORT(motion_tracks)
ks_status motion_tracks(std::size_t count, const double* lengths, const TrackSample* samples,
                        MotionHandle** made) {
  std::vector<Track> tracks(count);
  for (std::size_t body = 0; body < count; ++body) {
    const auto length = static_cast<std::size_t>(lengths[body]);
    tracks[body].assign(samples, samples + length);
    samples += length;
  }
  return make(made, RecordedTracks::create(tracks));
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
void motion_states(const MotionHandle* handle, double time, std::size_t count, const std::uint32_t* bodies,
                   State* states) {
  for (std::size_t k = 0; k < count; ++k)
    states[k] =
        nearest_state(*handle->motion, bodies != nullptr ? bodies[k] : static_cast<std::uint32_t>(k), time);
}
/// State and limits of a body at a time or, without a state then, at the nearest one.
KINESPHERE_EXPORT(motion_definition)
ks_status motion_definition(const MotionHandle* handle, std::uint32_t body, double time,
                            ks_body_definition* definition) {
  return c::guarded([&] {
    const Motion& motion = *handle->motion;
    require_body(motion, body);
    *definition = c::c_body(motion.definition(body, clamped(time, known_span(motion, body))));
  });
}

KINESPHERE_EXPORT(motion_set_velocity)
ks_status motion_set_velocity(MotionHandle* handle, std::uint32_t body, double time, const Vec3* velocity) {
  return change(handle, body, [&](Motion& motion) { return motion.set_velocity(body, time, *velocity); });
}
KINESPHERE_EXPORT(motion_teleport)
ks_status motion_teleport(MotionHandle* handle, std::uint32_t body, double time, const State* state) {
  return change(handle, body, [&](Motion& motion) { return motion.teleport(body, time, *state); });
}
KINESPHERE_EXPORT(motion_remove) ks_status motion_remove(MotionHandle* handle, std::uint32_t body) {
  return change(handle, body, [&](Motion& motion) { return motion.remove(body); });
}
KINESPHERE_EXPORT(motion_steer)
ks_status motion_steer(MotionHandle* handle, std::uint32_t body, double time, const Vec3* acceleration) {
  return change(handle, body, [&](Motion&) {
    return as<SteeredMotion>(handle, "steer: this motion cannot be steered").steer(body, time, *acceleration);
  });
}
KINESPHERE_EXPORT(motion_add)
ks_status motion_add(MotionHandle* handle, double time, const State* state, double limit,
                     const Quaternion* orientation, std::uint32_t* number) {
  return c::guarded([&] {
    Motion* const motion = handle->motion.get();
    Result<std::uint32_t> added =
        Error{ErrorCode::unsupported, "motion", no_body, "Motion.add: this motion does not take bodies"};
    if (auto* const ballistic = dynamic_cast<Ballistic*>(motion)) added = ballistic->add(time, *state);
    if (auto* const forces = dynamic_cast<RandomForces*>(motion)) added = forces->add(time, *state, limit);
    if (auto* const steered = dynamic_cast<SteeredMotion*>(motion)) added = steered->add(time, *state, limit);
    if (auto* const frames = dynamic_cast<FrameMotion*>(motion))
      added = frames->add(time, *state, limit, *orientation);
    *number = added.value();
  });
}

/// Pushes to a world and tells it, or without one if it is 0. `time` is null for a frame without a time of
/// its own.
KINESPHERE_EXPORT(frames_push)
ks_status frames_push(MotionHandle* handle, ks_world world, std::size_t count, const Vec3* positions,
                      const double* time, std::size_t rotation_count, const Quaternion* rotations) {
  const auto push = [&](World* to) {
    auto& frames = as<FrameMotion>(handle, "push: this motion has no frames");
    const std::span next(positions, count);
    const std::span turns(rotations, rotation_count);
    const auto at = time != nullptr ? std::optional<double>(*time) : std::nullopt;
    (to != nullptr ? frames.push(*to, next, turns, at) : frames.push(next, turns, at)).value();
  };
  if (world.value == 0) return c::guarded([&] { push(nullptr); });
  return c::changing("push", world, [&](c::WorldObject& object) { push(&object.world()); });
}
/// Answers the times of the last frame but one and of the last, then three numbers for each body: its
/// position at the last.
KINESPHERE_EXPORT(frames_latest) ks_status frames_latest(const MotionHandle* handle) {
  return c::guarded([&] {
    const auto& frames = as<const FrameMotion>(handle, "latest: this motion has no frames");
    answer() = {frames.previous_time(), frames.latest_time()};
    for (const auto& [x, y, z] : frames.latest()) answer().insert(answer().end(), {x, y, z});
  });
}
/// Answers four numbers for each body: its orientation at the latest frame; nothing without rotations.
KINESPHERE_EXPORT(frames_latest_rotations) ks_status frames_latest_rotations(const MotionHandle* handle) {
  return c::guarded([&] {
    const auto& frames = as<const FrameMotion>(handle, "latestRotations: this motion has no frames");
    answer().clear();
    for (const auto& [w, x, y, z] : frames.latest_rotations()) answer().insert(answer().end(), {w, x, y, z});
  });
}
/// Answers six numbers for each: body, excess, acceleration, velocity.
KINESPHERE_EXPORT(frames_violations) ks_status frames_violations(const MotionHandle* handle) {
  return c::guarded([&] {
    const auto& frames = as<const FrameMotion>(handle, "violations: this motion has no frames");
    answer().clear();
    for (const auto& [body, excess, acceleration, velocity] : frames.violations())
      answer().insert(answer().end(),
                      {static_cast<double>(body), excess, acceleration, velocity.x, velocity.y, velocity.z});
  });
}
/// Answers the times of the first and the last sample.
KINESPHERE_EXPORT(tracks_span) ks_status tracks_span(const MotionHandle* handle, std::uint32_t body) {
  return c::guarded([&] {
    const auto& tracks = as<const RecordedTracks>(handle, "span: this motion has no tracks");
    require_body(tracks, body);
    answer() = {tracks.first_time(body), tracks.last_time(body)};
  });
}

}  // namespace kinesphere::browser
