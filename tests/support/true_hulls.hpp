// Convex hulls of a few points by brute force in long double: planes and edges from all triples and pairs of
// points, distances from all vertices, faces and edges, depths from all directions that may separate.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "kinesphere/vec3.hpp"

namespace kinesphere::true_hulls {

struct Vector {
  long double x, y, z;

  friend Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vector operator*(const Vector& a, long double s) { return {a.x * s, a.y * s, a.z * s}; }
};
inline Vector vector(const Vec3& v) { return {v.x, v.y, v.z}; }
inline long double dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline long double length(const Vector& a) { return std::sqrt(dot(a, a)); }

/// Points as indices, so that a hull is analysed once and measured wherever its points are.
struct Hull {
  /// The normal is that of the first three, or lies in the plane of `flat` normal to the first two.
  struct Plane {
    std::size_t a, b, c;
    bool is_side = false;  ///< of a flat hull
    long double sign = 1;  ///< outward
    std::vector<bool> has{};
  };
  std::size_t count = 0;
  std::vector<Plane> planes;
  std::vector<std::pair<std::size_t, std::size_t>> edges;
  std::vector<std::pair<std::size_t, std::size_t>> directions;  ///< edges of which no two are parallel

  explicit Hull(std::span<const Vec3> points) : count(points.size()) {
    for (std::size_t a = 0; a < count; ++a)
      for (std::size_t b = a + 1; b < count; ++b)
        for (std::size_t c = b + 1; c < count; ++c) add({a, b, c}, points);
    if (!planes.empty() &&
        std::count(planes[0].has.begin(), planes[0].has.end(), true) == static_cast<std::ptrdiff_t>(count)) {
      const Plane flat = planes[0];
      for (std::size_t a = 0; a < count; ++a)
        for (std::size_t b = 0; b < count; ++b)
          if (a != b)
            add({a, b,
                 flat.a != a && flat.a != b   ? flat.a
                 : flat.b != a && flat.b != b ? flat.b
                                              : flat.c,
                 true},
                points);
    }
    for (std::size_t a = 0; a < count; ++a)
      for (std::size_t b = a + 1; b < count; ++b)
        if (count == 2 || shared(a, b) >= 2) edges.emplace_back(a, b);
    if (count == 1) edges.emplace_back(0, 0);
    const auto side = [&](const auto& edge) {
      return vector(points[edge.second]) - vector(points[edge.first]);
    };
    for (const auto& edge : edges)
      if (std::none_of(directions.begin(), directions.end(), [&](const auto& known) {
            return length(cross(side(edge), side(known))) <=
                   1e-12L * length(side(edge)) * length(side(known));
          }))
        directions.push_back(edge);
  }

  Vector normal(const Plane& plane, std::span<const Vec3> points) const {
    const Vector side = vector(points[plane.b]) - vector(points[plane.a]);
    Vector normal = cross(side, vector(points[plane.c]) - vector(points[plane.a]));
    if (plane.is_side) normal = cross(side, normal);
    return normal * (plane.sign / length(normal));
  }

 private:
  std::size_t shared(std::size_t a, std::size_t b) const {
    return static_cast<std::size_t>(std::count_if(
        planes.begin(), planes.end(), [&](const Plane& plane) { return plane.has[a] && plane.has[b]; }));
  }

