#include "bound/rigid_certificates.hpp"

#include <algorithm>
#include <type_traits>
#include <vector>

#include "bound/reach.hpp"
#include "bound/safe_steps.hpp"
#include "bound/segments.hpp"

namespace kinesphere {
namespace {

/// One part of a rigid body: the bounds of its two ends, which are one if it is a ball.
class PartBound {
 public:
  PartBound(const RigidExtent& body, const RigidPart& part)
      : body_(body), part_(part), a_(body.of_point(part.a, part.radius)) {
    if (!is_ball()) b_ = body.of_point(part.b, part.radius);
  }

  bool is_ball() const { return part_.a == part_.b; }
  const Bound& ball() const { return a_; }
  /// Bound of the point of the axis at this position, from 0 at a to 1 at b.
  Bound at(double position) const {
    return body_.of_point(part_.a + (part_.b - part_.a) * position, part_.radius);
  }
  /// The axis where it is at a time, if its ends go straight on.
  Segment axis(double time) const {
    return {a_.centre_at(time), is_ball() ? a_.centre_at(time) : b_.centre_at(time)};
  }
  template <class Visit>
  void for_each_end(Visit visit) const {
    visit(a_);
    if (!is_ball()) visit(b_);
  }

 private:
  const RigidExtent& body_;
  const RigidPart& part_;
  Bound a_;
  Bound b_{};
};

/// Repeats next(time), which returns a later certain time or +infinity, until a step gains less than an
/// eighth of the total. More steps cost more than the rechecks that they save, as these know the rotation
/// anew.
template <class Next>
double repeated(double from, Next next) {
  double time = from;
  for (int round = 0; round < most_rounds; ++round) {
    const double later = next(time);
    if (later == infinity) return infinity;
    const double gain = later - time;
    time = std::max(time, later);
    if (!(gain > (time - from) * 0.125)) break;
  }
  return time;
}

// Two parts.

/// Nearest points of two axes, if their ends go straight on.
struct NearestPoints {
  NearestOnSegments at;
  Vec3 normal;  ///< unit vector from the second towards the first

