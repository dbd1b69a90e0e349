#include "monitor/separation_forecast.hpp"

#include <algorithm>

#include "bound/rounding.hpp"
#include "monitor/well_clear_course.hpp"

namespace kinesphere {
namespace {

/// A ReachableSet projected onto the axes of one component: a path whose radius starts at zero and grows, and
/// the constant part of the radius.
struct View {
  Bound path;
  double error;
  double end;

  View(const ReachableSet& set, const Component& component)
      : path{set.time,
             component.part(set.position),
             component.part(set.velocity),
             component.part(set.acceleration),
             0.0,
             component.length(set.speed),
             component.length(set.growth)},
        error(component.length(set.radius)),
        end(set.end) {}

  /// Returns the growth of the radius since the set's time.
  double growth_at(double t) const { return path.radius_at(t); }
  /// Returns the path with radius zero.
  Bound centre() const {
    Bound alone = path;
    alone.growth_speed = 0.0;
    alone.acceleration_limit = 0.0;
    return alone;
  }
};

/// The distance between two reachable sets along one component, at time `now`. Both hold then.
class ReachableSetsMeeting {
 public:
  ReachableSetsMeeting(const ReachableSet& a, const ReachableSet& b, const Component& component, double now)
      : a_(a, component),
        b_(b, component),
        now_(now),
        end_(std::min(a.end, b.end)),
        errors_(rounding::sum_up(a_.error, b_.error)),
        limit_(component.limit),
        outer_limit_(rounding::sum_down(component.limit, component.tolerance)),
        gap_(gap_limits(a_.path, b_.path, now)) {}

  double lower() const { return rounding::sum_down(gap_.lower, -errors_); }
  double upper() const { return rounding::sum_up(gap_.upper, errors_); }
  bool is_apart() const { return lower() > limit_; }
  bool is_within() const { return upper() <= outer_limit_; }
  /// Returns about how long it takes at least until the two certainly are within, at their largest relative
  /// speed; 0 if they are. +infinity if the radii alone are too large for that.
  double time_to_within() const {
    if (is_within()) return 0.0;
    if (errors_ + growth() > outer_limit_) return infinity;
    const double speed =
        norm(a_.path.velocity_at(now_) - b_.path.velocity_at(now_)) + growth_speed(a_) + growth_speed(b_);
    return (upper() - outer_limit_) / speed;
  }

  double apart_until(double horizon) const {
    return std::min(end_,
                    earliest_meeting(a_.path, b_.path, now_, horizon, rounding::sum_up(limit_, errors_)));
  }
  double within_until(double horizon) const {
    const double margin = rounding::sum_down(outer_limit_, -errors_);
    return std::min(end_, earliest_separation(a_.path, b_.path, now_, horizon, margin));
  }
  /// Returns the time before which time alone cannot make the pair certainly apart (or within): the time that
  /// it would take if the radii did not grow from now on.
  double may_be_apart(double horizon) const {
    return earliest_separation(a_.centre(), b_.centre(), now_, horizon, limit_ + errors_ + growth());
  }
  double may_be_within(double horizon) const {
    const double margin = outer_limit_ - errors_ - growth();
    return margin >= 0.0 ? earliest_meeting(a_.centre(), b_.centre(), now_, horizon, margin) : infinity;
  }

 private:
  double growth() const { return a_.growth_at(now_) + b_.growth_at(now_); }
  double growth_speed(const View& view) const {
    return view.path.growth_speed + view.path.acceleration_limit * (now_ - view.path.time);
  }

  View a_, b_;
  double now_, end_;
  double errors_, limit_, outer_limit_;
  GapLimits gap_;
};

/// Two reachable sets and well clear with modified tau, at time `now`. Both hold then. The two are clear if
/// they are farther apart than the limit, and modified tau does not count. They have lost well clear if they
/// are within the limit, or by modified tau.
class WellClearMeeting {
 public:
  WellClearMeeting(const ReachableSet& a, const ReachableSet& b, const Component& component, double now,
                   double least)
      : distance_(a, b, component, now), course_(a, b, component, now, least), end_(std::min(a.end, b.end)) {}

  double lower() const { return distance_.lower(); }
  double upper() const { return distance_.upper(); }
  bool is_apart() const { return distance_.is_apart() && course_.is_clear(); }
  bool is_within() const { return distance_.is_within() || course_.is_lost(); }
  double time_to_within() const { return distance_.time_to_within(); }

  double apart_until(double horizon) const {
    return std::min({end_, distance_.apart_until(horizon), course_.clear_until(horizon)});
  }
  double within_until(double horizon) const {
    const double until = course_.lost_until(horizon);
    return std::min(end_, distance_.is_within() ? std::max(until, distance_.within_until(horizon)) : until);
  }
  double may_be_apart(double horizon) const {
    const double from = distance_.may_be_apart(horizon);
    return from < infinity ? std::max(from, course_.may_be_clear(horizon)) : from;
  }
  double may_be_within(double horizon) const { return course_.may_be_lost(horizon); }

