#include "bound/rigid_certificates.hpp"

#include <algorithm>
#include <type_traits>
#include <vector>

#include "bound/all_turns.hpp"
#include "bound/convex.hpp"
#include "bound/hull_distance.hpp"
#include "bound/mesh_tree.hpp"
#include "bound/part_pairs.hpp"
#include "bound/reach.hpp"
#include "bound/rigid_part.hpp"
#include "bound/safe_steps.hpp"
#include "bound/segments.hpp"
#include "bound/witness.hpp"

namespace kinesphere {
namespace {

/// One part of a rigid body: the bounds of its points, which are one if it is a ball.
class PartBound {
 public:
  PartBound(const RigidExtent& body, const RigidPart& part) : body_(body), part_(part), a_(of_point(part.a)) {
    if (!is_ball()) b_ = of_point(part.b);
    if (is_hull()) add_more();
  }

  /// True if the body flies and turns exactly as reported.
  bool is_exact() const { return body_.is_exact(); }
  bool is_foreseen() const { return body_.is_foreseen; }
  bool is_ball() const { return kinesphere::is_ball(part_); }
  bool is_hull() const { return kinesphere::is_hull(part_); }
  const RigidPart& part() const { return part_; }
  const Bound& ball() const { return a_; }
  /// Bound of one of the points of the part.
  const Bound& point(std::size_t number) const {
    return number == 0 ? a_ : number == 1 ? b_ : more_[number - 2];
  }
  /// Bound of the ball around the part.
  Bound around() const {
    const PartBall& ball = body_.balls[static_cast<std::size_t>(&part_ - body_.parts.data())];
    return body_.of_point(ball.middle, ball.radius * (1.0 + 0x1p-40));
  }
  /// Largest radius that the part may have at a time, if its radius changes.
  double largest_radius(double time) const {
    const double growth = body_.bound.growth_speed * (time - body_.bound.time);
    return (part_.radius + growth) * (1.0 + rounding::margin);
  }
  /// Bound of a point that is fixed in the part.
  Bound of_point(const Vec3& point) const { return body_.of_point(point, part_.radius); }
  /// The axis of a ball or capsule, or the points of a hull, where they are at a time if they go straight on,
  /// relative to an origin.
  LineSegment axis(double time, const Vec3& origin = {}) const {
    const Vec3 a = a_.centre_at(time) - origin;
    return {a, is_ball() ? a : b_.centre_at(time) - origin};
  }
  std::vector<Vec3> points(double time, const Vec3& origin = {}) const {
    std::vector<Vec3> found;
    found.reserve(point_count(part_));
    for_each_point([&](const Bound& point) { found.push_back(point.centre_at(time) - origin); });
    return found;
  }
  template <class Visit>
  void for_each_point(Visit visit) const {
    visit(a_);
    if (!is_ball()) visit(b_);
    for (const Bound& point : more_) visit(point);
  }

 private:
  [[gnu::noinline]] void add_more() {
    more_.reserve(part_.more.size());
    for (const Vec3& point : part_.more) more_.push_back(of_point(point));
  }

  const RigidExtent& body_;
  const RigidPart& part_;
  Bound a_;
  Bound b_{};
  std::vector<Bound> more_;
};

/// Repeats next(time), which returns a later certain time or +infinity, until a step gains less than an
/// eighth of the total. More steps cost more than the rechecks that they save, as these know the rotation
/// anew.
template <class Next>
double repeated(double from, Next next, int rounds = most_rounds) {
  double time = from;
  for (int round = 0; round < rounds; ++round) {
    const double later = next(time);
    if (later == infinity) return infinity;
    const double gain = later - time;
    time = std::max(time, later);
    if (!(gain > (time - from) * 0.125)) break;
  }
  return time;
}

// Two parts.

/// Returns the point of a capsule's axis at a position, from 0 at a to 1 at b.
Vec3 on_axis(const PartBound& part, double position) {
  return part.part().a + (part.part().b - part.part().a) * position;
}

/// Nearest points of two axes, if their ends go straight on.
struct NearestPoints {
  Vec3 first, second;  ///< fixed in the bodies
  Vec3 normal;         ///< unit vector from the second towards the first

