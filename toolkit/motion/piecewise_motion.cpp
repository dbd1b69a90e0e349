// PiecewiseMotion: motion along given trajectories.
#include "kinesphere/motion/piecewise_motion.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "input/input_check.hpp"
#include "motion/body_bytes.hpp"
#include "motion/checks.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

namespace {

/// Returns the segment that contains t, or the first segment if t is before it.
Trajectory::const_iterator piece_at(const Trajectory& trajectory, double t) {
  const auto begins_after = [](double time, const Segment& segment) { return time < segment.begin; };
  return std::upper_bound(trajectory.begin() + 1, trajectory.end(), t, begins_after) - 1;
}

double largest_acceleration(const Trajectory& trajectory) {
  double largest = 0.0;
  for (const Segment& segment : trajectory) {
    largest = std::max({largest, norm(segment.acceleration), norm(segment.acceleration_at(segment.end))});
  }
  return largest;
}

/// Returns true if a and b are equal up to rounding of values of magnitude `size`.
bool nearly_equal(const Vec3& a, const Vec3& b, double size) { return norm_one(a - b) <= 1e-12 * size; }

bool goes_on(const Segment& before, const Segment& after) {
  const double duration = before.end - before.begin;
  const double acceleration = norm_one(before.acceleration) + norm_one(before.jerk) * duration;
  const double speed = norm_one(before.velocity) + acceleration * duration;
  const double distance = norm_one(before.position) + speed * duration;
  const State state = before.state_at(before.end);
  return nearly_equal(after.position, state.position, distance) &&
         nearly_equal(after.velocity, state.velocity, speed);
}

void check_segment(InputCheck& check, const Subject& subject, const Segment& segment) {
  for (const double time : {segment.begin, segment.end}) check.finite(subject, time);
  for (const Vec3& vector : {segment.position, segment.velocity, segment.acceleration, segment.jerk}) {
    check.finite(subject, vector);
  }
  check.require(segment.begin < segment.end, ErrorCode::out_of_range, subject, "must have an end later than",
                segment.begin, segment.end);
}

void check_time(InputCheck& check, const Subject& subject, const Segment& before, const Segment& after) {
  check.require(after.begin == before.end, ErrorCode::out_of_range, subject,
                "must begin when the one before it ends,", before.end, after.begin);
}

void check_state(InputCheck& check, const Subject& subject, const Segment& before, const Segment& after) {
  check.require(goes_on(before, after), ErrorCode::out_of_range, subject,
                "must have the position and velocity with which the one before it ends,",
                before.state_at(before.end), State{after.position, after.velocity});
}

/// Checks that each segment begins when the previous one ends and, if `smoothly`, with the position and
/// velocity of that end.
void check_trajectory(InputCheck& check, Subject subject, const Trajectory& trajectory, bool smoothly) {
  check.require(!trajectory.empty(), ErrorCode::out_of_range, subject, "must have at least 1 segment",
                trajectory.size());
  subject.part = "segment";
  for (std::size_t k = 0; k < trajectory.size(); ++k) {
    subject.part_number = k;
    check_segment(check, subject, trajectory[k]);
    if (k == 0) continue;
    check_time(check, subject, trajectory[k - 1], trajectory[k]);
    if (smoothly) check_state(check, subject, trajectory[k - 1], trajectory[k]);
  }
}

double limit_of(const Trajectory& trajectory) { return slightly_more * largest_acceleration(trajectory); }

void add_coasting(Trajectory& trajectory) {
  const double last_time = trajectory.back().end;
  const State last = trajectory.back().state_at(last_time);
  trajectory.push_back({.begin = last_time,
                        .end = infinity,
                        .position = last.position,
                        .velocity = last.velocity,
                        .acceleration = {},
                        .jerk = {}});
}

}  // namespace

Result<PiecewiseMotion> PiecewiseMotion::create(std::vector<Trajectory> trajectories) {
  InputCheck check("PiecewiseMotion::create");
  for (std::uint32_t body = 0; body < trajectories.size(); ++body) {
    check_trajectory(check, {"trajectories", {body, 0}}, trajectories[body], true);
    if (check.error()) return *check.error();
  }
  return PiecewiseMotion(std::move(trajectories));
}

PiecewiseMotion::PiecewiseMotion(std::vector<Trajectory> trajectories, bool ends_with_trajectories)
    : trajectories_(std::move(trajectories)), ends_with_trajectories_(ends_with_trajectories) {
  limits_.reserve(trajectories_.size());
  for (Trajectory& trajectory : trajectories_) {
    limits_.push_back(limit_of(trajectory));
    add_coasting(trajectory);
  }
}

