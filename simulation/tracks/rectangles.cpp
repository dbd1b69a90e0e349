// Rectangles in the plane: their distance, by separating axes and corners, and their first touch.
#include "simulation/tracks/rectangles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "number/infinity.hpp"
#include "simulation/tracks/time_to_collision.hpp"

namespace kinesphere {
namespace {

Vec3 flat(const Vec3& vector) { return {vector.x, vector.y, 0.0}; }

/// The half axes of a rectangle.
struct HalfAxes {
  HalfAxes(const RectangleBody& body, double heading)
      : direction{std::cos(heading), std::sin(heading), 0.0},
        along(0.5 * body.length),
        across(0.5 * body.width) {}

  Vec3 right() const { return {direction.y, -direction.x, 0.0}; }
  /// Returns how far the rectangle reaches from its middle along a unit vector.
  double reach(const Vec3& axis) const {
    return along * std::abs(dot(direction, axis)) + across * std::abs(dot(right(), axis));
  }
  /// Returns the distance of a point, seen from the middle; 0 inside.
  double distance_to(const Vec3& point) const {
    const double x = std::max(std::abs(dot(point, direction)) - along, 0.0);
    const double y = std::max(std::abs(dot(point, right())) - across, 0.0);
    return std::hypot(x, y);
  }
  std::array<Vec3, 4> corners() const {
    const Vec3 a = direction * along, b = right() * across;
    return {a + b, a - b, -1.0 * a + b, -1.0 * a - b};
  }