  NearestPoints(const PartBound& a, const PartBound& b, double time) {
    const LineSegment p = a.axis(time);
    const LineSegment q = b.axis(time);
    const NearestOnSegments at = nearest_on_segments(p, q);
    first = on_axis(a, at.first);
    second = on_axis(b, at.second);
    const Vec3 way = p.at(at.first) - q.at(at.second);
    const double length = norm(way);
    normal = length > 0.0 ? way / length : Vec3{1.0, 0.0, 0.0};
  }
};

bool is_hull(const PartBound& a, const PartBound& b) { return a.is_hull() || b.is_hull(); }

NearestInHulls nearest_of(const PartBound& a, const PartBound& b, double time) {
  return nearest_in_hulls(a.points(time), b.points(time));
}

Witness witness_of(const PartBound& a, const PartBound& b, const NearestInHulls& nearest, double time) {
  Witness witness(time);
  for (std::size_t k = 0; k < nearest.count; ++k) {
    const auto& [first, second, weight] = nearest.pairs[k];
    witness.add(a.point(first), b.point(second), 0.0, weight);
  }
  return witness;
}

/// How far along a direction the points of a part reach back at two times, less what they may have grown.
class PointsAlong {
 public:
  PointsAlong(const PartBound& part, const Vec3& direction, double time) : direction_(direction) {
    part.for_each_point([&](const Bound& point) {
      points_.push_back({&point, along(point, time), infinity});
      if (!least_.bound || points_.back().from < least_.from) least_ = points_.back();
      straightest_ = std::min(straightest_, point.acceleration_limit);
    });
  }

  const Bound& foremost() const { return *least_.bound; }
  double least() const { return least_.from; }
  /// Adds a later time.
  void look_at(double time) {
    for (Point& point : points_) {
      point.until = along(*point.bound, time);
      least_.until = std::min(least_.until, point.until);
      size_ = std::max(size_, size_at(*point.bound, time));
    }
  }
  /// Rate at which the speed of any point along the direction may grow, at most.
  double bend() const { return dot(direction_, points_.front().bound->planned_acceleration) - straightest_; }
  double size() const { return size_; }
  /// Returns the points that may be within `distance` of the others at any time between the two. The sum of
  /// two points is a concave function, which is least at an end, up to what `distance` has for its bend.
  std::vector<const Bound*> within(double distance, const PointsAlong& others) const {
    std::vector<const Bound*> found;
    for (const Point& point : points_)
      if (!(point.from + others.least_.from > distance && point.until + others.least_.until > distance))
        found.push_back(point.bound);
    return found;
  }

 private:
  struct Point {
    const Bound* bound = nullptr;
    double from = infinity, until = infinity;
  };

  double along(const Bound& point, double time) const {
    return dot(direction_, point.centre_at(time)) - point.radius_at(time);
  }
  static double size_at(const Bound& point, double time) {
    const double s = time - point.time;
    return norm_one(point.position) +
           (norm_one(point.velocity) + norm_one(point.planned_acceleration) * s) * s + point.radius_at(time);
  }

