// A triangle in an orthonormal frame along its longest side, which is accurate for thin triangles too.
//
// Coordinates along two sides of a needle are not: the sides are nearly parallel, which multiplies rounding
// errors by the ratio of its length to its thickness. In an orthonormal frame, the error of a length is a few
// units in the last place of the lengths it is computed from. The distance of a point changes by no more than
// the point and the corners do, so its error is as small.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "kinesphere/shape.hpp"

namespace kinesphere {

/// A point or a vector in the plane of a triangle.
struct PlaneVector {
  double along;   ///< parallel to the longest side
  double across;  ///< normal to the longest side, towards the third corner

  friend PlaneVector operator-(const PlaneVector& a, const PlaneVector& b) {
    return {a.along - b.along, a.across - b.across};
  }
  friend PlaneVector operator*(const PlaneVector& a, double factor) {
    return {a.along * factor, a.across * factor};
  }
  friend double dot(const PlaneVector& a, const PlaneVector& b) {
    return a.along * b.along + a.across * b.across;
  }
};

/// One side of a triangle, in the coordinates of its frame.
struct TriangleSide {
  PlaneVector start;
  PlaneVector direction;  ///< unit vector
  double length;

  /// Outward component of a vector, across the side's line.
  double outward(const PlaneVector& vector) const {
    return direction.across * vector.along - direction.along * vector.across;
  }
  /// Distance of a point from the side's line; positive outside the triangle, negative inside.
  double beyond(const PlaneVector& place) const { return outward(place - start); }
};

/// The origin is one end of the longest side. Coordinates of points and vectors have errors up to 24 * 2^-53
/// times their length (for a point: its distance from the origin); those of corners, up to this times the
/// longest side. A triangle with collinear corners has height 0, or one of the size of these errors.
/// One with three equal corners has NaN coordinates.
class TriangleFrame {
 public:
  explicit TriangleFrame(const Triangle& t) {
    const std::array<Vec3, 3> corners{t.a, t.b, t.c};
    std::size_t first = 0;
    double longest = norm_squared(t.b - t.a);
    for (std::size_t k = 1; k < 3; ++k) {
      const double square = norm_squared(corners[(k + 1) % 3] - corners[k]);
      if (!(square > longest)) continue;
      longest = square;
      first = k;
    }
    corners_ = {corners[first], corners[(first + 1) % 3], corners[(first + 2) % 3]};
    const Vec3 side = corners_[1] - corners_[0];
    const Vec3 third = corners_[2] - corners_[0];
    length_ = norm(side);
    along_ = side / length_;
    const double foot = dot(third, along_);
    // A single projection leaves a component along the side of the size of the rounding error, which may be a
    // large part of a thin triangle's height. So the projection is repeated.
    Vec3 height = third - along_ * foot;
    height -= along_ * dot(height, along_);
    height_ = norm(height);
    across_ = height_ > 0.0 ? height / height_ : any_normal_to(along_);
    normal_ = cross(along_, across_);
    const std::array<PlaneVector, 3> places{{{0.0, 0.0}, {length_, 0.0}, {foot, height_}}};
    for (std::size_t k = 0; k < 3; ++k) {
      const PlaneVector way = places[(k + 1) % 3] - places[k];
      const double length = k == 0 ? length_ : std::sqrt(dot(way, way));
      sides_[k] = {places[k], {way.along / length, way.across / length}, length};
    }
  }

  const Vec3& origin() const { return corners_[0]; }
  const Vec3& normal() const { return normal_; }  ///< unit normal of the plane, right-handed for a, b, c
  double length() const { return length_; }       ///< length of the longest side
  double height() const { return height_; }       ///< height over the longest side, the least of the three
  /// Sides, the longest first. Side k begins at corner k.
  const std::array<TriangleSide, 3>& sides() const { return sides_; }
  const Vec3& corner(std::size_t k) const { return corners_[k % 3]; }

  PlaneVector in_plane(const Vec3& vector) const { return {dot(vector, along_), dot(vector, across_)}; }
  double above_plane(const Vec3& vector) const { return dot(vector, normal_); }
  Vec3 vector(const PlaneVector& v) const { return along_ * v.along + across_ * v.across; }

  /// Lower bound of the distance of a point of the plane from the triangle. Inside, minus the distance to the
  /// nearest side.
  double beyond(const PlaneVector& place) const {
    return std::max({sides_[0].beyond(place), sides_[1].beyond(place), sides_[2].beyond(place)});
  }
  bool contains(const PlaneVector& place) const { return height_ > 0.0 && beyond(place) <= 0.0; }

 private:
  static Vec3 any_normal_to(const Vec3& direction) {
    const Vec3 n = std::abs(direction.x) < 0.5 ? Vec3{0.0, direction.z, -direction.y}
                                               : Vec3{direction.y, -direction.x, 0.0};
    return n / norm(n);
  }

  std::array<Vec3, 3> corners_;
  Vec3 along_, across_, normal_;
  double length_, height_;
  std::array<TriangleSide, 3> sides_;
};

/// Height over the longest side, divided by its length; 0 or hardly more if the corners are collinear.
inline double thickness(const Triangle& triangle) {
  const TriangleFrame frame(triangle);
  return frame.length() > 0.0 ? frame.height() / frame.length() : 0.0;
}
/// Minimum thickness of a triangle. Thinner ones are refused, as values computed from them would be too
/// inaccurate.
inline constexpr double least_thickness = 0x1p-20;

/// Nearest point on the sides of a triangle to a given point.
struct SidePoint {
  std::size_t side = 0;
  double part = std::numeric_limits<double>::quiet_NaN();  ///< position on the side, in [0, 1]
  PlaneVector away{part, part};                            ///< from this point to the given one, in the plane

  /// Returns the point in space.
  Vec3 place(const TriangleFrame& frame) const {
    return frame.corner(side) + (frame.corner(side + 1) - frame.corner(side)) * part;
  }
};

/// Returns the point on the sides nearest to `place`. For a `place` outside, `away` is normal to the side and
/// points outward or, at a corner, has no positive component along either of the two sides that end there.
/// This is exact even if `away` is so short that the difference of the two points is mostly rounding error.
/// Hence, up to the rounding of lengths, the whole triangle lies behind each plane through the point that is
/// normal to `away` plus any multiple of the frame's normal. NaN in the arguments propagates.
inline SidePoint nearest_on_sides(const TriangleFrame& frame, const PlaneVector& place) {
  const double nearest_side = std::min(frame.beyond(place), 0.0);
  for (std::size_t k = 0; k < 3; ++k) {
    const TriangleSide& side = frame.sides()[k];
    const double way = dot(place - side.start, side.direction);
    const double out = side.beyond(place);
    if (out >= nearest_side && way > 0.0 && way < side.length)
      return {k, way / side.length, {side.direction.across * out, -side.direction.along * out}};
  }
  SidePoint best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const PlaneVector away = place - frame.sides()[k].start;
    if (!(dot(away, away) < least)) continue;
    least = dot(away, away);
    best = {k, 0.0, away};
  }
  const double along_next = dot(best.away, frame.sides()[best.side].direction);
  if (along_next > 0.0) best.away = best.away - frame.sides()[best.side].direction * along_next;
  const PlaneVector& before = frame.sides()[(best.side + 2) % 3].direction;
  const double along_before = dot(best.away, before);
  if (along_before < 0.0) best.away = best.away - before * along_before;
  return best;
}

}  // namespace kinesphere
