#include "contact/outlook.hpp"

#include <algorithm>
#include <cmath>

namespace kinesphere {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

double just_after(double time) { return std::nextafter(time, infinity); }

EventKind kind_of(ContactRule::Change change, Wall wall) {
  if (change == ContactRule::Change::begin)
    return wall == Wall::none ? EventKind::contact_begin : EventKind::wall_begin;
  return wall == Wall::none ? EventKind::contact_end : EventKind::wall_end;
}

template <class Partner>
double Outlook<Partner>::until_reports(bool touching) const {
  const double time = touching ? separation(rule_.release_gap()) : meeting(0.0);
  if (time == infinity || time <= now_) return time;
  const GapLimits gap = gap_limits(bound_, partner_, now_);
  const bool far = touching ? gap.upper < rule_.separation_distance() : gap.lower > rule_.tolerance();
  return far ? time : now_;
}

template <class Partner>
Verdict Outlook<Partner>::judge(bool touching, const Event& current, const Promise& promise) const {
  Verdict verdict;
  verdict.change = rule_.decide(touching, current.gap, current.approach_speed);
  if (verdict.is_news()) return verdict;
  if (touching && verdict.change != ContactRule::Change::release) {
    verdict.next_look = std::max(separation(rule_.release_gap()), just_after(now_));
    return verdict;
  }
  // A certificate cannot guard a gap that lies within its own rounding of the present one.
  const double gap = current.gap - resolution();
  double time = meeting(rule_.guarded_gap(gap));
  const double least = now_ + rule_.least_step(current.gap, promise.speed_error, promise.acceleration);
  if (time < least) {
    // The Zeno guard: time has to move on between two looks at a contact that does not approach.
    time = least;
    verdict.zeno_step = true;
    verdict.breaks_tolerance = rule_.step_breaks_tolerance(current.gap);
  }
  if (rule_.is_deep(gap)) time = std::min(time, separation(rule_.surface_gap()));
  verdict.next_look = std::max(time, just_after(now_));
  return verdict;
}

/// More than what rounding can hide of the present gap.
template <class Partner>
double Outlook<Partner>::resolution() const {
  const GapLimits limits = gap_limits(bound_, partner_, now_);
  return 1.25 * (limits.upper - limits.lower);
}

template class Outlook<Bound>;
template class Outlook<HalfSpace>;

double until_reports_of_walls(const ContactRule& rule, const Bound& bound, const Box& box, double now,
                              double horizon) {
  const double time = earliest_exit(bound, box, now, horizon);
  if (time == infinity || time <= now) return time;
  const Vec3 tolerance = Vec3{1.0, 1.0, 1.0} * rule.tolerance();
  const Box inner{box.lower + tolerance, box.upper - tolerance};
  return earliest_exit(bound, inner, now, infinity) > now ? time : now;
}

}  // namespace kinesphere