  /// Adds the plane if no point is beyond it; both sides of that of a flat hull.
  void add(Plane plane, std::span<const Vec3> points) {
    const Vector side = vector(points[plane.b]) - vector(points[plane.a]);
    const Vector third = vector(points[plane.c]) - vector(points[plane.a]);
    if (!(length(cross(side, third)) > 1e-9L * length(side) * length(third))) return;
    long double least = 0, most = 0;
    const Vector n = normal(plane, points);
    plane.has.assign(count, false);
    for (std::size_t k = 0; k < count; ++k) {
      const long double above = dot(n, vector(points[k]) - vector(points[plane.a]));
      least = std::min(least, above);
      most = std::max(most, above);
      plane.has[k] = std::abs(above) < 1e-9L;
    }
    for (const long double sign : {1.0L, -1.0L}) {
      if ((sign > 0 ? most : -least) > 1e-9L) continue;
      plane.sign = sign;
      const bool is_known = std::any_of(planes.begin(), planes.end(), [&](const Plane& known) {
        return known.has == plane.has && dot(normal(known, points), n * sign) > 0.5L;
      });
      if (!is_known) planes.push_back(plane);
    }
  }
};

inline long double between_segments(const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
  const auto to_segment = [](const Vector& point, const Vector& from, const Vector& to) {
    const Vector way = to - from;
    const long double square = dot(way, way);
    const long double part = square > 0 ? std::clamp(dot(point - from, way) / square, 0.0L, 1.0L) : 0.0L;
    return length(point - (from + way * part));
  };
  long double least =
      std::min({to_segment(a, c, d), to_segment(b, c, d), to_segment(c, a, b), to_segment(d, a, b)});
  const Vector u = b - a;
  const Vector v = d - c;
  const Vector across = cross(u, v);
  const long double square = dot(across, across);
  if (!(square > 0)) return least;
  const long double s = dot(cross(c - a, v), across) / square;
  const long double t = dot(cross(c - a, u), across) / square;
  if (s >= 0 && s <= 1 && t >= 0 && t <= 1)
    least = std::min(least, std::abs(dot(c - a, across)) / std::sqrt(square));
  return least;
}

/// A hull where it is.
struct Placed {
  const Hull* hull;
  std::vector<Vec3> points;
  std::vector<Vector> normals, edges;  ///< edges of different directions
  std::vector<long double> offsets;

  Placed(const Hull& given, std::vector<Vec3> there) : hull(&given), points(std::move(there)) {
    for (const Hull::Plane& plane : hull->planes) {
      normals.push_back(hull->normal(plane, points));
      offsets.push_back(dot(normals.back(), vector(points[plane.a])));
    }
    for (const auto& [a, b] : hull->directions) edges.push_back(vector(points[b]) - vector(points[a]));
  }
};

/// Returns the distance, or minus the least way that would separate the two. Beyond `enough`, a lower limit
/// will do.
inline double signed_distance(const Placed& one, const Placed& other,
                              double enough = std::numeric_limits<double>::infinity()) {
  const auto along = [](const Placed& placed, const Vector& direction) {
    long double least = std::numeric_limits<long double>::infinity();
    for (const Vec3& point : placed.points) least = std::min(least, dot(direction, vector(point)));
    return least;
  };
  long double widest = -std::numeric_limits<long double>::infinity();
  const auto try_direction = [&](const Vector& direction) {
    widest = std::max(widest, along(one, direction) + along(other, direction * -1));
  };
  for (const Vector& normal : one.normals) try_direction(normal * -1);
  for (const Vector& normal : other.normals) try_direction(normal);
  if (widest > enough) return static_cast<double>(widest);
  for (const Vector& a : one.edges)
    for (const Vector& b : other.edges) {
      const Vector normal = cross(a, b);
      const long double size = length(normal);
      if (!(size > 1e-12L * length(a) * length(b))) continue;
      try_direction(normal * (1 / size));
      try_direction(normal * (-1 / size));
    }
  if (widest > enough) return static_cast<double>(widest);
  // Two segments or points overlap nowhere.
  if (widest < 0 && !(one.normals.empty() && other.normals.empty())) return static_cast<double>(widest);
  long double least = std::numeric_limits<long double>::infinity();
  const auto to_faces = [&](const Placed& from, const Placed& to) {
    for (const Vec3& point : from.points)
      for (std::size_t k = 0; k < to.normals.size(); ++k) {
        const long double above = dot(to.normals[k], vector(point)) - to.offsets[k];
        if (above < 0 || above >= least) continue;
        const Vector foot = vector(point) - to.normals[k] * above;
        bool is_inside = true;
        // The foot is in the planes of its own points but for rounding. Any slack beyond the others would let
        // it leave a sharp vertex by a multiple of the slack; a foot that rounding puts outside is on an
        // edge.
        for (std::size_t m = 0; m < to.normals.size() && is_inside; ++m)
          is_inside =
              to.hull->planes[m].has == to.hull->planes[k].has || dot(to.normals[m], foot) <= to.offsets[m];
        if (is_inside) least = above;
      }
  };
  to_faces(one, other);
  to_faces(other, one);
  for (const auto& [a, b] : one.hull->edges)
    for (const auto& [c, d] : other.hull->edges)
      least = std::min(least, between_segments(vector(one.points[a]), vector(one.points[b]),
                                               vector(other.points[c]), vector(other.points[d])));
  return static_cast<double>(least);
}

}  // namespace kinesphere::true_hulls
