// A triangle seen from one corner: coordinates along two of its sides.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "kinesphere/shape.hpp"

namespace kinesphere {

/// Of a point a + along_b (b - a) + along_c (c - a), or of a vector without the a.
struct SideCoordinates {
  double along_b;
  double along_c;
};

struct TriangleFrame {
  explicit TriangleFrame(const Triangle& triangle)
      : origin(triangle.a),
        to_b(triangle.b - triangle.a),
        to_c(triangle.c - triangle.a),
        across(cross(to_b, to_c)) {}

  /// Of the projection of a vector on the plane.
  SideCoordinates coordinates(const Vec3& vector) const {
    const double square = norm_squared(across);
    return {dot(cross(vector, to_c), across) / square, dot(cross(to_b, vector), across) / square};
  }
  Vec3 vector(const SideCoordinates& at) const { return to_b * at.along_b + to_c * at.along_c; }

  Vec3 origin, to_b, to_c;
  Vec3 across;  ///< normal to the plane; its length is twice the area
};

inline bool lies_inside(const SideCoordinates& at) {
  return at.along_b >= 0.0 && at.along_c >= 0.0 && at.along_b + at.along_c <= 1.0;
}

inline double longest_side_squared(const Triangle& t) {
  return std::max({norm_squared(t.b - t.a), norm_squared(t.c - t.b), norm_squared(t.a - t.c)});
}

/// The least height relative to the longest side; 0 for one whose corners lie on a line.
inline double thickness(const Triangle& triangle) {
  const double longest = longest_side_squared(triangle);
  return longest > 0.0 ? norm(TriangleFrame(triangle).across) / longest : 0.0;
}
/// Below this, numbers made from a triangle would mean too little.
inline constexpr double least_thickness = 0x1p-20;

/// The place on a side that is nearest to a point.
struct SidePoint {
  Vec3 start, side;
  double part;  ///< in [0, 1]

  Vec3 place() const { return start + side * part; }
};

inline SidePoint nearest_on_sides(const Triangle& triangle, const Vec3& from) {
  const std::array<Vec3, 4> corners{triangle.a, triangle.b, triangle.c, triangle.a};
  SidePoint best{};
  double least = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    SidePoint found{corners[k], corners[k + 1] - corners[k], 0.0};
    found.part = std::clamp(dot(from - found.start, found.side) / norm_squared(found.side), 0.0, 1.0);
    const double square = norm_squared(from - found.place());
    if (k > 0 && !(square < least)) continue;
    best = found;
    least = square;
  }
  return best;
}

}  // namespace kinesphere