  NearestPoints(const PartBound& a, const PartBound& b, double time) {
    const Segment p = a.axis(time);
    const Segment q = b.axis(time);
    at = nearest_on_segments(p, q);
    const Vec3 way = p.at(at.first) - q.at(at.second);
    const double length = norm(way);
    normal = length > 0.0 ? way / length : Vec3{1.0, 0.0, 0.0};
  }
};

/// Calls visit(motion, plane) for each end of one part relative to each end of another, where the plane has
/// the second end on its far side.
template <class Visit>
void for_each_pair_of_ends(const PartBound& a, const PartBound& b, const Vec3& normal, double time,
                           Visit visit) {
  a.for_each_end([&](const Bound& end) {
    b.for_each_end([&](const Bound& other) {
      visit(BoundBesideBound(end, other, time), HalfSpace{normal, 0.0});
    });
  });
}

double meeting(const PartBound& a, const PartBound& b, double from, double until, double distance) {
  if (a.is_ball() && b.is_ball()) return earliest_meeting(a.ball(), b.ball(), from, until, distance);
  return repeated(from, [&](double time) {
    double first = infinity;
    for_each_pair_of_ends(a, b, NearestPoints(a, b, time).normal, time,
                          [&](const BoundBesideBound& motion, const HalfSpace& plane) {
                            first = std::min(first, earliest_meeting(motion.bound, plane, time, until,
                                                                     distance + motion.slack));
                          });
    return first;
  });
}

double separation(const PartBound& a, const PartBound& b, double from, double until, double distance) {
  if (a.is_ball() && b.is_ball()) return earliest_separation(a.ball(), b.ball(), from, until, distance);
  return repeated(from, [&](double time) {
    const NearestOnSegments at = NearestPoints(a, b, time).at;
    return earliest_separation(a.at(at.first), b.at(at.second), time, until, distance);
  });
}

GapLimits gap(const PartBound& a, const PartBound& b, double t) {
  if (a.is_ball() && b.is_ball()) return gap_limits(a.ball(), b.ball(), t);
  const NearestPoints nearest(a, b, t);
  GapLimits limits = gap_limits(a.at(nearest.at.first), b.at(nearest.at.second), t);
  double lower = infinity;
  for_each_pair_of_ends(a, b, nearest.normal, t, [&](const BoundBesideBound& motion, const HalfSpace& plane) {
    lower = std::min(lower, gap_limits(motion.bound, plane, t).lower - motion.slack);
  });
  limits.lower = std::min(limits.lower, lower);
  return limits;
}

// A part and a half-space.

double meeting(const PartBound& a, const HalfSpace& wall, double from, double until, double distance) {
  double first = infinity;
  a.for_each_end(
      [&](const Bound& end) { first = std::min(first, earliest_meeting(end, wall, from, until, distance)); });
  return first;
}

double separation(const PartBound& a, const HalfSpace& wall, double from, double until, double distance) {
  double last = from;
  a.for_each_end([&](const Bound& end) {
    last = std::max(last, earliest_separation(end, wall, from, until, distance));
  });
  return last;
}

GapLimits gap(const PartBound& a, const HalfSpace& wall, double t) {
  GapLimits limits{infinity, infinity};
  a.for_each_end([&](const Bound& end) {
    const GapLimits own = gap_limits(end, wall, t);
    limits = {std::min(limits.lower, own.lower), std::min(limits.upper, own.upper)};
  });
  return limits;
}

// A part and a box or a triangle, at rest or carried.

/// The motion of a bound relative to a solid.
template <class Solid>
BoundBesideBound beside(const Bound& bound, const Solid&, double) {
  return BoundBesideBound(bound);
}
template <class Solid>
BoundBesideBound beside(const Bound& bound, const CarriedShape<Solid>& shape, double time) {
  return {bound, shape.carrier, time, shape.radius};
}
template <class Solid>
const Solid& solid_of(const Solid& solid) {
  return solid;
}
template <class Solid>
const Solid& solid_of(const CarriedShape<Solid>& shape) {
  return shape.solid;
}

/// A part relative to a solid at a time, and the plane between them.
template <class Shape>
struct BesideSolid {
  BoundBesideBound a, b;
  double nearest = 0.0;  ///< position on the axis of its point nearest to the solid
  HalfSpace plane;       ///< has the solid on its far side

