#include "processor/reports.hpp"

#include <algorithm>
#include <array>
#include <mutex>
#include <optional>

#include "archive/heap_counter.hpp"
#include "bodies/validation.hpp"
#include "kinesphere/limits.hpp"
#include "number/scope_guard.hpp"

namespace kinesphere {
namespace {

/// Minimum reports per parallel chunk; below this, dispatch costs more than probing.
constexpr std::size_t reports_at_once = 512;

constexpr std::size_t few_reports = 2;

/// Moves a report to the image that is nearest to where the bound expects its body.
inline void move_to_nearest_image(const Space& space, const Bound& bound, double time, State& report) {
  if (space.repeats())
    space.move(report, space.shift_to_nearest(report.position, bound.centre_at(time), time));
}

/// Notes how many rows of images a report has been moved.
inline void note_rows(Bodies& bodies, std::uint32_t number, const State& report, const State& moved) {
  if (bodies.space().slides()) bodies.rows[number] = bodies.space().rows_of(moved.position - report.position);
}

/// Returns the size (length / time) of what a velocity is computed from where images slide.
double speed_of_terms(const Space& space, const Vec3& reported) {
  return space.slides() ? norm(reported) + std::abs(space.slide_speed()) : 0.0;
}

std::optional<BoundViolation> sum_of(const std::optional<BoundViolation>& a,
                                     const std::optional<BoundViolation>& b) {
  if (!a || !b) return a ? a : b;
  return BoundViolation{a->position_excess + b->position_excess, a->velocity_excess + b->velocity_excess};
}

/// Returns true if the world knows how the rigid body turns.
bool turns_by_itself(const Bodies& bodies, const Body& body) {
  return !bodies.rigid.probe && bodies.rigid[body].keeps_spin();
}

Rotation normalized(const Rotation& rotation) {
  return {after(rotation.orientation, Quaternion{}), rotation.angular_velocity};
}

/// Returns the bound of the centre of a body whose radius changes with time.
Bound centre_bound(const Body& body, double velocity_error) {
  Bound bound = body.bound;
  bound.radius -= body.radius;
  bound.growth_speed = velocity_error;
  return bound;
}

Error no_rotation_probe(BodyId body, std::string_view call) {
  return {ErrorCode::null_probe, "rotation_probe", body,
          std::string(call) + ": set_rotation_probe() must have given a function that knows how " +
              text_of(body) + " turns, since its angular_acceleration_limit is not 0"};
}

}  // namespace

Result<std::span<const Reports::Violation>> Reports::take(Bodies& bodies, double time,
                                                          std::span<const std::uint32_t> numbers,
                                                          PoolLease& work) {
  if (numbers.size() <= few_reports && profile_ == nullptr && !bodies.space().slides()) {
    if (take_few(bodies, time, numbers)) return std::span<const Violation>();
  } else {
    ask_for(bodies, time, numbers, work);
  }
  violations_.clear();
  ask_rotations(bodies, time);
  const std::size_t bad = first_bad(bodies, time, work);
  if (bad < ids_.size()) return check(bodies, time, bad).error();
  apply_all(bodies, time, numbers, work);
  return std::span<const Violation>(violations_);
}

Result<std::vector<std::uint32_t>> Reports::contradicted(const Bodies& bodies, double time,
                                                         std::span<const std::uint32_t> numbers) {
  PoolLease alone;
  ask_for(bodies, time, numbers, alone);
  std::vector<std::uint32_t> broken;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const Body& body = bodies[numbers[k]];
    if (!is_valid_report(states_[k], bodies.definition()))
      return check_report(states_[k], ids_[k], time, bodies.definition(), call_).error();
    const double terms = speed_of_terms(bodies.space(), states_[k].velocity);
    move_to_nearest_image(bodies.space(), body.bound, time, states_[k]);
    if (certainly_keeps(body.bound, time, states_[k], body.radius, bodies.definition().contact_tolerance))
      continue;
    Bound after = body.bound;
    restart(after, time, states_[k]);
    if (bound_violation(body.bound, after, body.radius, {}, bodies.definition().contact_tolerance, terms))
      broken.push_back(numbers[k]);
  }
  return broken;
}