  Vec3 direction_;
  std::vector<Point> points_;
  Point least_;
  double straightest_ = infinity;
  double size_ = 0.0;
};

/// Calls visit(point, other) for pairs of points of two parts that may be the first to be within `distance`
/// along a direction, or are the nearest now. `visit` returns up to when a pair would be the first.
template <class Visit>
void for_each_pair_of_points(const PartBound& a, const PartBound& b, const Vec3& normal, double time,
                             double distance, Visit visit) {
  if (!is_hull(a, b)) {
    a.for_each_point([&](const Bound& p) { b.for_each_point([&](const Bound& q) { visit(p, q); }); });
    return;
  }
  PointsAlong own(a, normal, time);
  PointsAlong others(b, -normal, time);
  const double until = visit(own.foremost(), others.foremost());
  own.look_at(until);
  others.look_at(until);
  const double bend = std::max(own.bend() + others.bend(), 0.0) * (until - time) * (until - time) / 8.0;
  const double limit =
      std::max(distance, own.least() + others.least()) + bend + 0x1p-40 * (own.size() + others.size());
  const auto near = own.within(limit, others);
  for (const Bound* q : others.within(limit, own))
    for (const Bound* p : near) visit(*p, *q);
}

/// Returns the time before which no points of two parts come within `distance` along a direction.
double meeting_along(const PartBound& a, const PartBound& b, const Vec3& normal, double time, double until,
                     double distance) {
  const HalfSpace plane{normal, 0.0};
  double first = infinity;
  for_each_pair_of_points(a, b, normal, time, distance, [&](const Bound& p, const Bound& q) {
    const BoundBesideBound motion(p, q, time);
    const double limit = std::min(first, until);
    first = std::min(first, earliest_meeting(motion.bound, plane, time, limit, distance + motion.slack));
    return std::min(first, until);
  });
  return first;
}

/// Hulls do not know how deep they overlap: a smaller distance than minus their radii is met when they begin
/// to overlap and, by those that do so already, never.
double meeting_of_hulls(const PartBound& a, const PartBound& b, double from, double until, double distance) {
  // The exact rotation after one step is worth more than further steps.
  const int rounds = a.is_exact() && b.is_exact() ? 1 : most_rounds;
  const double deepest = -(a.part().radius + b.part().radius);
  const auto next = [&](double time) {
    const NearestInHulls nearest = nearest_of(a, b, time);
    if (distance < deepest && time == from && !a.is_foreseen() && nearest.overlap()) return infinity;
    return meeting_along(a, b, nearest.normal, time, until, std::max(distance, deepest));
  };
  return repeated(from, next, rounds);
}

double meeting(const PartBound& a, const PartBound& b, double from, double until, double distance) {
  if (a.is_ball() && b.is_ball()) return earliest_meeting(a.ball(), b.ball(), from, until, distance);
  if (is_hull(a, b)) return meeting_of_hulls(a, b, from, until, distance);
  return repeated(from, [&](double time) {
    return meeting_along(a, b, NearestPoints(a, b, time).normal, time, until, distance);
  });
}

double separation(const PartBound& a, const PartBound& b, double from, double until, double distance) {
  if (a.is_ball() && b.is_ball()) return earliest_separation(a.ball(), b.ball(), from, until, distance);
  return repeated(from, [&](double time) {
    if (is_hull(a, b)) return witness_of(a, b, nearest_of(a, b, time), time).separation(until, distance);
    const NearestPoints nearest(a, b, time);
    return earliest_separation(a.of_point(nearest.first), b.of_point(nearest.second), time, until, distance);
  });
}

/// Lower limit of the gap of two parts, from their points along a direction.
double least_gap(const PartBound& a, const PartBound& b, const Vec3& normal, double t) {
  double least = infinity;
  for_each_pair_of_points(a, b, normal, t, -infinity, [&](const Bound& p, const Bound& q) {
    const BoundBesideBound motion(p, q, t);
    least = std::min(least, gap_limits(motion.bound, HalfSpace{normal, 0.0}, t).lower - motion.slack);
    return t;
  });
  return least;
}

GapLimits gap(const PartBound& a, const PartBound& b, double t) {
  if (a.is_ball() && b.is_ball()) return gap_limits(a.ball(), b.ball(), t);
  if (is_hull(a, b)) {
    const NearestInHulls nearest = nearest_of(a, b, t);
    const double upper = witness_of(a, b, nearest, t).largest_gap();
    const double deepest = -(a.largest_radius(t) + b.largest_radius(t));
    const double lower = std::max(least_gap(a, b, nearest.normal, t), deepest);
    return {std::min(lower, upper), upper};
  }
  const NearestPoints nearest(a, b, t);
  GapLimits limits = gap_limits(a.of_point(nearest.first), b.of_point(nearest.second), t);
  limits.lower = std::min(limits.lower, least_gap(a, b, nearest.normal, t));
  return limits;
}

// A part and a half-space.

double meeting(const PartBound& a, const HalfSpace& wall, double from, double until, double distance) {
  double first = infinity;
  a.for_each_point(
      [&](const Bound& end) { first = std::min(first, earliest_meeting(end, wall, from, until, distance)); });
  return first;
}

double separation(const PartBound& a, const HalfSpace& wall, double from, double until, double distance) {
  double last = from;
  a.for_each_point([&](const Bound& end) {
    last = std::max(last, earliest_separation(end, wall, from, until, distance));
  });
  return last;
}

GapLimits gap(const PartBound& a, const HalfSpace& wall, double t) {
  GapLimits limits{infinity, infinity};
  a.for_each_point([&](const Bound& end) {
    const GapLimits own = gap_limits(end, wall, t);
    limits = {std::min(limits.lower, own.lower), std::min(limits.upper, own.upper)};
  });
  return limits;
}

// A part and a convex solid.

/// A capsule or a hull and a solid at a time: nearest points and the direction between them.
struct PartBesideSolid {
  const PartBound& part;
  const Placed<Convex>& shape;
  double time;
  Corners corners;
  NearestInHulls nearest;

