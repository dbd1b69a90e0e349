// A triangle in an orthonormal frame along its longest side, where its numbers keep their digits however thin
// it is.
//
// Coordinates along two sides of a needle do not: the sides are nearly parallel, and what rounding does to
// such coordinates is larger by the ratio of its length and its thickness. In an orthonormal frame every
// length errs by a few units in the last place of the lengths that went into it, and so does the distance of
// a place, which changes by no more than the place and the corners do.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "kinesphere/shape.hpp"

namespace kinesphere {

/// A place or a vector in the plane of a triangle.
struct PlaneVector {
  double along;   ///< the longest side
  double across;  ///< it, towards the third corner

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

/// A side of a triangle, seen in its frame.
struct TriangleSide {
  PlaneVector start;
  PlaneVector direction;  ///< of length 1
  double length;

  /// How far a place lies beyond the side, outside the triangle; negative inside. Of a vector: how fast it
  /// leads there.
  double outward(const PlaneVector& vector) const {
    return direction.across * vector.along - direction.along * vector.across;
  }
  double beyond(const PlaneVector& place) const { return outward(place - start); }
};

/// The origin is at one end of the longest side. Places and vectors have their coordinates in the frame to
/// within 24 * 2^-53 times their length (of a place: its distance from the origin), and corners to within as
/// much of the longest side. A triangle whose corners lie on a line counts as one of height 0; one whose
/// corners are one place has numbers that are none.
class TriangleFrame {
 public:
  explicit TriangleFrame(const Triangle& t) {
    const std::array<Vec3, 3> aabb{t.a, t.b, t.c};
    std::size_t first = 0;
    double longest = norm_squared(t.b - t.a);
    for (std::size_t k = 1; k < 3; ++k) {
      const double square = norm_squared(aabb[(k + 1) % 3] - aabb[k]);
      if (!(square > longest)) continue;
      longest = square;
      first = k;
    }
    corners_ = {aabb[first], aabb[(first + 1) % 3], aabb[(first + 2) % 3]};
    const Vec3 side = corners_[1] - corners_[0];
    const Vec3 third = corners_[2] - corners_[0];
    length_ = norm(side);
    along_ = side / length_;
    const double foot = dot(third, along_);
    // Taken away once, the part along the side leaves as much as rounding did to it: of a thin triangle's
    // height that may be a large part.
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
  const Vec3& normal() const { return normal_; }  ///< of the plane: by the right-hand rule from a to b to c
  double length() const { return length_; }       ///< of the longest side
  double height() const { return height_; }       ///< over the longest side: the least of the three
  /// The longest one first. Side k begins at corner k.
  const std::array<TriangleSide, 3>& sides() const { return sides_; }
  const Vec3& corner(std::size_t k) const { return corners_[k % 3]; }

  PlaneVector in_plane(const Vec3& vector) const { return {dot(vector, along_), dot(vector, across_)}; }
  double above_plane(const Vec3& vector) const { return dot(vector, normal_); }
  Vec3 vector(const PlaneVector& v) const { return along_ * v.along + across_ * v.across; }

  /// How far a place of the plane lies outside, at least; negative inside, where it is the least depth.
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

/// The least height relative to the longest side; 0 for one whose corners lie on a line.
inline double thickness(const Triangle& triangle) {
  const TriangleFrame frame(triangle);
  return frame.length() > 0.0 ? frame.height() / frame.length() : 0.0;
}
/// Below this, numbers made from a triangle would mean too little.
inline constexpr double least_thickness = 0x1p-20;

/// The place on the sides of a triangle that is nearest to another one.
struct SidePoint {
  std::size_t side = 0;
  double part = std::numeric_limits<double>::quiet_NaN();  ///< of the side, in [0, 1]
  PlaneVector away{part, part};                            ///< from there to the place, along the plane

  /// In space.
  Vec3 place(const TriangleFrame& frame) const {
    return frame.corner(side) + (frame.corner(side + 1) - frame.corner(side)) * part;
  }
};

/// Of a place outside, `away` is normal to the side and points outward or, at a corner, leads along none of
/// the two sides that end there; exactly so, also where it is so short that the difference of the two places
/// says little of its direction. So all of the triangle lies behind each plane through the point that is
/// normal to a sum of `away` and any part of the frame's normal, to within the rounding of lengths. A number
/// that is none, in the place or in the frame, spoils the answer.
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