  BesideSolid(const PartBound& part, const Shape& shape, double time)
      : a(beside(part.at(0.0), shape, time)), b(beside(part.at(1.0), shape, time)) {
    const auto& solid = solid_of(shape);
    const Segment axis{a.bound.centre_at(time), b.bound.centre_at(time)};
    nearest = nearest_on_segment(axis, solid);
    plane.normal = nearest_point(solid, axis.at(nearest)).normal;
    plane.offset = reach(solid, plane.normal) + rounding::margin * size_of(solid);
  }
};

template <class Shape>
double meeting(const PartBound& part, const Shape& shape, double from, double until, double distance) {
  if (part.is_ball()) return earliest_meeting(part.ball(), shape, from, until, distance);
  return repeated(from, [&](double time) {
    const BesideSolid now(part, shape, time);
    return std::min(earliest_meeting(now.a.bound, now.plane, time, until, distance + now.a.slack),
                    earliest_meeting(now.b.bound, now.plane, time, until, distance + now.b.slack));
  });
}

template <class Shape>
double separation(const PartBound& part, const Shape& shape, double from, double until, double distance) {
  if (part.is_ball()) return earliest_separation(part.ball(), shape, from, until, distance);
  return repeated(from, [&](double time) {
    return earliest_separation(part.at(BesideSolid(part, shape, time).nearest), shape, time, until, distance);
  });
}

template <class Shape>
GapLimits gap(const PartBound& part, const Shape& shape, double t) {
  if (part.is_ball()) return gap_limits(part.ball(), shape, t);
  const BesideSolid now(part, shape, t);
  GapLimits limits = gap_limits(part.at(now.nearest), shape, t);
  for (const BoundBesideBound* end : {&now.a, &now.b})
    limits.lower = std::min(limits.lower, gap_limits(end->bound, now.plane, t).lower - end->slack);
  return limits;
}

// Whole bodies.

/// The ball around a part, or around a whole body, at one time.
struct BallNow {
  const RigidPart* part;
  Vec3 centre;
  Vec3 velocity;
  double radius;        ///< grown up to now
  double speed;         ///< at which it grows
  double acceleration;  ///< of centre and growth
  double size;          ///< sum of the magnitudes of all terms (length)
};

BallNow ball_now(const RigidExtent& body, double time) {
  const Bound& bound = body.bound;
  const double s = time - bound.time;
  return {.part = nullptr,
          .centre = bound.centre_at(time),
          .velocity = bound.velocity_at(time),
          .radius = bound.radius_at(time),
          .speed = bound.growth_speed + bound.acceleration_limit * s,
          .acceleration = bound.acceleration_limit + norm(bound.planned_acceleration),
          .size = norm_one(bound.position) +
                  (norm_one(bound.velocity) + norm_one(bound.planned_acceleration) * s) * s + bound.radius};
}

/// Returns the balls around all parts, as RigidExtent::of_point() gives them for their middles.
std::vector<BallNow> balls_now(const RigidExtent& body, double time) {
  const double s = time - body.bound.time;
  const BallNow whole = ball_now(body, time);
  const double turning = body.spin_growth + body.spin * body.spin;
  std::vector<BallNow> balls;
  balls.reserve(body.parts.size());
  for (const RigidPart& part : body.parts) {
    const bool is_ball = part.a == part.b;
    const Vec3 middle = is_ball ? part.a : 0.5 * (part.a + part.b);
    const Vec3 arm = rotated(body.rotation.orientation, middle);
    const Vec3 turn = cross(body.rotation.angular_velocity, arm);
    const double reach = norm(middle);
    BallNow ball = whole;
    ball.part = &part;
    ball.centre += arm + turn * s;
    ball.velocity += turn;
    ball.radius += part.radius + (is_ball ? 0.0 : 0.5 * norm(part.b - part.a)) - body.radius +
                   0.5 * turning * reach * s * s;
    ball.speed += turning * reach * s;
    ball.acceleration += turning * reach;
    balls.push_back(ball);
  }
  return balls;
}

/// What is certain of the gap between what is in two balls.
struct GapNow {
  double least;    ///< now
  double opening;  ///< rate at which it grows along the line of centres, at least
  double closing;  ///< largest acceleration against that

