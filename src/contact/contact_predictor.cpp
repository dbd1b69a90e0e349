#include "contact/contact_predictor.hpp"

#include <algorithm>
#include <cstdint>
#include <type_traits>

#include "bound/mesh_tree.hpp"
#include "bound/rigid_part.hpp"
#include "bound/shape_difference.hpp"
#include "bound/sides_in_reach.hpp"
#include "contact/contact_event.hpp"
#include "number/bit_cast.hpp"
#include "number/infinity.hpp"

namespace kinesphere {
namespace {

template <class Partner>
constexpr bool is_rigid_pair = false;
template <class Other>
constexpr bool is_rigid_pair<RigidPair<Other>> = true;

/// True for solids of several pieces.
template <class Partner>
constexpr bool has_pieces =
    std::is_same_v<Partner, Placed<Mesh>> || std::is_same_v<Partner, Placed<ShapeDifference>>;
/// Of several pieces, others than the nearest may be approached, as of the points of rigid bodies.
template <class Partner>
constexpr bool has_several_points = is_rigid_pair<Partner> || has_pieces<Partner>;

/// Returns a lower bound of the distance between the nearest points of the axes.
template <class Other>
double arm_of(const RigidPair<Other>& pair, double gap) {
  const auto radius = [](const RigidExtent& body) {
    return least_radius(body.parts) + (body.bound.radius - body.radius);
  };
  const double own = gap + radius(pair.body);
  if constexpr (std::is_same_v<Other, RigidExtent>)
    return own + radius(pair.other);
  else
    return std::is_same_v<Other, HalfSpace> ? infinity : own;
}

}  // namespace

double just_after(double time) {
  if (time == 0.0) return std::numeric_limits<double>::denorm_min();
  if (!(time < infinity)) return time;
  const auto bits = bit_cast<std::int64_t>(time);
  return bit_cast<double>(time > 0.0 ? bits + 1 : bits - 1);
}

EventKind kind_of(ContactRule::Change change, bool sensed, Wall wall) {
  if (sensed) return change == ContactRule::Change::begin ? EventKind::sensor_enter : EventKind::sensor_leave;
  if (change == ContactRule::Change::begin)
    return wall == Wall::none ? EventKind::contact_begin : EventKind::wall_begin;
  return wall == Wall::none ? EventKind::contact_end : EventKind::wall_end;
}

template <class Partner>
double ContactPredictor<Partner>::until_reports() const {
  if (threshold_.is_turned) return now_;
  const bool has_turned = threshold_.within && threshold_.state.approach == ApproachState::turned;
  if (has_turned && wants_approaches(threshold_.wanted)) return now_;
  bool may_begin = !threshold_.within || threshold_.is_watched();
  if constexpr (std::is_same_v<Partner, Bound>)
    may_begin = may_begin && !(threshold_.within && recede_for_good(bound_, partner_, now_));
  double time = may_begin ? meeting(0.0) : infinity;
  if (threshold_.within && time > now_) time = std::min(time, separation(rule_.release_gap()));
  if (time == infinity || time <= now_) return time;
  if constexpr (is_rigid_pair<Partner>)
    if (!threshold_.within)
      return is_beyond(partner_, now_, rule_.tolerance() + threshold_.distance) ? time : now_;
  const GapLimits gap = gap_limits(bound_, partner_, now_);
  const bool far = (!may_begin || gap.lower > rule_.tolerance() + threshold_.distance) &&
                   (!threshold_.within || gap.upper < rule_.separation_distance() + threshold_.distance);
  return far ? time : now_;
}

template <class Partner>
double ContactPredictor<Partner>::meeting(double gap) const {
  const double distance = gap + threshold_.distance;
  if (excess_growth_ == 0.0) return earliest_meeting(bound_, partner_, now_, horizons_.meeting, distance);
  if constexpr (is_rigid_pair<Partner>)
    return earliest_meeting(bound_, partner_.with_less_growth(true_excess(), now_), now_, horizons_.meeting,
                            distance);
  Bound true_growth = bound_;
  true_growth.growth_speed -= true_excess();
  // A body whose state is known without a report at this time stands still.
  true_growth.time = now_;
  return earliest_meeting(true_growth, partner_, now_, horizons_.meeting, distance);
}

/// Upper limit of the speed at which any two points, one fixed in each of two bodies, move relative to each
/// other (length / time), with the rates of radii.
template <class Partner>
double ContactPredictor<Partner>::largest_speed(const RelativeLimits& limits) const {
  if constexpr (is_rigid_pair<Partner>)
    return partner_.relative_speed(now_) + limits.speed_error + limits.radius_rates;
  else if constexpr (has_pieces<Partner>)
    return norm(partner_.beside(bound_, now_).bound.velocity_at(now_)) + limits.speed_error +
           limits.radius_rates;
  else
    return infinity;
}

/// Returns by how much a step of the Zeno guard may sink from this gap (tolerances).
template <class Partner>
double ContactPredictor<Partner>::sinking_from(double gap) const {
  return has_several_points<Partner> ? rule_.sinking_of_several(gap) : ContactRule::most_sinking;
}

/// Returns the time of the next check of a pair that does not approach at its nearest points, and whose
/// certificate fails at `time`: at least the least step of the Zeno guard later. Of several points, others
/// may approach. So the step ends before a point that approaches is as deep as the gap, or any other point
/// deeper by sinking_from(gap); but not before the fastest point can have gone a 64th of the tolerance.
template <class Partner>
double ContactPredictor<Partner>::least_check(double time, double gap, double guarded, double speed_error,
                                              const RelativeLimits& limits) const {
  const double least = now_ + rule_.least_step(gap, speed_error, limits.acceleration, sinking_from(gap));
  if (!(time < least)) return time;
  if constexpr (has_several_points<Partner>) {
    const double sunk = earliest_sinking_below(
        {guarded + threshold_.distance, gap - sinking_from(gap) * rule_.tolerance() + threshold_.distance,
         speed_error},
        least);
    return sunk < least ? std::max({time, sunk, soonest_check(gap, limits)}) : least;
  }
  return least;
}

/// Evaluates earliest_sinking() with the radii as they change. Precondition: the pair has several points.
template <class Partner>
double ContactPredictor<Partner>::earliest_sinking_below(const Sinking& sinking, double until) const {
  if constexpr (is_rigid_pair<Partner>) {
    const auto pair = excess_growth_ == 0.0 ? partner_ : partner_.with_less_growth(true_excess(), now_);
    return earliest_sinking(pair, now_, until, sinking);
  } else if constexpr (has_pieces<Partner>) {
    auto [bound, slack] = partner_.beside(bound_, now_);
    if (excess_growth_ != 0.0) {
      bound.growth_speed -= true_excess();
      bound.time = now_;
    }
    return earliest_sinking(bound, partner_.solid, now_, until,
                            {sinking.approaching + slack, sinking.receding + slack, sinking.speed});
  } else {
    return infinity;
  }
}

/// Returns the earliest time of a next check: just after now or, for several points within the tolerance,
/// when the fastest of them can have gone a 64th of the tolerance.
template <class Partner>
double ContactPredictor<Partner>::soonest_check(double gap, const RelativeLimits& limits) const {
  if constexpr (!has_several_points<Partner>) return just_after(now_);
  return std::max(just_after(now_), now_ + rule_.least_step(gap, largest_speed(limits), limits.acceleration,
                                                            ContactRule::least_sinking));
}

/// Returns a time before which two bodies in touch do not separate, which is later than now by as much as the
/// fastest of their points makes certain.
template <class Partner>
double ContactPredictor<Partner>::separated(double gap, const RelativeLimits& limits) const {
  const double time = separation(rule_.release_gap());
  if constexpr (!has_several_points<Partner>) return time;
  return std::max(time, now_ + rule_.least_time_to_separate(gap, largest_speed(limits), limits.acceleration));
}

template <class Partner>
std::optional<double> ContactPredictor<Partner>::next_check_if_apart() const {
  if (threshold_.within || threshold_.is_turned) return std::nullopt;
  const Vec3 centre = bound_.centre_at(now_);
  double gap = 0.0;
  if constexpr (std::is_same_v<Partner, Bound>) {
    gap = norm(partner_.centre_at(now_) - centre) - (bound_.radius + partner_.radius);
  } else if constexpr (std::is_same_v<Partner, HalfSpace>) {
    gap = dot(partner_.normal, centre) - partner_.offset - bound_.radius;
  } else if constexpr (is_rigid_pair<Partner>) {
    if (!is_beyond(partner_, now_, rule_.tolerance() + threshold_.distance)) return std::nullopt;
    return std::max(meeting(0.0), just_after(now_));
  }
  if (!(gap - threshold_.distance > rule_.tolerance())) return std::nullopt;
  return std::max(meeting(0.0), just_after(now_));
}

/// Decides for two that have been turned back, and are still beyond the distance by this gap, on their way
/// back: it is crossed if they move on. They are looked at again when they are back, or before they are
/// noticeably farther away. Where that is so soon that they get farther in less time, they may.
template <class Partner>
ContactDecision ContactPredictor<Partner>::decide_turned(double beyond, double approach_speed,
                                                         double error) const {
  const bool within = threshold_.within;
  const double onward = within ? -approach_speed : approach_speed;
  if (onward > error) return {.change = within ? ContactRule::Change::end : ContactRule::Change::begin};
  const double tolerance = rule_.tolerance(), farthest = rule_.farthest_turned(threshold_, beyond);
  const double step = (within ? 1.0 : -1.0) * ContactRule::farther * tolerance;
  const auto until = [&](double gap) { return within ? separation(gap) : meeting(gap); };
  const double stay = until(farthest), later = until(farthest + step);
  const double on = later - stay > stay - now_ ? later : stay;
  const double back = within ? meeting(ContactRule::back_inside * tolerance)
                             : separation(ContactRule::back_outside * tolerance);
  return {.next_check = std::max(std::min(on, back), just_after(now_))};
}

template <class Partner>
ContactDecision ContactPredictor<Partner>::decide(const Event& current, const RelativeLimits& limits) const {
  ContactDecision decision;
  const double beyond = current.gap - threshold_.distance;
  const double error = approach_error(current, arm(current.gap)) + rate_error(limits.radius_rates);
  if (threshold_.is_turned) return decide_turned(beyond, current.approach_speed, error);
  decision.change = rule_.decide(threshold_, beyond, current.approach_speed, error);
  if (decision.is_event()) return decision;
  const bool stays = threshold_.within && decision.change != ContactRule::Change::release;
  const double apart = stays ? separated(beyond, limits) : infinity;
  decision.approach = threshold_.state.approach;
  if (stays && decision.approach == ApproachState::turned)
    decision.approach =
        rule_.is_approach(beyond, current.approach_speed, error) || !wants_approaches(threshold_.wanted)
            ? ApproachState::reported
            : ApproachState::watched;
  if (stays && decision.approach != ApproachState::watched) {
    decision.next_check = std::max(apart, just_after(now_));
    return decision;
  }
  // A certificate cannot guard a gap that is closer to the present gap than the certificate's own rounding
  // error. Within the tolerance that can be so, hence the reduction.
  const double gap = beyond > rule_.tolerance() ? beyond : beyond - resolution();
  const double guarded = rule_.guarded_gap(gap);
  double time = meeting(guarded);
  // No certificate guards what cannot be known. Before the two have separated, no other approach begins.
  if (!stays && hides_depth(gap)) time = std::min(time, separated(beyond, limits));
  const double hidden_approach = std::max(current.approach_speed + error, 0.0);
  const double later = least_check(time, beyond, guarded, limits.speed_error + hidden_approach, limits);
  if (time < later) {
    // The Zeno guard: time must advance between two checks of a contact that does not approach.
    time = later;
    decision.zeno_step = true;
    decision.breaks_tolerance = rule_.step_breaks_tolerance(beyond, sinking_from(beyond));
  }
  if (rule_.is_deep(gap)) {
    const double surfaces = separation(rule_.surface_gap());
    // The meeting was searched only up to the horizon, so a separation beyond the horizon does not shorten
    // the time.
    if (surfaces <= horizons_.meeting) time = std::min(time, surfaces);
  }
  decision.next_check = std::max(std::min(time, apart), soonest_check(beyond, limits));
  return decision;
}

template <class Partner>
ContactDecision ContactPredictor<Partner>::defer(const Event& current, const RelativeLimits& limits) const {
  const double beyond = current.gap - threshold_.distance;
  const double speed = limits.speed_error + std::max(current.approach_speed, 0.0);
  const double next_time = least_check(now_, beyond, rule_.guarded_gap(beyond - resolution()), speed, limits);
  return {.next_check = std::max(std::min(next_time, separation(rule_.release_gap())), just_after(now_)),
          .approach = ApproachState::watched,
          .zeno_step = true,
          .breaks_tolerance = rule_.step_breaks_tolerance(beyond, sinking_from(beyond))};
}

/// Length of the vector along the normal, as approach_error() needs it.
template <class Partner>
double ContactPredictor<Partner>::arm(double gap) const {
  if constexpr (std::is_same_v<Partner, Bound>)
    return gap + bound_.radius + partner_.radius;
  else if constexpr (is_rigid_pair<Partner>)
    return arm_of(partner_, gap);
  else
    return std::is_same_v<Partner, HalfSpace> ? infinity : gap + bound_.radius;
}

/// True if the two may be deeper in each other than the gap: hulls do not know how deep they overlap beyond
/// their radii.
template <class Partner>
bool ContactPredictor<Partner>::hides_depth(double gap) const {
  if constexpr (is_rigid_pair<Partner> && !std::is_same_v<Partner, RigidPair<HalfSpace>>) {
    double deepest = -(least_radius(partner_.body.parts) + threshold_.distance);
    if constexpr (requires { partner_.other.parts; }) deepest -= least_radius(partner_.other.parts);
    return gap <= deepest;
  }
  return false;
}

/// Upper bound of the rounding error in the present gap (length).
template <class Partner>
double ContactPredictor<Partner>::resolution() const {
  const GapLimits limits = gap_limits(bound_, partner_, now_);
  const double width = limits.upper - limits.lower;
  // Rounding does not take limits so far apart. These are of an axis that crosses a solid, which no
  // certificate guards at such a depth.
  if (is_rigid_pair<Partner> && width > rule_.tolerance()) return 0.0;
  return 1.25 * width;
}

template class ContactPredictor<Bound>;
template class ContactPredictor<HalfSpace>;
template class ContactPredictor<Placed<Convex>>;
template class ContactPredictor<Placed<Mesh>>;
template class ContactPredictor<Placed<ShapeDifference>>;
template class ContactPredictor<RigidPair<RigidExtent>>;
template class ContactPredictor<RigidPair<HalfSpace>>;
template class ContactPredictor<RigidPair<Placed<Convex>>>;
template class ContactPredictor<RigidPair<Placed<Mesh>>>;

namespace {

Box walls_in_reach(const ContactRule& rule, const BoundAt& bound, const Box& box, double duration) {
  // 1/16 of the tolerance covers rounding, as positions and displacements are at most 2^45 tolerances.
  const double rounding_margin = rule.tolerance() / 16.0;
  return sides_in_reach(bound, box, duration, rule.tolerance() + rounding_margin);
}

}  // namespace

bool recede_for_good(const State& first, const State& second) {
  const Vec3 offset = second.position - first.position;
  const double distance = norm(offset);
  return dot(offset, second.velocity - first.velocity) > approach_error(first, second, distance) * distance;
}

bool recede_for_good(const Bound& a, const Bound& b, double now) {
  if (!a.is_exact() || !b.is_exact() || a.planned_acceleration != b.planned_acceleration) return false;
  return recede_for_good({a.centre_at(now), a.velocity_at(now)}, {b.centre_at(now), b.velocity_at(now)});
}

Box walls_in_reach(const ContactRule& rule, const Bound& bound, const Box& box, double now, double until) {
  return walls_in_reach(rule, BoundAt(bound, now), box, until - now);
}

double until_reports_of_walls(const ContactRule& rule, const Bound& bound, const Box& box, double now,
                              double until) {
  const BoundAt moved(bound, now);
  const Box near = walls_in_reach(rule, moved, box, until - now);
  if (!has_sides(near)) return infinity;
  const double time = earliest_exit(bound, near, now, until);
  if (time == infinity || time <= now) return time;
  // The time is certified in any case. Only the choice whether fresh reports would improve it is subject to
  // rounding.
  const bool far = !has_sides(sides_in_reach(moved, near, 0.0, rule.tolerance()));
  return far ? time : now;
}

}  // namespace kinesphere
