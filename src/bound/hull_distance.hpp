// Nearest points of two convex hulls of points, and the direction between them. Certificates stay true for
// any points and any direction; accurate ones make them last longer.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "kinesphere/shape.hpp"

namespace kinesphere {

/// Nearest points of two hulls, each as a mean of at most four points of its hull.
struct NearestInHulls {
  struct Pair {
    std::uint32_t first = 0;
    std::uint32_t second = 0;
    double weight = 0.0;
  };
  std::array<Pair, 4> pairs{};
  std::size_t count = 0;
  double distance = 0.0;  ///< 0 if the hulls overlap
  double size = 0.0;      ///< magnitude of the coordinates (length)
  Vec3 normal;            ///< unit vector from the second towards the first, also if they overlap

  /// True if the hulls overlap, or are so near that certificates could not tell.
  bool overlap() const { return distance <= 0x1p-40 * size; }
  /// Returns the mean in the first hull, whose points point_at(number) gives.
  template <class PointAt>
  Vec3 in_first(PointAt point_at) const {
    Vec3 mean;
    for (std::size_t k = 0; k < count; ++k) mean += point_at(pairs[k].first) * pairs[k].weight;
    return mean;
  }
};

/// By the method of Gilbert, Johnson and Keerthi. Precondition: neither is empty, and all points are finite.
/// Cost: some ten passes over all points.
NearestInHulls nearest_in_hulls(std::span<const Vec3> first, std::span<const Vec3> second);

/// Corners of a solid, or of the part of it that can be nearest to some points. What is left of a large box
/// makes smaller rounding errors.
class Corners {
 public:
  void add(const Vec3& corner) { corners_[count_++] = corner; }
  std::span<const Vec3> all() const { return std::span(corners_).first(count_); }

 private:
  std::array<Vec3, 8> corners_;
  std::size_t count_ = 0;
};
Corners corners_near(std::span<const Vec3> points, const Box& box);
Corners corners_near(std::span<const Vec3> points, const Triangle& triangle);

}  // namespace kinesphere