  GapNow(const BallNow& a, const BallNow& b) {
    constexpr double rounding_lost = 0x1p-40;
    const Vec3 way = a.centre - b.centre;
    const Vec3 turn = a.velocity - b.velocity;
    const double distance = norm(way);
    least = distance - (a.radius + b.radius) - rounding_lost * (a.size + b.size);
    opening = dot(way, turn) / distance - (a.speed + b.speed) - rounding_lost * norm_one(turn);
    closing = (a.acceleration + b.acceleration) * (1.0 + rounding_lost);
  }
  /// Returns true if the gap is larger than `distance` all the time: a concave function is least at an end.
  bool exceeds(double distance, double duration) const {
    return least > distance && least - distance + (opening - 0.5 * closing * duration) * duration > 0.0;
  }
};

/// Returns the ball whose centre is nearest to a point.
const BallNow& nearest_to(const Vec3& point, const std::vector<BallNow>& balls) {
  return *std::min_element(balls.begin(), balls.end(), [&](const BallNow& a, const BallNow& b) {
    return norm_squared(a.centre - point) < norm_squared(b.centre - point);
  });
}

/// Calls visit(part, other) for pairs of parts, a pair that is near first. Leaves out those for which
/// skips(gap) is true of their GapNow.
template <class Skips, class Visit>
void for_each_part(const RigidPair<RigidExtent>& pair, double time, Skips skips, Visit visit) {
  const std::vector<BallNow> own = balls_now(pair.body, time);
  const std::vector<BallNow> others = balls_now(pair.other, time);
  const BallNow all_others = ball_now(pair.other, time);
  const auto is_skipped = [&](const BallNow& a, const BallNow& b) { return skips(GapNow(a, b)); };
  const auto consider = [&](const BallNow& a, const BallNow& b) {
    if (!is_skipped(a, b)) visit(PartBound(pair.body, *a.part), PartBound(pair.other, *b.part));
  };
  const BallNow& first = nearest_to(all_others.centre, own);
  const BallNow& second = nearest_to(first.centre, others);
  consider(first, second);
  for (const BallNow& a : own) {
    if (others.size() > 1 && is_skipped(a, all_others)) continue;
    for (const BallNow& b : others)
      if (&a != &first || &b != &second) consider(a, b);
  }
}

/// Calls visit(part, partner) for each part of the body.
template <class Other, class Skips, class Visit>
void for_each_part(const RigidPair<Other>& pair, double, Skips, Visit visit) {
  for (const RigidPart& part : pair.body.parts) visit(PartBound(pair.body, part), pair.other);
}

/// Earliest meeting from what is known at the time of the reports.
template <class Other>
double meeting(const RigidPair<Other>& pair, double from, double until, double distance) {
  double start = from;
  // Before the balls around two bodies meet, the parts inside do not.
  if constexpr (std::is_same_v<Other, RigidExtent>)
    start = earliest_meeting(pair.body.bound, pair.other.bound, from, until, distance);
  double first = infinity;
  if (start == infinity) return first;
  // Meetings later than the first one so far do not matter.
  const auto limit = [&] { return std::min(first, until); };
  for_each_part(
      pair, start,
      [&](const GapNow& gap) { return start >= limit() || gap.exceeds(distance, limit() - start); },
      [&](const PartBound& part, const auto& partner) {
        first = std::min(first, meeting(part, partner, start, limit(), distance));
      });
  return first;
}

}  // namespace

template <class Other>
double earliest_meeting(const Bound&, const RigidPair<Other>& pair, double from, double until,
                        double distance) {
  double time = meeting(pair, from, until, distance);
  if (!pair.is_exact()) return time;
  // Where the two will be is known, so that the next step needs no report.
  double gain = time - from;
  for (int round = 1; round < most_rounds && time < infinity; ++round) {
    if (!(gain > (time - from) * negligible_gain)) break;
    const double next = meeting(pair.at(time), time, until, distance);
    gain = next - time;
    time = next;
  }
  return time;
}

template <class Other>
double earliest_separation(const Bound&, const RigidPair<Other>& pair, double from, double until,
                           double distance) {
  double last = from;
  for_each_part(
      pair, from, [&](const GapNow& gap) { return last == infinity || gap.least > distance; },
      [&](const PartBound& part, const auto& partner) {
        last = std::max(last, separation(part, partner, from, until, distance));
      });
  return last;
}

template <class Other>
GapLimits gap_limits(const Bound&, const RigidPair<Other>& pair, double t) {
  GapLimits limits{infinity, infinity};
  for_each_part(
      pair, t, [&](const GapNow& gap) { return gap.least > limits.upper; },
      [&](const PartBound& part, const auto& partner) {
        const GapLimits own = gap(part, partner, t);
        limits = {std::min(limits.lower, own.lower), std::min(limits.upper, own.upper)};
      });
  return limits;
}

#define KINESPHERE_RIGID_PAIR(Other)                                                                  \
  template double earliest_meeting(const Bound&, const RigidPair<Other>&, double, double, double);    \
  template double earliest_separation(const Bound&, const RigidPair<Other>&, double, double, double); \
  template GapLimits gap_limits(const Bound&, const RigidPair<Other>&, double);
KINESPHERE_RIGID_PAIR(RigidExtent)
KINESPHERE_RIGID_PAIR(HalfSpace)
KINESPHERE_RIGID_PAIR(Box)
KINESPHERE_RIGID_PAIR(Triangle)
KINESPHERE_RIGID_PAIR(CarriedShape<Box>)
KINESPHERE_RIGID_PAIR(CarriedShape<Triangle>)
#undef KINESPHERE_RIGID_PAIR

}  // namespace kinesphere
