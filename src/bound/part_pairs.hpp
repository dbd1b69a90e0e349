// Which parts of two rigid bodies, or of one and a wall, may be the nearest or the first to meet. All others
// are left out by what is certain of the balls around them.
#pragma once

#include <cstddef>
#include <vector>

#include "bound/rigid_extent.hpp"
#include "kinesphere/bound.hpp"

namespace kinesphere {

/// The ball around a part, or around a whole body, at one time.
struct BallNow {
  const RigidPart* part = nullptr;
  Vec3 centre{};
  Vec3 velocity{};
  double radius = 0.0;        ///< grown up to now
  double speed = 0.0;         ///< at which it grows
  double acceleration = 0.0;  ///< of centre and growth
  double size = 0.0;          ///< sum of the magnitudes of all terms (length)

  BallNow() = default;
  BallNow(const RigidExtent& body, double time) {
    const Bound& bound = body.bound;
    const double s = time - bound.time;
    centre = bound.centre_at(time);
    velocity = bound.velocity_at(time);
    radius = bound.radius_at(time);
    speed = bound.growth_speed + bound.acceleration_limit * s;
    acceleration = bound.acceleration_limit + norm(bound.planned_acceleration);
    size = norm_one(bound.position) +
           (norm_one(bound.velocity) + norm_one(bound.planned_acceleration) * s) * s + bound.radius;
  }
};

/// What is certain of the gap between what is in two balls, along a direction that is fixed in space.
struct GapNow {
  static constexpr double rounding_lost = 0x1p-40;

  double least;    ///< lower bound of the gap now
  double opening;  ///< rate at which it grows, at least
  double closing;  ///< largest acceleration against that

  /// `way`: the direction, of length 1, from the second ball to the first.
  [[gnu::always_inline]] GapNow(const BallNow& a, const BallNow& b, const Vec3& way)
      : least(dot(way, a.centre - b.centre) - (a.radius + b.radius) - rounding_lost * (a.size + b.size)),
        opening(dot(way, a.velocity - b.velocity) - (a.speed + b.speed) -
                rounding_lost * (norm_one(a.velocity) + norm_one(b.velocity))),
        closing((a.acceleration + b.acceleration) * (1.0 + rounding_lost)) {}
  /// The gap along the line of the centres.
  [[gnu::always_inline]] GapNow(const BallNow& a, const BallNow& b) : GapNow(a, b, direction(a, b)) {}

  [[gnu::always_inline]] static Vec3 direction(const BallNow& a, const BallNow& b) {
    const Vec3 way = a.centre - b.centre;
    return way * (1.0 / norm(way));
  }
  /// Returns true if the gap is larger than `distance` all the time: a concave function is least at an end.
  bool exceeds(double distance, double duration) const {
    return least > distance && least - distance + (opening - 0.5 * closing * duration) * duration > 0.0;
  }
};

/// The parts of a body beside the ball around its partner, or beside a wall, at one time.
class PartsBeside {
 public:
  /// `whole`: the ball around the body. `gap`: that of this ball along `way`, which points from the partner
  /// to the body.
  PartsBeside(const RigidExtent& body, const BallNow& whole, const GapNow& gap, const Vec3& way, double time)
      : body_(body),
        whole_(whole),
        gap_(gap),
        s_(time - body.bound.time),
        turning_(body.spin_growth + body.spin * body.spin),
        along_(rotated_back(body.rotation.orientation, way)),
        turn_(rotated_back(body.rotation.orientation, cross(way, body.rotation.angular_velocity))) {}

  /// Returns the part that reaches farthest towards the partner.
  const RigidPart& foremost() const {
    const Vec3 along = along_ + turn_ * s_;
    std::size_t first = 0;
    double least = dot(along, body_.balls[0].middle) - body_.balls[0].radius;
    for (std::size_t k = 1; k < body_.balls.size(); ++k) {
      const double own = dot(along, body_.balls[k].middle) - body_.balls[k].radius;
      if (!(own < least)) continue;
      first = k;
      least = own;
    }
    return body_.parts[first];
  }
  /// Calls visit(number) for parts for which skips(gap) is false of their gap to the partner.
  template <class Skips, class Visit>
  void for_each_near(Skips skips, Visit visit) const {
    for (std::size_t k = 0; k < body_.balls.size(); ++k)
      if (!skips(gap(body_.balls[k]))) visit(k);
  }
  /// Returns the balls around these parts.
  template <class Skips>
  std::vector<BallNow> near(Skips skips) const {
    std::vector<BallNow> found;
    for_each_near(skips, [&](std::size_t k) {
      if (found.empty()) found.reserve(body_.balls.size());
      found.push_back(ball(k));
    });
    return found;
  }

