#include "bound/hull_distance.hpp"

#include <algorithm>

#include "bound/triangle.hpp"
#include "number/infinity.hpp"

namespace kinesphere {
namespace {

/// A difference of a point of the first hull and one of the second. The distance of the hulls is that of the
/// hull of all differences from the origin.
struct Difference {
  Vec3 vector;
  std::uint32_t first = 0;
  std::uint32_t second = 0;
};

/// Some differences with weights, and their mean.
struct Simplex {
  std::array<Difference, 4> corners{};
  std::array<double, 4> weights{};  ///< >= 0, of any sum
  std::size_t count = 0;
  double distance = infinity;  ///< of the mean from the origin
  Vec3 normal;                 ///< from the origin towards the mean, or zero

  void add(const Difference& corner, double weight) {
    corners[count] = corner;
    weights[count++] = weight;
  }
  bool contains(const Difference& corner) const {
    return std::any_of(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(count),
                       [&](const Difference& own) { return own.vector == corner.vector; });
  }
  void set_mean(const Vec3& mean) {
    distance = norm(mean);
    normal = distance > 0.0 ? mean / distance : Vec3{};
  }
};

// The points of simplices that are nearest to the origin, with the corners of which they are means.

Simplex nearest_of(const Difference& a) {
  Simplex found;
  found.add(a, 1.0);
  found.set_mean(a.vector);
  return found;
}

Simplex nearest_of(const Difference& a, const Difference& b) {
  const Vec3 side = b.vector - a.vector;
  const double square = norm_squared(side);
  const double part = square > 0.0 ? -dot(a.vector, side) / square : 0.0;
  if (!(part > 0.0)) return nearest_of(a);
  if (part >= 1.0) return nearest_of(b);
  Simplex found;
  found.add(a, 1.0 - part);
  found.add(b, part);
  Vec3 mean = a.vector + side * part;
  mean -= side * (dot(mean, side) / square);
  found.set_mean(mean);
  return found;
}

/// Three differences.
class Face {
 public:
  Face(const Difference& a, const Difference& b, const Difference& c)
      : given_{&a, &b, &c},
        frame_({a.vector, b.vector, c.vector}),
        // The frame numbers the corners from one of them on.
        start_(frame_.origin() == a.vector   ? 0
               : frame_.origin() == b.vector ? 1
                                             : 2) {}

  Simplex nearest() const {
    const double height = above(Vec3{});
    const PlaneVector place = frame_.in_plane(-frame_.origin());
    if (!frame_.contains(place)) {
      const std::size_t side = nearest_on_sides(frame_, place).side;
      return nearest_of(corner(side), corner(side + 1));
    }
    Simplex found;
    for (std::size_t k = 0; k < 3; ++k) {
      const TriangleSide& opposite = frame_.sides()[(k + 1) % 3];
      found.add(corner(k), -opposite.beyond(place) * opposite.length);
    }
    found.distance = std::abs(height);
    found.normal = height < 0.0 ? frame_.normal() : -frame_.normal();
    return found;
  }
  /// Height of a point above the plane; accurate for thin triangles too.
  double above(const Vec3& point) const { return frame_.above_plane(point - frame_.origin()); }

 private:
  const Difference& corner(std::size_t k) const { return *given_[(start_ + k) % 3]; }