  PartBesideSolid(const PartBound& given, const Placed<Convex>& partner, double at)
      : part(given), shape(partner), time(at) {
    const auto points = part.points(time, shape.origin(time));
    corners = corners_near(points, shape.solid);
    nearest = nearest_in_hulls(points, corners.all());
  }
  Witness witness() const {
    Witness found(time);
    for (std::size_t k = 0; k < nearest.count; ++k) {
      const auto& [first, second, weight] = nearest.pairs[k];
      found.add(part.point(first), shape.of_point(corners.all()[second], time), shape.radius, weight);
    }
    return found;
  }
  /// Bound of the nearest point, fixed in the part.
  Bound nearest_bound() const {
    return part.of_point(nearest.in_first([&](std::size_t k) { return point_of(part.part(), k); }));
  }
};

/// Each step lasts until a point of the part comes within `distance` of a plane with the solid behind it.
/// Parts do not know how deep they reach into a solid: see meeting_of_hulls().
double meeting(const PartBound& part, const Placed<Convex>& shape, double from, double until,
               double distance) {
  if (part.is_ball()) return earliest_meeting(part.ball(), shape, from, until, distance);
  const double deepest = -part.part().radius;
  return repeated(from, [&](double time) {
    const NearestInHulls nearest = PartBesideSolid(part, shape, time).nearest;
    if (distance < deepest && time == from && !part.is_foreseen() && nearest.overlap()) return infinity;
    const HalfSpace plane = supporting_plane(shape.solid, nearest.normal);
    double first = infinity;
    part.for_each_point([&](const Bound& point) {
      const auto [motion, slack] = shape.beside(point, time);
      first =
          std::min(first, earliest_meeting(motion, plane, time, until, std::max(distance, deepest) + slack));
    });
    return first;
  });
}

/// A point that is fixed in a part may leave at once a solid that the part goes on to cross; witnesses slide
/// along the part.
double separation(const PartBound& part, const Placed<Convex>& shape, double from, double until,
                  double distance) {
  if (part.is_ball()) return earliest_separation(part.ball(), shape, from, until, distance);
  return repeated(from, [&](double time) {
    const PartBesideSolid now(part, shape, time);
    const double fixed = earliest_separation(now.nearest_bound(), shape, time, until, distance);
    return fixed < infinity ? std::max(fixed, now.witness().separation(until, distance)) : fixed;
  });
}

GapLimits gap(const PartBound& part, const Placed<Convex>& shape, double t) {
  if (part.is_ball()) return gap_limits(part.ball(), shape, t);
  const PartBesideSolid now(part, shape, t);
  const HalfSpace plane = supporting_plane(shape.solid, now.nearest.normal);
  double least = infinity;
  part.for_each_point([&](const Bound& point) {
    const auto [motion, slack] = shape.beside(point, t);
    least = std::min(least, gap_limits(motion, plane, t).lower - slack);
  });
  const double upper = now.witness().largest_gap();
  return {std::min(std::max(least, -part.largest_radius(t)), upper), upper};
}

// A part and a mesh: its triangles, but those whose boxes the ball around the part does not reach.

double meeting(const PartBound& part, const Placed<Mesh>& mesh, double from, double until, double distance) {
  if (part.is_ball()) return earliest_meeting(part.ball(), mesh, from, until, distance);
  const Bound around = part.around();
  // A hull meets at smaller distances when it begins to overlap.
  const double reached = std::max(distance, -part.part().radius);
  double first = infinity;
  const auto limit = [&] { return std::min(first, until); };
  tree_of(mesh.solid)
      .search(
          [&](const Box& box) { return earliest_meeting(around, mesh.with(box), from, limit(), reached); },
          limit,
          [&](std::uint32_t, const Convex& triangle) {
            first = std::min(first, meeting(part, mesh.with(triangle), from, limit(), distance));
            return first > from;
          });
  return first;
}

/// Calls visit(gap, triangle) for triangles that may be the nearest, with limits of their gaps.
template <class Visit>
void for_each_near_triangle(const PartBound& part, const Placed<Mesh>& mesh, double t, Visit visit) {
  const Bound around = part.around();
  double least = infinity;
  tree_of(mesh.solid)
      .search([&](const Box& box) { return gap_limits(around, mesh.with(box), t).lower; },
              [&] { return least; },
              [&](std::uint32_t, const Convex& triangle) {
                const GapLimits own = gap(part, mesh.with(triangle), t);
                least = std::min(least, own.upper);
                visit(own, triangle);
                return true;
              });
}

double separation(const PartBound& part, const Placed<Mesh>& mesh, double from, double until,
                  double distance) {
  if (part.is_ball()) return earliest_separation(part.ball(), mesh, from, until, distance);
  return repeated(from, [&](double time) {
    Convex nearest = mesh.solid.triangle(0);
    double least = infinity;
    for_each_near_triangle(part, mesh, time, [&](const GapLimits& own, const Convex& triangle) {
      if (own.upper < least) nearest = triangle;
      least = std::min(least, own.upper);
    });
    return separation(part, mesh.with(nearest), time, until, distance);
  });
}

GapLimits gap(const PartBound& part, const Placed<Mesh>& mesh, double t) {
  if (part.is_ball()) return gap_limits(part.ball(), mesh, t);
  GapLimits limits{infinity, infinity};
  for_each_near_triangle(part, mesh, t, [&](const GapLimits& own, const Convex&) {
    limits = {std::min(limits.lower, own.lower), std::min(limits.upper, own.upper)};
  });
  return limits;
}

// Whole bodies.

/// Calls visit(part, partner) for each part of the body, until it returns false.
template <class Other, class Skips, class Visit>
void for_each_part(const RigidPair<Other>& pair, double, PartPair, Skips, Visit visit) {
  for (const RigidPart& part : pair.body.parts)
    if (!visit(PartBound(pair.body, part), pair.other)) return;
}

/// Does the same without parts for which skips(gap) is true (part_pairs.hpp).
template <class Skips, class Visit>
void for_each_part(const RigidPair<HalfSpace>& pair, double time, PartPair first, Skips skips, Visit visit) {
  for_each_part_towards(pair.body, pair.other, time, first, skips,
                        [&](const RigidPart& part) { return visit(PartBound(pair.body, part), pair.other); });
}

/// Calls visit(part, other) for pairs of parts, in the same way.
template <class Skips, class Visit>
void for_each_part(const RigidPair<RigidExtent>& pair, double time, PartPair first, Skips skips,
                   Visit visit) {
  for_each_part_pair(pair.body, pair.other, time, first, skips, [&](const RigidPart& a, const RigidPart& b) {
    return visit(PartBound(pair.body, a), PartBound(pair.other, b));
  });
}

PartPair parts_of(const PartBound& own, const PartBound& other) { return {&own.part(), &other.part()}; }
template <class Other>
PartPair parts_of(const PartBound& own, const Other&) {
  return {&own.part()};
}

double meeting_of(const RigidPair<RigidExtent>& pair, const PartPair& parts, double from, double until,
                  double distance) {
  return meeting(PartBound(pair.body, *parts.own), PartBound(pair.other, *parts.other), from, until,
                 distance);
}
template <class Other>
double meeting_of(const RigidPair<Other>& pair, const PartPair& parts, double from, double until,
                  double distance) {
  return meeting(PartBound(pair.body, *parts.own), pair.other, from, until, distance);
}

/// The earliest meeting of two bodies, step by step.
struct FirstParts {
  PartPair parts{};          ///< that may meet first
  double others = infinity;  ///< before which no others meet
};

/// Earliest meeting from what is known at the time of the reports. Begins with `known`, the parts that would
/// have met first before, and replaces them by those that do now.
template <class Other>
double meeting(const RigidPair<Other>& pair, double from, double until, double distance, FirstParts& known) {
  double start = from;
  // Before the balls around two bodies meet, the parts inside do not.
  if constexpr (std::is_same_v<Other, RigidExtent>)
    start = earliest_meeting(pair.body.bound, pair.other.bound, from, until, distance);
  double first = infinity;
  if (start == infinity) return first;
  // Other parts are asked for somewhat longer than until the first meeting so far, so that the next steps
  // need not ask them again.
  const auto limit = [&] { return std::min(until, first + 0.125 * (first - start)); };
  double others = infinity;
  for_each_part(
      pair, start, known.parts, [&](const GapNow& gap) { return gap.exceeds(distance, limit() - start); },
      [&](const PartBound& part, const auto& partner) {
        const double time = meeting(part, partner, start, limit(), distance);
        others = std::min(others, std::max(first, time));
        if (time < first) known.parts = parts_of(part, partner);
        first = std::min(first, time);
        return first > start;
      });
  known.others = std::min(others, limit());
  return first;
}

/// Returns the pair as it is at a time, if that is certain, or else as it was reported.
template <class Other>
RigidPair<Other> foreseen(const RigidPair<Other>& pair, double time) {
  return pair.is_exact() ? pair.at(time) : pair;
}

/// Returns the largest angle (radians) by which one of the two keeps turning about the same axis.
template <class Other>
double turned_about_an_axis(const RigidPair<Other>& pair, double duration) {
  const auto of = [&](const RigidExtent& body) {
    return body.spin_growth == 0.0 && body.spin > 0.0 ? body.spin * duration : 0.0;
  };
  if constexpr (std::is_same_v<Other, RigidExtent>)
    return std::max(of(pair.body), of(pair.other));
  else
    return of(pair.body);
}
/// Turns (radians) up to the horizon beyond which certificates of all turns are worth their cost.
constexpr double many_turns = 64.0;

template <class Other>
double earliest_meeting_in_steps(const RigidPair<Other>& pair, double from, double until, double distance) {
  FirstParts first;
  double time = meeting(foreseen(pair, from), from, until, distance, first);
  if (!pair.is_exact()) return time;
  // Where the two will be is known, so that the next step needs no report.
  double gain = time - from;
  double last = gain;
  for (int round = 1; round < most_rounds && time < infinity; ++round) {
    // The next step gains less than this one by the same factor or more, as this one did.
    if (!(gain * gain > last * (time - from) * negligible_gain)) break;
    const RigidPair<Other> then = pair.at(time);
    const bool is_near = time < first.others && (round == 1 || gain * gain < last * (first.others - time));
    const double next = is_near ? meeting_of(then, first.parts, time, until, distance)
                                : meeting(then, time, until, distance, first);
    if (is_near && next > first.others) {
      time = first.others;
      continue;
    }
    last = gain;
    gain = next - time;
    time = next;
  }
  return time;
}

// Points that sink.

/// A direction between two parts that turns at a constant rate: it is `normal + turn s`, with `s` the time
/// from `from` on, up to `until`.
struct TurningDirection {
  Vec3 normal;  ///< unit vector from the second part towards the first
  Vec3 turn{};  ///< normal to it (1 / time)
  double from;
  double until;