 private:
  /// Returns the gap of a part to the partner. Products with vectors of the body save turning the part.
  [[gnu::always_inline]] GapNow gap(const PartBall& part) const {
    const double turning = turning_ * part.arm;
    const double speed = dot(turn_, part.middle);
    GapNow gap = gap_;
    gap.least +=
        dot(along_, part.middle) + speed * s_ - (part.radius - body_.radius) - 0.5 * turning * s_ * s_;
    gap.opening += speed - turning * s_ - GapNow::rounding_lost * body_.spin * part.arm;
    gap.closing += turning * (1.0 + GapNow::rounding_lost);
    return gap;
  }
  /// Returns the ball around a part as RigidExtent::of_point() gives it for its middle.
  BallNow ball(std::size_t number) const {
    const PartBall& part = body_.balls[number];
    const Vec3 arm = rotated(body_.rotation.orientation, part.middle);
    const Vec3 turn = cross(body_.rotation.angular_velocity, arm);
    const double turning = turning_ * part.arm;
    BallNow ball = whole_;
    ball.part = &body_.parts[number];
    ball.centre += arm + turn * s_;
    ball.velocity += turn;
    ball.radius += part.radius - body_.radius + 0.5 * turning * s_ * s_;
    ball.speed += turning * s_;
    ball.acceleration += turning;
    return ball;
  }

  const RigidExtent& body_;
  const BallNow& whole_;
  const GapNow& gap_;
  double s_;           ///< since the report
  double turning_;     ///< largest acceleration of a point beyond that of the position, for its distance
  Vec3 along_, turn_;  ///< direction, and direction x angular velocity, in the body
};

/// A part of each body of a pair, or none.
struct PartPair {
  const RigidPart* own = nullptr;
  const RigidPart* other = nullptr;
};

/// Calls visit(part, other) for pairs of parts of two bodies, until it returns false: for `first` or, if that
/// is none, for those that reach farthest towards each other, and then for all others but those for which
/// skips(gap) is true of a GapNow that contains them.
template <class Skips, class Visit>
void for_each_part_pair(const RigidExtent& body, const RigidExtent& other, double time, PartPair first,
                        Skips skips, Visit visit) {
  if (body.parts.size() == 1 && other.parts.size() == 1) {
    visit(body.parts[0], other.parts[0]);
    return;
  }
  const BallNow one(body, time);
  const BallNow second(other, time);
  const Vec3 way = GapNow::direction(one, second);
  const GapNow balls(one, second, way);
  const PartsBeside own(body, one, balls, way, time);
  const PartsBeside others(other, second, balls, -way, time);
  if (first.own == nullptr) first = {&own.foremost(), &others.foremost()};
  if (!visit(*first.own, *first.other)) return;
  const std::vector<BallNow> near = own.near(skips);
  if (near.empty()) return;
  const std::vector<BallNow> others_near = others.near(skips);
  for (const BallNow& a : near)
    for (const BallNow& b : others_near)
      if ((a.part != first.own || b.part != first.other) && !skips(GapNow(a, b)) && !visit(*a.part, *b.part))
        return;
}

/// Calls visit(part) for parts of a body beside a wall, as for_each_part_pair() does for pairs.
template <class Skips, class Visit>
void for_each_part_towards(const RigidExtent& body, const HalfSpace& wall, double time, PartPair first,
                           Skips skips, Visit visit) {
  const BallNow one(body, time);
  BallNow point;
  point.centre = wall.normal * wall.offset;
  point.size = norm_one(point.centre);
  const GapNow ball(one, point, wall.normal);
  const PartsBeside own(body, one, ball, wall.normal, time);
  if (first.own == nullptr) first.own = &own.foremost();
  bool goes_on = visit(*first.own);
  own.for_each_near([&](const GapNow& gap) { return !goes_on || skips(gap); },
                    [&](std::size_t k) {
                      if (&body.parts[k] != first.own) goes_on = visit(body.parts[k]);
                    });
}

}  // namespace kinesphere