const Trajectory& PiecewiseMotion::known_trajectory(std::uint32_t body, double t, std::string_view call,
                                                    std::string_view argument) const {
  if (!contains(body) || !std::isfinite(t)) [[unlikely]]
    refuse_question(call, *this, body, argument, t, {-infinity, infinity});
  return trajectories_[body];
}

void PiecewiseMotion::require_within(std::uint32_t body, double t, std::string_view call,
                                     std::string_view argument) const {
  if (!ends_with_trajectories_) return;
  const double first = trajectories_[body].front().begin, last = trajectories_[body].back().begin;
  if (first <= t && t <= last) [[likely]]
    return;
  const Subject subject{argument, {body, 0}};
  detail::bad_result(
      InputCheck(call)
          .require(t >= first, ErrorCode::out_of_range, subject,
                   "must not lie before its first sample, because it is not there yet:", first, t)
          .require(t <= last, ErrorCode::out_of_range, subject,
                   "must not lie after its last sample, because it has vanished then:", last, t)
          .error()
          .value());
}

double PiecewiseMotion::first_time(std::uint32_t body) const {
  return known_trajectory(body, 0.0, "first_time", "body").front().begin;
}

double PiecewiseMotion::last_time(std::uint32_t body) const {
  return known_trajectory(body, 0.0, "last_time", "body").back().begin;
}

BodyDefinition PiecewiseMotion::definition(std::uint32_t body, double t) const {
  const State now = state(body, t);
  return {.acceleration_limit = limits_[body], .position = now.position, .velocity = now.velocity};
}

State PiecewiseMotion::state(std::uint32_t body, double t) const {
  const Trajectory& known = known_trajectory(body, t, "state", "t");
  require_within(body, t, "state", "t");
  if (t < known.front().begin) return lead_in(body, t).state_at(t);
  return piece_at(known, t)->state_at(t);
}

Trajectory PiecewiseMotion::trajectory(std::uint32_t body, double begin, double end) const {
  constexpr std::string_view call = "trajectory";
  const Trajectory& known = known_trajectory(body, begin, call, "begin");
  if (!std::isfinite(end)) refuse_question(call, *this, body, "end", end, {begin, infinity});
  if (end < begin) refuse_order(call, body, begin, end);
  require_within(body, begin, call, "begin");
  require_within(body, end, call, "end");
  Trajectory result;
  if (begin < known.front().begin) result.push_back(lead_in(body, begin));
  auto segment = piece_at(known, begin);
  while (result.empty() || result.back().end < end) result.push_back(*segment++);
  result.back().end = end;
  return result;
}

Result<void> PiecewiseMotion::set_velocity(std::uint32_t body, double, const Vec3&) {
  return cannot_change("set_velocity", *this, body, "given a velocity");
}

Result<void> PiecewiseMotion::remove(std::uint32_t body) {
  if (const auto error = wrong_body("remove", *this, body)) return *error;
  trajectories_[body] = Trajectory();  // Frees the memory, which assigning {} would keep.
  free_.push_back(body);
  return {};
}

Result<void> PiecewiseMotion::write_body(std::uint32_t body, std::vector<std::byte>& bytes) const {
  if (const auto error = wrong_body("write_body", *this, body)) return *error;
  const Trajectory& known = trajectories_[body];
  append_body(bytes, piecewise_motion_mark, Trajectory(known.begin(), known.end() - 1));
  return {};
}

Result<std::uint32_t> PiecewiseMotion::read_body(std::span<const std::byte>& bytes) {
  Trajectory trajectory;
  const auto rest = take_body(bytes, piecewise_motion_mark, trajectory);
  if (!rest) return rest.error();
  // Not `smoothly`: if the steps of a recorded track differ in length by a factor of 10^12, its velocities at
  // the joints differ by more than create() allows.
  InputCheck check("PiecewiseMotion");
  check_trajectory(check, {"trajectory"}, trajectory, false);
  if (check.error()) return bad_bytes(*check.error());
  auto body = static_cast<std::uint32_t>(size());
  if (free_.empty()) {
    trajectories_.emplace_back();
    limits_.emplace_back();
  } else {
    body = free_.back();
    free_.pop_back();
  }
  limits_[body] = limit_of(trajectory);
  add_coasting(trajectory);
  trajectories_[body] = std::move(trajectory);
  bytes = *rest;
  return body;
}

std::unique_ptr<Motion> PiecewiseMotion::clone() const { return std::make_unique<PiecewiseMotion>(*this); }

/// Returns the straight segment from time t to the first segment.
Segment PiecewiseMotion::lead_in(std::uint32_t body, double t) const {
  const Segment& first = trajectories_[body].front();
  return {.begin = t,
          .end = first.begin,
          .position = first.position + (t - first.begin) * first.velocity,
          .velocity = first.velocity,
          .acceleration = {},
          .jerk = {}};
}

}  // namespace kinesphere