/// Probes one or two bodies, as nearly all calls do. Applies the reports if they are valid, keep the limits
/// of the bodies, and change nothing but their bounds and known rotations, as nearly all do. Otherwise keeps
/// them, and returns false. Precondition: images do not slide.
[[gnu::always_inline]] inline bool Reports::take_few(Bodies& bodies, double time,
                                                     std::span<const std::uint32_t> numbers) {
  std::array<BodyId, few_reports> ids;
  std::array<State, few_reports> states{no_answer, no_answer};
  const std::size_t count = numbers.size();
  for (std::size_t k = 0; k < count; ++k) ids[k] = bodies.id_of(numbers[k]);
  {
    asking_ = true;
    const ScopeGuard answered([&] { asking_ = false; });
    (*probe_)(std::span(ids).first(count), time, std::span(states).first(count));
  }
  bool are_plain = true;
  for (std::size_t k = 0; k < count && are_plain; ++k) {
    const Body& body = bodies[numbers[k]];
    are_plain = body.change_number == Body::none && !body.is_sleeping() &&
                (!body.is_rigid || turns_by_itself(bodies, body)) &&
                bodies.radii.find(numbers[k]) == nullptr && is_valid_report(states[k], bodies.definition());
    // An invalid report stays as it is, for the error message.
    if (are_plain) move_to_nearest_image(bodies.space(), body.bound, time, states[k]);
    are_plain = are_plain && certainly_keeps(body.bound, time, states[k], body.radius,
                                             bodies.definition().contact_tolerance);
  }
  if (!are_plain) {
    ids_.assign(ids.begin(), ids.begin() + static_cast<std::ptrdiff_t>(count));
    states_.assign(states.begin(), states.begin() + static_cast<std::ptrdiff_t>(count));
    return false;
  }
  for (std::size_t k = 0; k < count; ++k) {
    Body& body = bodies[numbers[k]];
    restart(body.bound, time, states[k]);
    if (body.is_rigid) bodies.rigid[body].report(bodies.rigid[body].at(time), time);
  }
  return true;
}

void Reports::ask_for(const Bodies& bodies, double time, std::span<const std::uint32_t> numbers,
                      PoolLease& work) {
  ids_.resize(numbers.size());
  states_.resize(numbers.size());
  work.parallel_for(numbers.size(), reports_at_once, [&](std::size_t from, std::size_t to, std::size_t) {
    for (std::size_t k = from; k < to; ++k) {
      ids_[k] = bodies.id_of(numbers[k]);
      states_[k] = no_answer;
    }
  });
  PoolLease alone;
  PoolLease& asking = lease_ != nullptr ? *lease_ : alone;
  asking_ = true;
  const ScopeGuard answered([&] { asking_ = false; });
  asking.parallel_for(ids_.size(), reports_at_once, [&](std::size_t from, std::size_t to, std::size_t) {
    const std::size_t count = to - from;
    (*probe_)(std::span(ids_).subspan(from, count), time, std::span(states_).subspan(from, count));
  });
}

/// Asks for the rotations of the rigid bodies among those that were probed.
void Reports::ask_rotations(const Bodies& bodies, double time) {
  rotations_.clear();
  if (!bodies.rigid.any() || !bodies.rigid.probe) return;
  std::vector<BodyId> ids;
  std::vector<std::size_t> places;
  for (std::size_t k = 0; k < ids_.size(); ++k) {
    if (!bodies[bodies.table().number_of(ids_[k])].is_rigid) continue;
    ids.push_back(ids_[k]);
    places.push_back(k);
  }
  if (ids.empty()) return;
  std::vector<Rotation> answers(ids.size(), no_rotation);
  asking_ = true;
  const ScopeGuard answered([&] { asking_ = false; });
  bodies.rigid.probe(ids, time, answers);
  rotations_.resize(ids_.size());
  for (std::size_t k = 0; k < ids.size(); ++k) rotations_[places[k]] = answers[k];
}