  /// Returns the time before which a point, of which this is the motion relative to a point of the other
  /// part, keeps its distance, or `until`. The motion is projected onto the direction: with P, V and G the
  /// position, velocity and plan of the point, and N and M normal and turn, its distance is at least
  ///   N P + (N V + M P) s + (N G / 2 + M V) s^2 + M G s^3 / 2
  /// over the length of N + M s, which is at most 1 + M^2 s^2 / 2.
  double first_crossing(BoundBesideBound motion, const Sinking& sinking) const {
    Bound& bound = motion.bound;
    const double duration = until - from;
    const double along = dot(turn, bound.position);
    const double closing = bound.growth_speed - dot(normal, bound.velocity) - along;
    const double distance = (closing > sinking.speed ? sinking.approaching : sinking.receding) + motion.slack;
    if (turn != Vec3{}) {
      const double turned = norm_one(turn);
      const double kept = std::max(bound.radius + distance, 0.0) +
                          (bound.growth_speed + 0.5 * bound.acceleration_limit * duration) * duration;
      bound.acceleration_limit += turned * norm_one(bound.planned_acceleration) * duration +
                                  norm_squared(turn) * kept * (1.0 + rounding::margin) +
                                  rounding::margin * 4.0 * turned * norm_one(bound.velocity);
      bound.growth_speed += rounding::margin * 2.0 * turned * norm_one(bound.position);
      bound.planned_acceleration += normal * (2.0 * dot(turn, bound.velocity));
      bound.velocity += normal * along;
    }
    return std::min(until, earliest_meeting(bound, HalfSpace{normal, 0.0}, from, until, distance));
  }
};

/// Returns the turn of the normal with which the points that are nearest now stay equally far along it: the
/// direction stays normal to the edges and faces that are nearest.
Vec3 turn_with(const NearestInHulls& nearest, const std::array<BoundBesideBound, 4>& motions) {
  const Vec3& n = nearest.normal;
  const auto way = [&](std::size_t k) {
    const Vec3 d = motions[k].bound.position - motions[0].bound.position;
    return d - n * dot(n, d);
  };
  const auto rate = [&](std::size_t k) {
    return -dot(n, motions[k].bound.velocity - motions[0].bound.velocity);
  };
  Vec3 turn;
  if (nearest.count == 2) {
    turn = way(1) * (rate(1) / norm_squared(way(1)));
  } else if (nearest.count == 3) {
    const Vec3 u = way(1);
    const Vec3 v = way(2);
    const double uu = norm_squared(u), vv = norm_squared(v), uv = dot(u, v);
    const double determinant = uu * vv - uv * uv;
    turn =
        u * ((rate(1) * vv - rate(2) * uv) / determinant) + v * ((rate(2) * uu - rate(1) * uv) / determinant);
    turn -= n * dot(n, turn);
  }
  return std::isfinite(norm_one(turn)) ? turn : Vec3{};
}

/// Two parts, or a part and a solid: their points, how these move relative to each other, and which are
/// nearest. `motion(k, j)` returns that of two points.
template <class Motion>
double sinking_of(const NearestInHulls& nearest, std::size_t first_count, std::size_t second_count,
                  double deepest, double from, double until, const Sinking& sinking, Motion motion) {
  if (nearest.overlap()) return until;
  const Sinking kept{std::max(sinking.approaching, deepest), sinking.receding, sinking.speed};
  const auto along = [&](const Vec3& turn) {
    double first = until;
    for (std::size_t k = 0; k < first_count; ++k)
      for (std::size_t j = 0; j < second_count && first > from; ++j)
        first = TurningDirection{nearest.normal, turn, from, first}.first_crossing(motion(k, j), kept);
    return first;
  };
  const double fixed = along({});
  if (fixed == until || nearest.count < 2) return fixed;
  std::array<BoundBesideBound, 4> motions{BoundBesideBound{Bound{}}, BoundBesideBound{Bound{}},
                                          BoundBesideBound{Bound{}}, BoundBesideBound{Bound{}}};
  for (std::size_t k = 0; k < nearest.count; ++k)
    motions[k] = motion(nearest.pairs[k].first, nearest.pairs[k].second);
  return std::max(fixed, along(turn_with(nearest, motions)));
}

double sinking_of(const PartBound& a, const PartBound& b, double from, double until, const Sinking& sinking) {
  return sinking_of(
      nearest_of(a, b, from), point_count(a.part()), point_count(b.part()),
      -(a.part().radius + b.part().radius), from, until, sinking,
      [&](std::size_t k, std::size_t j) { return BoundBesideBound(a.point(k), b.point(j), from); });
}

double sinking_of(const PartBound& part, const HalfSpace& wall, double from, double until,
                  const Sinking& sinking) {
  double first = until;
  part.for_each_point([&](const Bound& point) {
    BoundBesideBound motion(point);
    motion.slack = wall.offset;
    first = TurningDirection{wall.normal, {}, from, first}.first_crossing(motion, sinking);
  });
  return first;
}

double sinking_of(const PartBound& part, const Placed<Convex>& shape, double from, double until,
                  const Sinking& sinking) {
  const PartBesideSolid now(part, shape, from);
  return sinking_of(now.nearest, point_count(part.part()), now.corners.all().size(), -part.part().radius,
                    from, until, sinking, [&](std::size_t k, std::size_t j) {
                      return BoundBesideBound(part.point(k), shape.of_point(now.corners.all()[j], from), from,
                                              shape.radius);
                    });
}

double sinking_of(const PartBound& part, const Placed<Mesh>& mesh, double from, double until,
                  const Sinking& sinking) {
  const Bound around = part.around();
  const double outer = std::max({sinking.approaching, sinking.receding, -part.part().radius});
  double first = until;
  tree_of(mesh.solid)
      .search([&](const Box& box) { return earliest_meeting(around, mesh.with(box), from, first, outer); },
              [&] { return first; },
              [&](std::uint32_t, const Convex& triangle) {
                first = std::min(first, sinking_of(part, mesh.with(triangle), from, first, sinking));
                return first > from;
              });
  return first;
}

}  // namespace

template <class Other>
double earliest_sinking(const RigidPair<Other>& pair, double from, double until, const Sinking& sinking) {
  double first = until;
  for_each_part(
      pair, from, {}, [&](const GapNow& gap) { return gap.exceeds(sinking.approaching, first - from); },
      [&](const PartBound& part, const auto& partner) {
        first = std::min(first, sinking_of(part, partner, from, first, sinking));
        return first > from;
      });
  return first < until ? first : infinity;
}

template <class Other>
double earliest_meeting(const Bound&, const RigidPair<Other>& pair, double from, double until,
                        double distance) {
  const double time = earliest_meeting_in_steps(pair, from, until, distance);
  if (time == infinity || !(turned_about_an_axis(pair, until - from) > many_turns)) return time;
  return std::max(time, earliest_meeting_in_all_turns(pair, from, until, distance));
}

template <class Other>
double earliest_separation(const Bound&, const RigidPair<Other>& pair, double from, double until,
                           double distance) {
  double last = from;
  if (turned_about_an_axis(pair, until - from) > many_turns)
    last = earliest_separation_in_all_turns(pair, from, until, distance);
  if (last == infinity) return last;
  for_each_part(
      foreseen(pair, from), from, {}, [&](const GapNow& gap) { return gap.least > distance; },
      [&](const PartBound& part, const auto& partner) {
        last = std::max(last, separation(part, partner, from, until, distance));
        return last < infinity;
      });
  return last;
}

template <class Other>
GapLimits gap_limits(const Bound&, const RigidPair<Other>& pair, double t) {
  GapLimits limits{infinity, infinity};
  for_each_part(
      foreseen(pair, t), t, {}, [&](const GapNow& gap) { return gap.least > limits.upper; },
      [&](const PartBound& part, const auto& partner) {
        const GapLimits own = gap(part, partner, t);
        limits = {std::min(limits.lower, own.lower), std::min(limits.upper, own.upper)};
        return true;
      });
  return limits;
}

template <class Other>
bool is_beyond(const RigidPair<Other>& pair, double t, double distance) {
  bool beyond = true;
  for_each_part(
      foreseen(pair, t), t, {}, [&](const GapNow& gap) { return gap.least > distance; },
      [&](const PartBound& part, const auto& partner) {
        return beyond = gap(part, partner, t).lower > distance;
      });
  return beyond;
}

#define KINESPHERE_RIGID_PAIR(Other)                                                                  \
  template double earliest_meeting(const Bound&, const RigidPair<Other>&, double, double, double);    \
  template double earliest_sinking(const RigidPair<Other>&, double, double, const Sinking&);          \
  template double earliest_separation(const Bound&, const RigidPair<Other>&, double, double, double); \
  template GapLimits gap_limits(const Bound&, const RigidPair<Other>&, double);                       \
  template bool is_beyond(const RigidPair<Other>&, double, double);
KINESPHERE_RIGID_PAIR(RigidExtent)
KINESPHERE_RIGID_PAIR(HalfSpace)
KINESPHERE_RIGID_PAIR(Placed<Convex>)
KINESPHERE_RIGID_PAIR(Placed<Mesh>)
#undef KINESPHERE_RIGID_PAIR

}  // namespace kinesphere