  std::array<const Difference*, 3> given_;
  TriangleFrame frame_;
  std::size_t start_;
};

Simplex nearest_of(const std::array<Difference, 4>& corners) {
  const auto& [a, b, c, d] = corners;
  const std::array<Face, 3> faces{Face(b, c, d), Face(a, c, d), Face(a, b, d)};
  // If the origin is inside, the weight of a corner is the part of its height that the origin has. Outside of
  // a flat tetrahedron the origin is higher.
  Simplex inside;
  inside.distance = 0.0;
  const auto add = [&](std::size_t k, const Face& opposite) {
    const double weight = opposite.above(Vec3{}) / opposite.above(corners[k].vector);
    if (weight > 0.0 && weight < 1.0) inside.add(corners[k], weight);
  };
  for (std::size_t k = 0; k < 3; ++k) add(k, faces[k]);
  if (inside.count == 3) add(3, Face(a, b, c));
  if (inside.count == 4) return inside;
  // The last corner is nearer to the origin than the plane of the others, so the nearest face has it.
  Simplex nearest;
  for (const Face& face : faces)
    if (const Simplex found = face.nearest(); found.distance < nearest.distance) nearest = found;
  return nearest;
}

Simplex with(const Simplex& simplex, const Difference& corner) {
  const auto& c = simplex.corners;
  switch (simplex.count) {
    case 0:
      return nearest_of(corner);
    case 1:
      return nearest_of(c[0], corner);
    case 2:
      return Face(c[0], c[1], corner).nearest();
    default:
      return nearest_of({c[0], c[1], c[2], corner});
  }
}

/// Returns the difference that is least along a direction.
Difference least_along(const Vec3& normal, std::span<const Vec3> first, std::span<const Vec3> second) {
  const auto farthest = [](std::span<const Vec3> points, const Vec3& direction) {
    std::uint32_t best = 0;
    double most = -infinity;
    for (std::uint32_t k = 0; k < points.size(); ++k) {
      const double along = dot(points[k], direction);
      if (!(along > most)) continue;
      most = along;
      best = k;
    }
    return best;
  };
  const std::uint32_t i = farthest(first, -normal);
  const std::uint32_t j = farthest(second, normal);
  return {first[i] - second[j], i, j};
}

Vec3 mean_of(std::span<const Vec3> points) {
  Vec3 sum;
  for (const Vec3& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

bool is_flat(std::span<const Vec3> points) {
  return std::all_of(points.begin(), points.end(), [](const Vec3& point) { return point.z == 0.0; });
}

double extent_of(std::span<const Vec3> points) {
  double largest = 0.0;
  for (const Vec3& point : points) largest = std::max(largest, norm_one(point));
  return largest;
}

}  // namespace

NearestInHulls nearest_in_hulls(std::span<const Vec3> first, std::span<const Vec3> second) {
  constexpr int most_steps = 64;
  const double size = extent_of(first) + extent_of(second);
  const double resolution = 0x1p-50 * size;
  const Vec3 between = mean_of(first) - mean_of(second);
  const double apart = norm(between);
  const Vec3 start = apart > 0.0 ? between / apart : Vec3{1.0, 0.0, 0.0};
  NearestInHulls nearest{.size = size, .normal = start};
  double widest = -infinity;
  /// Returns the difference that is least along a direction. The direction with the largest gap is kept.
  const auto try_direction = [&](const Vec3& normal) {
    const Difference corner = least_along(normal, first, second);
    if (const double gap = dot(corner.vector, normal); gap > widest) {
      widest = gap;
      nearest.normal = normal;
    }
    return corner;
  };
  Simplex simplex;
  simplex.normal = start;
  for (int step = 0; step < most_steps && simplex.distance > resolution; ++step) {
    const Difference corner = try_direction(simplex.normal);
    if (dot(corner.vector, simplex.normal) >= simplex.distance - resolution || simplex.contains(corner))
      break;
    const Simplex next = with(simplex, corner);
    if (!(next.distance < simplex.distance)) break;
    simplex = next;
  }
  if (simplex.distance <= resolution && simplex.normal != Vec3{} && !(is_flat(first) && is_flat(second))) {
    // Rounding hides on which side the origin is. In the plane z = 0 it may be in a triangle.
    try_direction(simplex.normal);
    try_direction(-simplex.normal);
  }
  nearest.distance = simplex.distance;
  // Rounded weights may have a sum other than 1, above all those of flat simplices: so divide them by it.
  double sum = 0.0;
  for (std::size_t k = 0; k < simplex.count; ++k) sum += simplex.weights[k];
  for (std::size_t k = 0; k < simplex.count; ++k)
    nearest.pairs[nearest.count++] = {simplex.corners[k].first, simplex.corners[k].second,
                                      simplex.weights[k] / sum};
  return nearest;
}

Corners corners_near(std::span<const Vec3> points, const Box& box) {
  // The point of a box that is nearest to another one has the coordinates of that, as far as the box reaches.
  Box part;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [least, most] = std::minmax_element(
        points.begin(), points.end(), [axis](const Vec3& a, const Vec3& b) { return a[axis] < b[axis]; });
    part.lower[axis] = std::clamp((*least)[axis], box.lower[axis], box.upper[axis]);
    part.upper[axis] = std::clamp((*most)[axis], box.lower[axis], box.upper[axis]);
  }
  Corners corners;
  for (const double x : {part.lower.x, part.upper.x})
    for (const double y : {part.lower.y, part.upper.y})
      for (const double z : {part.lower.z, part.upper.z}) corners.add({x, y, z});
  return corners;
}

Corners corners_near(std::span<const Vec3>, const Triangle& triangle) {
  Corners corners;
  for (const Vec3& corner : {triangle.a, triangle.b, triangle.c}) corners.add(corner);
  return corners;
}

}  // namespace kinesphere