/// Returns the index of the first invalid report, or the number of reports if all are valid.
std::size_t Reports::first_bad(const Bodies& bodies, double time, PoolLease& lease) const {
  std::size_t first = ids_.size();
  const bool are_balls = !bodies.rigid.any() && !bodies.radii.any();
  std::mutex mutex;
  lease.parallel_for(ids_.size(), reports_at_once, [&](std::size_t from, std::size_t to, std::size_t) {
    for (std::size_t k = from; k < to; ++k) {
      if (are_balls && is_valid_report(states_[k], bodies.definition())) continue;
      if (check(bodies, time, k)) continue;
      const std::lock_guard lock(mutex);
      first = std::min(first, k);
      return;
    }
  });
  return first;
}

Result<void> Reports::check(const Bodies& bodies, double time, std::size_t k) const {
  auto valid = check_report(states_[k], ids_[k], time, bodies.definition(), call_);
  const std::uint32_t number = bodies.table().number_of(ids_[k]);
  const Body& body = bodies[number];
  if (const ChangingRadius* const changing = valid ? bodies.radii.find(number) : nullptr) {
    const double reach = bodies.sensors.reach(body.sensor_class);
    return check_grown({.radius = changing->at(time), .position_error = body.position_error}, reach, ids_[k],
                       bodies.definition(), call_);
  }
  if (!valid || !body.is_rigid) return valid;
  if (rotations_.empty()) return bodies.rigid[body].keeps_spin() ? valid : no_rotation_probe(ids_[k], call_);
  return check_rotation(rotations_[k], ids_[k], bodies.definition(), call_);
}

void Reports::apply_all(Bodies& bodies, double time, std::span<const std::uint32_t> numbers,
                        PoolLease& lease) {
  // Few of many pending changes are removed one by one.
  const bool are_many = 8 * numbers.size() >= bodies.changes.size();
  std::mutex mutex;
  std::size_t released = 0;
  lease.parallel_for(numbers.size(), reports_at_once, [&](std::size_t from, std::size_t to, std::size_t) {
    std::vector<Violation> some;
    std::size_t gone = 0;
    for (std::size_t k = from; k < to; ++k) {
      if (!apply_plain(bodies, time, numbers[k], states_[k])) apply(bodies, time, k, some);
      if (are_many) gone += static_cast<std::size_t>(bodies.release_change(numbers[k]));
    }
    const std::lock_guard lock(mutex);
    released += gone;
    violations_.insert(violations_.end(), some.begin(), some.end());
  });
  if (are_many)
    bodies.drop_released_changes(released);
  else
    for (const std::uint32_t number : numbers) bodies.forget_change(number);
  std::sort(violations_.begin(), violations_.end(),
            [](const Violation& a, const Violation& b) { return a.k < b.k; });
}

/// Applies a report that keeps the limits of the body, and at most gives the velocity that the caller has set
/// just so. Returns false, and changes nothing, if that is not certain.
[[gnu::always_inline]] inline bool Reports::apply_plain(Bodies& bodies, double time, std::uint32_t number,
                                                        const State& reported) const {
  Body& body = bodies[number];
  if (body.is_rigid || body.is_sleeping() || profile_ != nullptr || bodies.radii.find(number) != nullptr)
    return false;
  const double tolerance = bodies.definition().contact_tolerance;
  State state = reported;
  move_to_nearest_image(bodies.space(), body.bound, time, state);
  if (const Change* const change = bodies.changes.find(body)) {
    if (change->velocity != reported.velocity || change->limits != bodies.bound_limits_of(number) ||
        !certainly_stays(body.bound, time, state.position, body.radius, tolerance))
      return false;
  } else if (!certainly_keeps(body.bound, time, state, body.radius, tolerance)) {
    return false;
  }
  restart(body.bound, time, state);
  note_rows(bodies, number, reported, state);
  return true;
}