  Vec3 direction;
  double along, across;
};

std::array<Vec3, 4> axes_of(const HalfAxes& a, const HalfAxes& b) {
  return {a.direction, a.right(), b.direction, b.right()};
}

/// Returns the distance of two rectangles whose middles are `way` apart; less than 0 where they overlap.
double gap_of(const Vec3& way, const HalfAxes& a, const HalfAxes& b) {
  double apart = -infinity;
  for (const Vec3& axis : axes_of(a, b))
    apart = std::max(apart, std::abs(dot(way, axis)) - a.reach(axis) - b.reach(axis));
  if (apart <= 0.0) return apart;
  // Two convex polygons that are apart are nearest at a corner of one of them.
  double least = infinity;
  for (const Vec3& corner : b.corners()) least = std::min(least, a.distance_to(way + corner));
  for (const Vec3& corner : a.corners()) least = std::min(least, b.distance_to(corner - way));
  return least;
}

/// When a gap that is a convex function of time, first above 0, comes to 0 between two times; infinity if it
/// does not.
template <class Gap>
double first_zero(Gap gap, double from, double to) {
  constexpr int rounds = 100;
  double low = from, high = to;
  for (int round = 0; round < rounds; ++round) {
    const double left = low + (high - low) / 3.0, right = high - (high - low) / 3.0;
    (gap(left) < gap(right) ? high : low) = gap(left) < gap(right) ? right : left;
  }
  double inside = 0.5 * (low + high), outside = from;
  if (gap(inside) > 0.0) return infinity;
  if (gap(outside) <= 0.0) return outside;
  for (int round = 0; round < rounds; ++round) {
    const double middle = 0.5 * (inside + outside);
    (gap(middle) <= 0.0 ? inside : outside) = middle;
  }
  return inside;
}

}  // namespace

double RectangleBody::reach() const { return radius + 0.5 * std::hypot(length, width); }

double RectangleBody::heading_at(double t) const {
  if (times.empty()) return 0.0;
  const auto at = static_cast<std::size_t>(std::ranges::upper_bound(times, t) - times.begin());
  if (at == 0) return headings.front();
  if (at == times.size()) return headings.back();
  const double part = (t - times[at - 1]) / (times[at] - times[at - 1]);
  return headings[at - 1] + part * (headings[at] - headings[at - 1]);
}

double gap_between(const RectangleBody& first, const RectanglePose& at, const RectangleBody& second,
                   const RectanglePose& other) {
  const double radii = first.radius + second.radius, heights = first.height + second.height;
  const bool are_round = first.length == 0.0 && second.length == 0.0, has_heights = std::isfinite(heights);
  if (are_round && !has_heights) return norm(other.position - at.position) - radii;
  const Vec3 way = flat(other.position - at.position);
  const double beside =
      (are_round ? norm(way) : gap_of(way, HalfAxes(first, at.heading), HalfAxes(second, other.heading))) -
      radii;
  if (!has_heights) return beside;
  const double above = std::abs(other.position.z - at.position.z) - 0.5 * heights;
  return above > 0.0 ? std::hypot(std::max(beside, 0.0), above) : std::max(beside, above);
}

double time_to_touch(const RectangleBody& first, const RectanglePose& at, const RectangleBody& second,
                     const RectanglePose& other) {
  const Vec3 way = flat(other.position - at.position), velocity = flat(other.velocity - at.velocity);
  const double radii = first.radius + second.radius;
  const HalfAxes a(first, at.heading), b(second, other.heading);
  const double heights = first.height + second.height;
  const bool are_round = first.length == 0.0 && second.length == 0.0, has_heights = std::isfinite(heights);
  if (are_round && !has_heights) return time_to_collision(way, velocity, radii);
  if (gap_between(first, at, second, other) <= 0.0) return 0.0;
  // While their projections on all axes overlap, rectangles do, and bodies with round corners may.
  double from = 0.0, to = infinity;
  // Of two that go alike, rounding brings none nearer.
  const double rounding = 0x1p-40 * (norm(at.velocity) + norm(other.velocity));
  const std::array<Vec3, 5> axes{a.direction, a.right(), b.direction, b.right(), Vec3{0.0, 0.0, 1.0}};
  for (const Vec3& axis : std::span(axes).first(has_heights ? 5 : 4)) {
    const bool is_upward = &axis == &axes.back();
    const double distance = dot(other.position - at.position, axis),
                 speed = dot(other.velocity - at.velocity, axis);
    const double reach = is_upward ? 0.5 * heights : a.reach(axis) + b.reach(axis) + radii;
    const bool stays = std::abs(speed) <= rounding;
    if (stays && std::abs(distance) > reach) return infinity;
    if (stays) continue;
    const double one = (-reach - distance) / speed, two = (reach - distance) / speed;
    from = std::max(from, std::min(one, two));
    to = std::min(to, std::max(one, two));
  }
  if (!(from < to) || to == infinity) return infinity;
  if (radii == 0.0) return from;
  return first_zero([&](double s) { return gap_of(way + velocity * s, a, b) - radii; }, from, to);
}

RectanglePose RectanglePiece::pose(double t) const {
  const State state = segment.state_at(t);
  return {state.position, state.velocity, heading + turn_rate * (t - begin)};
}

double RectanglePiece::fastest(double reach, double from, double to) const {
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  return norm(segment.state_at(middle).velocity) + norm(segment.acceleration_at(middle)) * half +
         0.5 * norm(segment.jerk) * half * half + std::abs(turn_rate) * reach;
}

std::vector<RectanglePiece> pieces_of(const Motion& motion, std::uint32_t body, const RectangleBody& shape,
                                      double begin, double end) {
  std::vector<RectanglePiece> pieces;
  std::size_t next = 0;
  for (const Segment& segment : motion.trajectory(body, begin, end)) {
    const double last = std::min(segment.end, end);
    for (double at = std::max(segment.begin, begin); at < last || (at == end && pieces.empty());) {
      while (next < shape.times.size() && shape.times[next] <= at) ++next;
      RectanglePiece piece{.begin = at, .end = last, .segment = segment};
      if (next < shape.times.size()) piece.end = std::min(last, shape.times[next]);
      if (next > 0) piece.heading = shape.headings[next - 1];
      if (next == 0 && !shape.headings.empty()) piece.heading = shape.headings.front();
      if (next > 0 && next < shape.times.size()) {
        piece.turn_rate =
            (shape.headings[next] - shape.headings[next - 1]) / (shape.times[next] - shape.times[next - 1]);
        piece.heading += piece.turn_rate * (at - shape.times[next - 1]);
      }
      pieces.push_back(piece);
      if (at == last) break;
      at = piece.end;
    }
  }
  return pieces;
}

}  // namespace kinesphere