 private:
  ReachableSetsMeeting distance_;
  WellClearCourse course_;
  double end_;
};

/// Calls visit(meeting) for each pair of reachable sets that hold now, until it returns false. `least` is the
/// resolution of times.
template <class Visit>
void for_each_meeting(const Hypothesis& a, const Hypothesis& b, const Component& component, double now,
                      double least, Visit visit) {
  const auto visit_all = [&](auto meeting_of) {
    for (const ReachableSet& one : a.sets)
      for (const ReachableSet& other : b.sets)
        if (std::max(one.time, other.time) <= now && now < std::min(one.end, other.end))
          if (!visit(meeting_of(one, other))) return;
  };
  if (component.modified_tau > 0.0)
    visit_all([&](const ReachableSet& one, const ReachableSet& other) {
      return WellClearMeeting(one, other, component, now, least);
    });
  else
    visit_all([&](const ReachableSet& one, const ReachableSet& other) {
      return ReachableSetsMeeting(one, other, component, now);
    });
}

/// Times until which two hypotheses prove the pair apart or within; -infinity if they do not prove it now.
struct Certain {
  double apart = -infinity;
  double within = infinity;
};

Certain certain_of(const Hypothesis& a, const Hypothesis& b, const Components& components, double now,
                   double horizon, double least) {
  Certain certain;
  for (const Component& component : components) {
    double within = -infinity;
    for_each_meeting(a, b, component, now, least, [&](const auto& meeting) {
      if (meeting.is_apart()) certain.apart = std::max(certain.apart, meeting.apart_until(horizon));
      if (meeting.is_within()) within = std::max(within, meeting.within_until(horizon));
      // No other pair of sets can give a later time.
      return certain.apart < infinity && within < infinity;
    });
    certain.within = std::min(certain.within, within);
  }
  return certain;
}

/// Returns the earliest start after `now` of a reachable set that does not hold yet.
double next_begin(const Hypothesis& hypothesis, double now) {
  double next = infinity;
  for (const ReachableSet& set : hypothesis.sets)
    if (set.time > now) next = std::min(next, set.time);
  return next;
}

/// Returns the earliest time at which time alone may decide a pair that two hypotheses leave open.
double decided_from(const Hypothesis& a, const Hypothesis& b, const Components& components, double now,
                    double horizon, double least) {
  double apart = infinity;
  double within = -infinity;
  for (const Component& component : components) {
    double one_within = infinity;
    for_each_meeting(a, b, component, now, least, [&](const auto& meeting) {
      apart = std::min(apart, meeting.may_be_apart(std::min(horizon, apart)));
      one_within = std::min(one_within,
                            meeting.is_within() ? now : meeting.may_be_within(std::min(horizon, one_within)));
      return true;
    });
    within = std::max(within, one_within);
  }
  return std::min({apart, within, next_begin(a, now), next_begin(b, now)});
}

/// certain_within_by() of two hypotheses: advances by about the time that it takes at least.
double certain_within_by(const Hypothesis& a, const Hypothesis& b, const Components& components, double now,
                         double least) {
  constexpr int rounds = 64;
  double time = now;
  for (int round = 0; round < rounds; ++round) {
    double longest = 0.0;
    for (const Component& component : components) {
      double shortest = infinity;
      for_each_meeting(a, b, component, time, least, [&](const auto& meeting) {
        shortest = std::min(shortest, meeting.time_to_within());
        return shortest > 0.0;
      });
      longest = std::max(longest, shortest);
    }
    if (longest == 0.0) return time;
    time += std::max(longest, least);
    if (!(time < infinity)) break;
  }
  return infinity;
}

}  // namespace

double certain_within_by(const TrackEstimate& a, const TrackEstimate& b, const Components& separation,
                         double now, double least) {
  double latest = now;
  for (const Hypothesis& one : a.hypotheses())
    for (const Hypothesis& other : b.hypotheses())
      latest = std::max(latest, certain_within_by(one, other, separation, now, least));
  return latest;
}

SeparationForecast forecast_of(const TrackEstimate& a, const TrackEstimate& b, const Components& separation,
                               double now, double horizon, double least) {
  Certain all{infinity, infinity};
  for (const Hypothesis& one : a.hypotheses())
    for (const Hypothesis& other : b.hypotheses()) {
      const Certain certain = certain_of(one, other, separation, now, horizon, least);
      all.apart = std::min(all.apart, certain.apart);
      all.within = std::min(all.within, certain.within);
    }
  const double enough = now + least;
  if (all.apart >= enough && all.apart >= all.within) return {Verdict::apart, all.apart};
  if (all.within >= enough) return {Verdict::within, all.within};
  double until = enough;
  // If a track has several hypotheses, the next report decides the pair again, and time alone does not.
  if (a.hypotheses().size() == 1 && b.hypotheses().size() == 1)
    until = std::max(until, decided_from(a.hypotheses().front(), b.hypotheses().front(), separation, now,
                                         infinity, least));
  else
    until = infinity;
  return {Verdict::undecided, until};
}

DistanceBetween distance_between(const TrackEstimate& a, const TrackEstimate& b, const Component& component,
                                 double now) {
  DistanceBetween all{infinity, 0.0};
  for (const Hypothesis& one : a.hypotheses())
    for (const Hypothesis& other : b.hypotheses()) {
      DistanceBetween between;
      for_each_meeting(one, other, component, now, 0.0, [&](const auto& meeting) {
        between.lower = std::max(between.lower, meeting.lower());
        between.upper = std::min(between.upper, meeting.upper());
        return true;
      });
      all.lower = std::min(all.lower, between.lower);
      all.upper = std::max(all.upper, between.upper);
    }
  return all;
}

}  // namespace kinesphere