/// Applies a report. Adds to `broken` what it proves to be untrue.
void Reports::apply(Bodies& bodies, double time, std::size_t k, std::vector<Violation>& broken) const {
  const std::uint32_t number = bodies.table().number_of(ids_[k]);
  Body& body = bodies[number];
  State state = states_[k];
  move_to_nearest_image(bodies.space(), body.bound, time, state);
  note_rows(bodies, number, states_[k], state);
  const bool changes_size = bodies.radii.find(number) != nullptr;
  double velocity_error = bodies.velocity_error(number);
  const Bound before = changes_size ? centre_bound(body, velocity_error) : body.bound;
  if (changes_size) bodies.update_radius(number, time);
  std::optional<Vec3> new_velocity;
  // A caller that has just changed the body has said what its limits are.
  const bool adopts =
      bodies.definition().adopt_observed_limits && body.change_number == Body::none && !body.is_sleeping();
  if (const Change* change = bodies.changes.find(body)) {
    new_velocity = change->velocity;
    if (new_velocity) *new_velocity = bodies.velocity_in_image(number, *new_velocity);
    velocity_error = change->limits.velocity_error;
    body.bound = bodies.changed_bound(number, state, time);
  } else {
    restart(body.bound, time, state);
    if (changes_size) body.bound.radius = body.radius + body.position_error;
  }
  const Bound after = changes_size ? centre_bound(body, velocity_error) : body.bound;
  const double radius = changes_size ? 0.0 : body.radius;
  std::optional<BoundViolation> violation;
  if (body.is_rigid) violation = turn(bodies.rigid[body], body, before, k);
  if (new_velocity || before.radius != after.radius ||
      !certainly_keeps(before, time, {after.position, after.velocity}, radius,
                       bodies.definition().contact_tolerance))
    violation = sum_of(
        violation, bound_violation(before, after, radius, new_velocity, bodies.definition().contact_tolerance,
                                   speed_of_terms(bodies.space(), states_[k].velocity)));
  if (violation && adopts) adopt(bodies, body, before, after, radius);
  if (profile_ != nullptr && !new_velocity) profile_->note_report(number, before, after);
  if (body.is_sleeping()) body.stand_still();
  if (violation) broken.push_back({k, state.velocity, *violation, body.bound.acceleration_limit});
}

/// Raises the acceleration limit of a body whose report has broken it to what explains the report.
void Reports::adopt(const Bodies& bodies, Body& body, const Bound& before, const Bound& after,
                    double radius) {
  const double observed = observed_acceleration(before, after, radius, bodies.definition().contact_tolerance);
  body.bound.acceleration_limit =
      std::min(std::max(body.bound.acceleration_limit, observed), limits::largest_acceleration);
}

/// Takes the rotation of a report. Returns by how much it breaks the limits of the body, as far as its
/// outermost points are concerned.
std::optional<BoundViolation> Reports::turn(RigidRecord& record, const Body& body, const Bound& before,
                                            std::size_t k) const {
  const double time = body.bound.time;
  const Rotation last = record.rotation;
  const double spin = record.spin();
  const bool is_comparable = !rotations_.empty() && !record.is_changed;
  record.report(rotations_.empty() ? record.at(time) : normalized(rotations_[k]), time);
  if (!is_comparable) return std::nullopt;
  // Rounding of the caller's rotations.
  constexpr double slack = 0x1p-30;
  const double s = time - before.time;
  const double angle = angle_between(last.orientation, record.rotation.orientation) - spin * s;
  const double largest = record.largest_angular_speed;
  const double change = std::max(
      norm(record.rotation.angular_velocity - last.angular_velocity) - record.angular_acceleration_limit * s,
      record.keeps_spin() ? 0.0 : norm(record.rotation.angular_velocity) - largest);
  const double rounding = time_rounding(before.time, time);
  const bool left = angle > slack * (1.0 + spin * s) + rounding * spin;
  const bool jumped = change > slack * (spin + norm(record.rotation.angular_velocity)) +
                                   rounding * record.angular_acceleration_limit;
  if (!left && !jumped) return std::nullopt;
  return BoundViolation{left ? angle * body.radius : 0.0, jumped ? change * body.radius : 0.0};
}

std::size_t Reports::bytes() const { return heap_bytes(ids_, states_, rotations_, violations_); }

}  // namespace kinesphere
