#include "monitor/track_estimate.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "bound/rounding.hpp"
#include "kinesphere/limits.hpp"

namespace kinesphere {
namespace {

/// Largest number of hypotheses; a further contradiction replaces the oldest one.
constexpr std::size_t most_hypotheses = 3;

/// Returns the report with its timestamp error converted into errors of the state at the timestamp. If the
/// timestamp may be wrong, the plan in force may be so too: accelerations differ from the class's planned
/// acceleration by at most what `plans` allow.
ExactReport exact_report(const TrackReport& report, const TrackClass& track_class,
                         const PlansBeyondClass& plans) {
  ExactReport exact{report.timestamp, report.state, report.position_error, report.velocity_error};
  const double error = report.timestamp_error;
  if (error == 0.0) return exact;
  const ErrorBound speed =
      least(lengths_of(report.state.velocity) + report.velocity_error, track_class.largest_speed);
  const ErrorBound turn =
      plans.limit_from(report.timestamp - error, track_class) + lengths_of(track_class.planned_acceleration);
  // Largest distance travelled within the timestamp error, limited by acceleration and by the largest speed.
  const ErrorBound distance =
      least((speed + turn * (0.5 * error)) * error, track_class.largest_speed * error);
  exact.position_error = exact.position_error + distance * (1.0 + rounding::margin);
  exact.velocity_error = exact.velocity_error + turn * (error * (1.0 + rounding::margin));
  return exact;
}

bool is_finite(const ErrorBound& error) { return std::isfinite(error.total()); }

/// Returns the reachable set for accelerations that differ from `planned` by at most `limit`.
ReachableSet motion_of(const ExactReport& report, const Vec3& planned, const ErrorBound& limit) {
  return {.time = report.timestamp,
          .position = report.state.position,
          .velocity = report.state.velocity,
          .acceleration = planned,
          .radius = report.position_error,
          .speed = report.velocity_error,
          .growth = limit};
}

/// Returns the reachable set that follows from the class's largest speed alone.
ReachableSet range_of(const ExactReport& report, const TrackClass& track_class) {
  return {.time = report.timestamp,
          .position = report.state.position,
          .radius = report.position_error,
          .speed = track_class.largest_speed};
}

/// Adds a margin for the rounding of later computations with the set.
void widen(ReachableSet& set) {
  const double size = norm_one(set.position) * rounding::margin;
  set.radius = set.radius + ErrorBound(size);
}

/// Returns the reachable set for a track that accelerates for the duration `after` and then moves at its
/// largest speed. At that time the track is within the radius of `motion`, and from then on the radius grows
/// at the largest speed. Returns nothing if that time is after the end of `motion` or after
/// limits::largest_time.
std::optional<ReachableSet> range_after(const ReachableSet& motion, double after,
                                        const TrackClass& track_class) {
  const double begin = motion.time + after;
  if (!(after > 0.0 && begin < motion.end && begin <= limits::largest_time)) return std::nullopt;
  const ReachableSet then = motion.moved_to(begin);
  return ReachableSet{
      .time = begin, .position = then.position, .radius = then.radius, .speed = track_class.largest_speed};
}

/// Adds the reachable sets of a report from `now` on that follow from the accelerations allowed by the class
/// and by plans. The first one is the tightest.
void add_motions(const ExactReport& report, const std::optional<TrackReport::Plan>& plan,
                 const TrackClass& track_class, const PlansBeyondClass& plans, double now,
                 std::vector<ReachableSet>& sets) {
  if (!is_finite(report.velocity_error)) return;
  const bool has_limit = is_finite(track_class.acceleration_limit);
  // Appends the continuation of a set from `time` on, where the acceleration limit changes. No monitor
  // reaches times after limits::largest_time, where lengths would overflow.
  const auto continue_from = [&](const ReachableSet& motion, double time) {
    if (!(time <= limits::largest_time)) return;
    ReachableSet later = motion.moved_to(time);
    later.acceleration = track_class.planned_acceleration;
    later.growth = plans.limit_from(time, track_class);
    later.end = infinity;
    sets.push_back(later);
  };
  if (plan && now < plan->valid_until) {
    ReachableSet planned = motion_of(report, plan->acceleration, plan->acceleration_limit);
    planned.end = plan->valid_until;
    sets.push_back(planned);
    if (has_limit) continue_from(planned, planned.end);
  }
  if (!has_limit) return;
  const ReachableSet motion =
      motion_of(report, track_class.planned_acceleration, plans.limit_from(report.timestamp, track_class));
  if (report.timestamp > now) {
    ReachableSet back = motion;
    back.growth = plans.limit_from(now, track_class);
    sets.push_back(back.moved_to(now));
  }
  sets.push_back(motion);
  if (report.timestamp < plans.end) continue_from(motion, plans.end);
}

std::vector<ReachableSet> reachable_sets_of(const ExactReport& report,
                                            const std::optional<TrackReport::Plan>& plan,
                                            const TrackClass& track_class, const PlansBeyondClass& plans,
                                            double now) {
  const bool has_speed = is_finite(track_class.largest_speed);
  // As many as most reports have, and one of an earlier report.
  std::vector<ReachableSet> sets;
  sets.reserve(has_speed ? 5 : 2);
  add_motions(report, plan, track_class, plans, now, sets);
  if (has_speed) {
    if (!sets.empty()) {
      // The largest speed is reached sooner when the track accelerates along its velocity than when it turns
      // back.
      const ReachableSet motion = sets.front();
      const double fastest = track_class.largest_speed.total();
      const double limit = motion.growth.total();
      for (const double speed : {fastest - norm(motion.velocity), fastest})
        if (const auto range = range_after(motion, speed / limit, track_class)) sets.push_back(*range);
    }
    const ReachableSet range = range_of(report, track_class);
    if (report.timestamp > now) sets.push_back(range.moved_to(now));
    sets.push_back(range);
  }
  for (ReachableSet& set : sets) widen(set);
  return sets;
}

double beyond(const Vec3& offset, const ErrorBound& limit, double size) {
  const double margin = rounding::margin * size;
  const double flat = norm({offset.x, offset.y, 0.0}) - limit.horizontal();
  const double upright = std::abs(offset.z) - limit.vertical();
  const double all = norm(offset) - limit.total();
  return std::max({0.0, flat - margin, upright - margin, all - margin});
}

/// Returns the excess of `report` over what the state of an earlier or later report leaves possible. `own`:
/// the report's plan, if it exceeds the limits of the class.
Excess excess_of(const ExactReport& report, const PlansBeyondClass& own, const Hypothesis& believed,
                 const TrackClass& track_class) {
  const ExactReport& from = believed.latest;
  const double elapsed = report.timestamp - from.timestamp;
  const double s = std::abs(elapsed);
  // A report's plan is in force from its timestamp on, so it applies between the two if the report is the
  // older one.
  const PlansBeyondClass plans = elapsed < 0.0 ? joined(believed.plans, own) : believed.plans;
  const ErrorBound& limit = plans.limit_from(std::min(report.timestamp, from.timestamp), track_class);
  Excess excess;
  const double size = norm_one(report.state.position) + norm_one(from.state.position) +
                      (norm_one(from.state.velocity) + norm_one(track_class.planned_acceleration) * s) * s;
  const ErrorBound both = report.position_error + from.position_error;
  if (is_finite(from.velocity_error) && is_finite(limit)) {
    const Vec3 centre = from.state.position +
                        (from.state.velocity + track_class.planned_acceleration * (0.5 * elapsed)) * elapsed;
    const ErrorBound reach = both + (from.velocity_error + limit * (0.5 * s)) * s;
    excess.position = beyond(report.state.position - centre, reach, size);
    if (is_finite(report.velocity_error)) {
      const Vec3 velocity = from.state.velocity + track_class.planned_acceleration * elapsed;
      const ErrorBound turn = report.velocity_error + from.velocity_error + limit * s;
      excess.velocity = beyond(report.state.velocity - velocity, turn,
                               norm_one(report.state.velocity) + norm_one(from.state.velocity) +
                                   norm_one(track_class.planned_acceleration) * s);
    }
  }
  if (is_finite(track_class.largest_speed))
    excess.position = std::max(excess.position, beyond(report.state.position - from.state.position,
                                                       both + track_class.largest_speed * s, size));
  return excess;
}

Hypothesis hypothesis_of(const ExactReport& report, const std::optional<TrackReport::Plan>& plan,
                         const TrackClass& track_class, const PlansBeyondClass& plans, double now) {
  Hypothesis hypothesis{
      .latest = report, .plans = plans, .sets = reachable_sets_of(report, plan, track_class, plans, now)};
  hypothesis.latest_sets = static_cast<std::uint32_t>(hypothesis.sets.size());
  return hypothesis;
}

/// Merges two hypotheses that both hold. The result has the sets of `latest`'s latest report and, of all
/// other sets, the one that is tightest at time `soon`, if it is tighter there.
Hypothesis joined(Hypothesis latest, Hypothesis other, double now, double soon) {
  other.sets.insert(other.sets.end(), latest.sets.begin() + static_cast<std::ptrdiff_t>(latest.latest_sets),
                    latest.sets.end());
  latest.sets.resize(latest.latest_sets);
  const ReachableSet& best = TrackEstimate::tightest(other, now, soon);
  if (best.radius_at(soon).total() < TrackEstimate::tightest(latest, now, soon).radius_at(soon).total())
    latest.sets.push_back(best);
  return latest;
}

// Limits of the numbers in a snapshot. Reachable sets of reports and classes within kinesphere/limits.hpp do
// not exceed them: an acceleration for a time of 2e30 gives a speed of 1e131 and a length of 1e161. In the
// longest window, of 2^300, no computation with them overflows.
constexpr double most_length = 1e170;
constexpr double most_speed = 1e140;
constexpr double most_acceleration = 1e110;

bool is_time(double time) { return std::abs(time) <= limits::largest_time; }

bool is_within(const Vec3& v, double most) {
  return std::abs(v.x) <= most && std::abs(v.y) <= most && std::abs(v.z) <= most;
}

/// Returns false for NaN.
bool is_within(const ErrorBound& error, double most) {
  const auto is_length = [most](double value) { return value >= 0.0 && value <= most; };
  return is_length(error.horizontal()) && is_length(error.vertical()) && is_length(error.total());
}

bool is_valid(const ReachableSet& set) {
  return is_time(set.time) && !std::isnan(set.end) && is_within(set.position, most_length) &&
         is_within(set.velocity, most_speed) && is_within(set.acceleration, most_acceleration) &&
         is_within(set.radius, most_length) && is_within(set.speed, most_speed) &&
         is_within(set.growth, most_acceleration);
}

/// Checks a restored hypothesis. A set of the latest report has to hold from `now` on without end, so that
/// tightest() finds a set even after a later report has replaced all others.
bool is_valid(const Hypothesis& hypothesis, double now) {
  const auto& [latest, plans, latest_sets, sets] = hypothesis;
  if (!is_time(latest.timestamp) || !is_within(latest.state.position, most_length) ||
      !is_within(latest.state.velocity, most_speed) || !is_within(latest.position_error, most_length) ||
      !is_within(latest.velocity_error, infinity) || std::isnan(plans.end) ||
      !is_within(plans.limit, infinity) || latest_sets > sets.size())
    return false;
  const auto latest_end = sets.begin() + static_cast<std::ptrdiff_t>(latest_sets);
  const auto holds = [now](const ReachableSet& set) { return set.time <= now && set.end == infinity; };
  return std::all_of(sets.begin(), sets.end(), [](const ReachableSet& set) { return is_valid(set); }) &&
         std::any_of(sets.begin(), latest_end, holds);
}

}  // namespace

TrackEstimate::Learned TrackEstimate::update(const TrackReport& report, const TrackClass& track_class,
                                             double now, double ahead) {
  Learned learned;
  const PlansBeyondClass own = PlansBeyondClass::of(report, track_class);
  PlansBeyondClass all = own;
  for (const Hypothesis& believed : hypotheses_) all = joined(all, believed.plans);
  const ExactReport exact = exact_report(report, track_class, all);
  const auto next = [&](const PlansBeyondClass& plans) {
    return hypothesis_of(exact, report.plan, track_class, plans, now);
  };
  if (hypotheses_.empty()) {
    hypotheses_.push_back(next(all));
    return learned;
  }
  learned.late = exact.timestamp < timestamp();
  std::vector<std::size_t> agreeing;
  learned.excess = {infinity, infinity};
  for (std::size_t k = 0; k < hypotheses_.size(); ++k) {
    const Hypothesis& believed = hypotheses_[k];
    if (believed.latest.timestamp == exact.timestamp && believed.latest.state == exact.state &&
        believed.plans.include(own)) {
      learned = {.outcome = Outcome::repeated};
      return learned;
    }
    const Excess excess = excess_of(exact, own, believed, track_class);
    if (!excess.any()) agreeing.push_back(k);
    if (excess.position + excess.velocity < learned.excess.position + learned.excess.velocity)
      learned.excess = excess;
  }
  if (agreeing.empty()) {
    learned.outcome = Outcome::contradicts;
    learned.ends_certainty = true;
    if (hypotheses_.size() == most_hypotheses) hypotheses_.erase(hypotheses_.begin());
    hypotheses_.push_back(next(all));
    return learned;
  }
  if (hypotheses_.size() > 1) learned.outcome = Outcome::resolves;
  learned.ends_certainty = std::any_of(agreeing.begin(), agreeing.end(),
                                       [&](std::size_t k) { return !hypotheses_[k].plans.include(own); });
  if (agreeing.size() > 1 || learned.ends_certainty) {
    // Several agreeing hypotheses contradict each other, so one of them relies on a wrong report, and this
    // report is right. If a plan exceeds what was possible before, only the latest state is kept.
    const Hypothesis& believed = hypotheses_[agreeing.front()];
    Hypothesis only = next(all);
    if (agreeing.size() == 1 && exact.timestamp < believed.latest.timestamp)
      only = joined(hypothesis_of(believed.latest, {}, track_class, all, now), std::move(only), now,
                    now + ahead);
    hypotheses_ = {std::move(only)};
    return learned;
  }
  Hypothesis believed = std::move(hypotheses_[agreeing.front()]);
  Hypothesis latest = next(believed.plans);
  hypotheses_.clear();
  const bool newer = exact.timestamp >= believed.latest.timestamp;
  hypotheses_.push_back(newer ? joined(std::move(latest), std::move(believed), now, now + ahead)
                              : joined(std::move(believed), std::move(latest), now, now + ahead));
  return learned;
}

const ReachableSet& TrackEstimate::tightest(const Hypothesis& hypothesis, double from, double until) {
  const ReachableSet* best = nullptr;
  double least = infinity;
  for (const ReachableSet& set : hypothesis.sets) {
    if (set.time > from || set.end < until) continue;
    const double radius = set.radius_at(until).total();
    if (best == nullptr || radius < least) {
      best = &set;
      least = radius;
    }
  }
  assert(best != nullptr);
  return *best;
}

Bound TrackEstimate::bound(const Hypothesis& hypothesis, double now, double end) {
  return tightest(hypothesis, now, end).moved_to(now).bound();
}

double TrackEstimate::largest_speed(const Hypothesis& hypothesis, double now, double end) {
  double least = infinity;
  for (const ReachableSet& set : hypothesis.sets) {
    if (set.time > now || set.end < end) continue;
    const auto speed_at = [&](double time) {
      const Vec3 velocity = set.velocity_at(time);
      return norm({velocity.x, velocity.y, 0.0});
    };
    // The speed of the centre is a convex function of time.
    const double centre = std::max(speed_at(now), speed_at(end));
    const double rounding =
        rounding::margin * (norm_one(set.velocity) + norm_one(set.acceleration) * (end - set.time));
    const double error = set.speed.horizontal() + set.growth.horizontal() * (end - set.time);
    least = std::min(least, centre + error + rounding);
  }
  return least;
}

double TrackEstimate::worth_asking(double time) const {
  double largest = 0.0;
  for (const Hypothesis& hypothesis : hypotheses_)
    largest = std::max(largest, tightest(hypothesis, time).radius_at(time).total());
  return largest * std::max(0.0, time - timestamp());
}

double TrackEstimate::timestamp() const {
  double latest = -infinity;
  for (const Hypothesis& hypothesis : hypotheses_) latest = std::max(latest, hypothesis.latest.timestamp);
  return latest;
}

bool TrackEstimate::is_valid(double now) const {
  return !hypotheses_.empty() && hypotheses_.size() <= most_hypotheses &&
         std::all_of(hypotheses_.begin(), hypotheses_.end(),
                     [now](const Hypothesis& hypothesis) { return kinesphere::is_valid(hypothesis, now); });
}

double TrackEstimate::first_end() const {
  double first = infinity;
  for (const Hypothesis& hypothesis : hypotheses_)
    for (const ReachableSet& set : hypothesis.sets) first = std::min(first, set.end);
  return first;
}

}  // namespace kinesphere
