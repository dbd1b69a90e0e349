// Interpolation between the last two frames of a game.
#include "kinesphere/motion/frames.hpp"

#include <cassert>
#include <utility>

#include "input/input_check.hpp"

namespace kinesphere {

namespace {

void check_vectors(InputCheck& check, std::string_view argument, std::span<const Vec3> vectors) {
  for (std::uint32_t body = 0; body < vectors.size(); ++body) {
    check.finite({argument, {body, 0}}, vectors[body]);
  }
}

}  // namespace

Result<Frames> Frames::create(FramesDefinition definition) {
  InputCheck check("Frames::create");
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
  return Frames(std::move(definition));
}

Frames::Frames(FramesDefinition definition)
    : latest_(std::move(definition.start)),
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

Result<void> Frames::push(std::span<const Vec3> positions) {
  InputCheck check("push");
  check.require(positions.size() == size(), ErrorCode::out_of_range, {"positions"},
                "must have one entry per body,", size(), positions.size());
  check_vectors(check, "positions", positions);
  if (check.error()) return *check.error();
  const double begin = latest_time();
  for (std::size_t body = 0; body < size(); ++body) {
    chords_[body] = {begin, latest_[body], (positions[body] - latest_[body]) / interval_};
    latest_[body] = positions[body];
  }
  ++latest_frame_;
  return {};
}

BodyDefinition Frames::definition(std::uint32_t body, double t) const {
  const State now = state(body, t);
  return {.acceleration_limit = limits_[body],
          .position_error = position_error_,
          .velocity_error = limits_[body] * interval_ + 2.0 * position_error_ / interval_,
          .position = now.position,
          .velocity = now.velocity};
}

State Frames::state(std::uint32_t body, double t) const { return piece(body, t, t).state_at(t); }

Trajectory Frames::trajectory(std::uint32_t body, double begin, double end) const {
  return {piece(body, begin, end)};
}

Segment Frames::piece(std::uint32_t body, [[maybe_unused]] double begin, double end) const {
  const Chord& chord = chords_[body];
  assert(chord.begin <= begin && begin <= end && end <= latest_time());
  return {.begin = chord.begin,
          .end = end,
          .position = chord.position,
          .velocity = chord.velocity,
          .acceleration = {},
          .jerk = {}};
}

bool Frames::set_velocity(std::uint32_t body, double t, const Vec3& velocity) {
  if (!(chords_[body].begin <= t && t <= latest_time()) || !is_finite(velocity)) return false;
  chords_[body] = {t, state(body, t).position, velocity};
  latest_[body] = chords_[body].position + velocity * (latest_time() - t);
  return true;
}

std::unique_ptr<Motion> Frames::clone() const { return std::make_unique<Frames>(*this); }

}  // namespace kinesphere
