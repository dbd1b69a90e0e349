// Long and thin triangles, and places and ways near them.
#pragma once

#include <algorithm>
#include <cmath>
#include <ostream>

#include "kinesphere/random.hpp"
#include "kinesphere/shape.hpp"
#include "support/exact_shapes.hpp"

namespace kinesphere {

struct Needle {
  Triangle triangle;
  double length;

  /// Returns a point of the triangle, possibly near a corner.
  Vec3 point(Random& random) const {
    const auto part = [&random] {
      const double u = random.uniform();
      return random.bits() % 2 == 0 ? u : std::exp2(-60.0 * u);
    };
    double b = part(), c = part();
    if (b + c > 1.0) {
      b = 1.0 - std::min(b, 1.0);
      c = 1.0 - std::min(c, 1.0);
    }
    if (b + c > 1.0) b = c = 0.5;
    return triangle.a + (triangle.b - triangle.a) * b + (triangle.c - triangle.a) * c;
  }
};

inline std::ostream& operator<<(std::ostream& out, const Needle& needle) {
  const auto corner = [&out](const Vec3& v) { out << "{" << v.x << ", " << v.y << ", " << v.z << "}, "; };
  out << std::hexfloat << "Triangle{";
  for (const Vec3& v : {needle.triangle.a, needle.triangle.b, needle.triangle.c}) corner(v);
  return out << std::defaultfloat << "}";
}

/// Returns a triangle with a length from 1e-3 to 1e6, a thickness (height by length) down to the least that a
/// world allows, the foot of the height anywhere, often near an end, and corners in any order. It lies within
/// `limit` of the origin on each axis, often far out.
inline Needle random_needle(Random& random, double limit) {
  for (;;) {
    const double length = std::pow(10.0, random.uniform(-3.0, 6.0));
    const double thickness = random.bits() % 2 == 0 ? 0x1.08p-20 : std::exp2(random.uniform(-20.0, -1.0));
    const Vec3 along = random.unit_vector();
    Vec3 across = cross(along, random.unit_vector());
    across = across / norm(across);
    double foot = random.uniform();
    if (random.bits() % 4 == 0) foot = std::exp2(-30.0 * foot);
    const double away = random.bits() % 2 == 0 ? 0.0 : std::max(limit - length, 0.0);
    const Vec3 place{away * random.uniform(-1.0, 1.0), away * random.uniform(-1.0, 1.0),
                     away * random.uniform(-1.0, 1.0)};
    Triangle t{place, place + along * length,
               place + along * (length * foot) + across * (length * thickness)};
    // Rounding far out turns small triangles into other ones.
    if (exact::thickness(t) < 0x1.01p-20) continue;
    if (random.bits() % 2 == 0) std::swap(t.a, t.b);
    if (random.bits() % 2 == 0) std::swap(t.b, t.c);
    if (random.bits() % 2 == 0) std::swap(t.a, t.c);
    return {t, length};
  }
}

}  // namespace kinesphere
