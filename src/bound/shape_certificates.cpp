// Certified earliest times and gaps between a bound and a box or triangle at rest. The method: shape.hpp.
#include <optional>

#include "bound/reach.hpp"
#include "bound/rounding.hpp"
#include "bound/safe_steps.hpp"
#include "bound/triangle.hpp"
#include "number/infinity.hpp"

namespace kinesphere {
namespace {

template <class Solid>
double meeting(const Bound& bound, const Solid& solid, double from, double until, double distance) {
  double time = from;
  for (int round = 0; round < most_rounds; ++round) {
    const HalfSpace plane = supporting_plane(solid, nearest_point(solid, bound.centre_at(time)).normal);
    const double next = earliest_meeting(bound, plane, time, until, distance);
    if (next == infinity) return infinity;
    const double gain = next - time;
    time = next;
    if (!(gain > (time - from) * negligible_gain)) break;
  }
  return time;
}

/// A point inside the shape that follows the centre of a bound from a time on, for as long as the shape
/// permits.
struct Companion {
  Bound path{};             ///< radius 0
  double stays = infinity;  ///< time for which the point is inside the shape
  double wrong = 0.0;       ///< rounding error of that statement (length)
};

/// Returns how long a companion stays on one side of an end at distance `clearance`. Returns 0, so that it
/// stands still, if it is hardly farther from the end than `near`, which covers rounding.
double stay(double clearance, double speed, double acceleration, double near) {
  return clearance > 2.0 * near ? rounding::first_crossing(clearance - near, speed, acceleration) : 0.0;
}

Companion companion(const Box& box, const Bound& bound, double now) {
  const Vec3 centre = bound.centre_at(now);
  const Vec3 velocity = bound.velocity_at(now);
  const Vec3& plan = bound.planned_acceleration;
  Companion at{.path = {.time = now}};
  for (int axis = 0; axis < 3; ++axis) {
    const double size = std::abs(centre[axis]) + std::abs(box.lower[axis]) + std::abs(box.upper[axis]);
    // A NaN propagates to the path and thereby makes the certificate void.
    at.path.position[axis] =
        std::isnan(size) ? size : std::clamp(centre[axis], box.lower[axis], box.upper[axis]);
    const double near = 0x1p-40 * size;
    const double stays = std::min(stay(centre[axis] - box.lower[axis], velocity[axis], plan[axis], near),
                                  stay(box.upper[axis] - centre[axis], -velocity[axis], -plan[axis], near));
    // At an end of the box, the companion stands still on this axis.
    if (stays == 0.0) continue;
    at.path.velocity[axis] = velocity[axis];
    at.path.planned_acceleration[axis] = plan[axis];
    at.stays = std::min(at.stays, stays);
  }
  return at;
}

/// Minimum distance from an end, relative to the length of the edge or side: exceeds the rounding error of
/// the companion's position. Larger values make more companions stand still, with shorter certificates.
constexpr double near_an_end = 0x1p-45;

std::optional<Companion> companion_on_face(const TriangleFrame& frame, const Bound& bound, double now) {
  const PlaneVector place = frame.in_plane(bound.centre_at(now) - frame.origin());
  if (!frame.contains(place)) return std::nullopt;
  const PlaneVector velocity = frame.in_plane(bound.velocity_at(now));
  const PlaneVector plan = frame.in_plane(bound.planned_acceleration);
  double stays = infinity;
  for (const TriangleSide& side : frame.sides())
    stays = std::min(stays, stay(-side.beyond(place), -side.outward(velocity), -side.outward(plan),
                                 near_an_end * frame.length()));
  if (stays == 0.0) return std::nullopt;
  return Companion{.path = {.time = now,
                            .position = frame.origin() + frame.vector(place),
                            .velocity = frame.vector(velocity),
                            .planned_acceleration = frame.vector(plan)},
                   .stays = stays};
}

Companion companion_on_side(const TriangleFrame& frame, const Bound& bound, double now) {
  const SidePoint at = nearest_on_sides(frame, frame.in_plane(bound.centre_at(now) - frame.origin()));
  Companion found{.path = {.time = now, .position = at.place(frame)}};
  const Vec3 side = frame.corner(at.side + 1) - frame.corner(at.side);
  const double square = norm_squared(side);
  const double speed = dot(bound.velocity_at(now), side) / square;
  const double plan = dot(bound.planned_acceleration, side) / square;
  const double stays =
      std::min(stay(at.part, speed, plan, near_an_end), stay(1.0 - at.part, -speed, -plan, near_an_end));
  if (stays == 0.0) return found;
  found.path.velocity = side * speed;
  found.path.planned_acceleration = side * plan;
  found.stays = stays;
  return found;
}

Companion companion(const Triangle& triangle, const Bound& bound, double now) {
  const TriangleFrame frame(triangle);
  const auto on_face = companion_on_face(frame, bound, now);
  Companion found = on_face ? *on_face : companion_on_side(frame, bound, now);
  // While the companion is inside, each term of its path is at most about eight side lengths.
  found.wrong = 4.0 * rounding::margin * size_of(triangle);
  return found;
}

template <class Solid>
double separation(const Bound& bound, const Solid& solid, double from, double until, double distance) {
  double time = from;
  for (int round = 0; round < most_rounds; ++round) {
    const Companion at = companion(solid, bound, time);
    const double parted = earliest_separation(bound, at.path, time, until, distance - at.wrong);
    const double leaves = rounding::sum_down(time, at.stays);
    if (parted <= leaves) return parted;
    if (leaves > until) return infinity;
    const double gain = leaves - time;
    time = std::max(time, leaves);
    if (!(gain > (time - from) * negligible_gain)) break;
  }
  return time;
}

/// Centre, growth, and magnitude of all terms of a bound at time t, for a gap.
struct Reported {
  Reported(const Bound& bound, double t) : centre(bound.centre_at(t)) {
    const double s = t - bound.time;
    growth = (bound.growth_speed + 0.5 * bound.acceleration_limit * s) * s;
    size = norm_one(bound.position) + norm_one(bound.velocity) * s +
           norm_one(bound.planned_acceleration) * (s * s) + bound.radius + growth;
  }
  Vec3 centre;
  double growth, size;
};

}  // namespace

double earliest_meeting(const Bound& bound, const Box& shape, double from, double until, double distance) {
  return meeting(bound, shape, from, until, distance);
}

double earliest_meeting(const Bound& bound, const Triangle& shape, double from, double until,
                        double distance) {
  // A triangle has no inside, so a gap is never less than minus the radius.
  const double least =
      bound.radius + distance < 0.0 ? earliest_meeting(bound, HalfSpace{}, from, until, distance) : from;
  return least == infinity ? infinity : meeting(bound, shape, least, until, distance);
}

double earliest_separation(const Bound& bound, const Box& shape, double from, double until, double distance) {
  const double depth = -(bound.radius + distance);
  if (std::isnan(depth)) return from;
  // First part: the time for which the centre, anywhere within its bound, is at least `depth` inside the box.
  // Without it, a bound that has grown by more than the distance would have no certificate, however deep in
  // the box it is.
  Bound inside = bound;
  inside.radius = depth > 0.0 ? depth + rounding::margin * (bound.radius + std::abs(distance)) : 0.0;
  const double out = earliest_exit(inside, shape, from, until);
  return depth < 0.0 && out < infinity ? separation(bound, shape, out, until, distance) : out;
}

double earliest_separation(const Bound& bound, const Triangle& shape, double from, double until,
                           double distance) {
  return separation(bound, shape, from, until, distance);
}

GapLimits gap_limits(const Bound& bound, const Box& shape, double t) {
  const Reported reported(bound, t);
  const double gap = nearest_point(shape, reported.centre).distance - bound.radius;
  const double wrong = rounding::margin * (reported.size + size_of(shape));
  return {.lower = gap - reported.growth - wrong, .upper = gap + reported.growth + wrong};
}

GapLimits gap_limits(const Bound& bound, const Triangle& shape, double t) {
  const Reported reported(bound, t);
  const double gap = nearest_point(shape, reported.centre).distance - bound.radius;
  const double wrong = rounding::margin * (reported.size + size_of(shape));
  // A triangle has no inside.
  return {.lower = std::max(gap - wrong, -bound.radius) - reported.growth - wrong,
          .upper = gap + reported.growth + wrong};
}

}  // namespace kinesphere
