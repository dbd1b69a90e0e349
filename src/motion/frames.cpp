// Interpolation between the last two frames of a game.
#include "kinesphere/motion/frames.hpp"

#include <cassert>
#include <utility>

#include "input/input_check.hpp"

namespace kinesphere {

namespace {

void check_positions(InputCheck& check, std::string_view argument, std::span<const Vec3> positions) {
  for (std::uint32_t body = 0; body < positions.size(); ++body) {
    check.finite({argument, {body, 0}}, positions[body]);
  }
}

}  // namespace

Result<Frames> Frames::create(FramesDefinition definition) {
  InputCheck check("Frames::create");
  check.finite({"start_time"}, definition.start_time)
      .positive({"interval"}, definition.interval)
      .not_negative({"position_error"}, definition.position_error)
      .acceleration_limits(definition.acceleration_limits, definition.start.size());
  check_positions(check, "start", definition.start);
  if (check.error()) return *check.error();
  return Frames(std::move(definition));
}

Frames::Frames(FramesDefinition definition)
    : previous_(definition.start),
      latest_(std::move(definition.start)),
      limits_(std::move(definition.acceleration_limits)),
      interval_(definition.interval),
      position_error_(definition.position_error),
      start_time_(definition.start_time) {}

Result<void> Frames::push(std::span<const Vec3> positions) {
  InputCheck check("push");
  check.require(positions.size() == size(), ErrorCode::out_of_range, {"positions"},
                "must have one entry per body,", size(), positions.size());
  check_positions(check, "positions", positions);
  if (check.error()) return *check.error();
  previous_.swap(latest_);
  latest_.assign(positions.begin(), positions.end());
  ++latest_frame_;
  return {};
}

BodyDefinition Frames::promise(std::uint32_t body, double t) const {
  const State now = state(body, t);
  return {.acceleration_limit = limits_[body],
          .position_error = position_error_,
          .velocity_error = limits_[body] * interval_ + 2.0 * position_error_ / interval_,
          .position = now.position,
          .velocity = now.velocity};
}

State Frames::state(std::uint32_t body, double t) const {
  assert(previous_time() <= t && t <= latest_time());
  return chord(body).state_at(t);
}

Trajectory Frames::trajectory(std::uint32_t body, [[maybe_unused]] double begin, double end) const {
  assert(previous_time() <= begin && begin <= end && end <= latest_time());
  Segment segment = chord(body);
  segment.end = end;
  return {segment};
}

bool Frames::kick(std::uint32_t, double, const Vec3&) { return false; }

std::unique_ptr<Motion> Frames::clone() const { return std::make_unique<Frames>(*this); }

Segment Frames::chord(std::uint32_t body) const {
  return {.begin = previous_time(),
          .end = latest_time(),
          .position = previous_[body],
          .velocity = (latest_[body] - previous_[body]) / interval_,
          .acceleration = {},
          .jerk = {}};
}

}  // namespace kinesphere
