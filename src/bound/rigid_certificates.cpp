#include "bound/rigid_certificates.hpp"

#include <algorithm>

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

/// Repeats next(time), which returns a later certain time or +infinity, until it gains little.
template <class Next>
double repeated(double from, Next next) {
  double time = from;
  for (int round = 0; round < most_rounds; ++round) {
    const double later = next(time);
    if (later == infinity) return infinity;
    const double gain = later - time;
    time = std::max(time, later);
    if (!(gain > (time - from) * negligible_gain)) break;
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

/// Calls visit(part, partner) for each part of the body, with each part of a partner that is a rigid body, or
/// else with the partner.
template <class Other, class Visit>
void for_each_part(const RigidPair<Other>& pair, Visit visit) {
  for (const RigidPart& own : pair.body.parts) {
    const PartBound part(pair.body, own);
    if constexpr (std::is_same_v<Other, RigidExtent>) {
      for (const RigidPart& other : pair.other.parts) visit(part, PartBound(pair.other, other));
    } else {
      visit(part, pair.other);
    }
  }
}

}  // namespace

template <class Other>
double earliest_meeting(const Bound&, const RigidPair<Other>& pair, double from, double until,
                        double distance) {
  double start = from;
  // Before the balls around two bodies meet, the parts inside do not.
  if constexpr (std::is_same_v<Other, RigidExtent>)
    start = earliest_meeting(pair.body.bound, pair.other.bound, from, until, distance);
  double first = infinity;
  if (start == infinity) return first;
  for_each_part(pair, [&](const PartBound& part, const auto& partner) {
    // Later meetings than the first one so far do not matter.
    const double limit = std::min(first, until);
    if (start <= limit) first = std::min(first, meeting(part, partner, start, limit, distance));
  });
  return first;
}

template <class Other>
double earliest_separation(const Bound&, const RigidPair<Other>& pair, double from, double until,
                           double distance) {
  double last = from;
  for_each_part(pair, [&](const PartBound& part, const auto& partner) {
    if (last < infinity) last = std::max(last, separation(part, partner, from, until, distance));
  });
  return last;
}

template <class Other>
GapLimits gap_limits(const Bound&, const RigidPair<Other>& pair, double t) {
  GapLimits limits{infinity, infinity};
  for_each_part(pair, [&](const PartBound& part, const auto& partner) {
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
