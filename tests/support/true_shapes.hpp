// Gaps of two shapes of which one is carried, by other formulas than the library's.
#pragma once

#include <algorithm>
#include <variant>
#include <vector>

#include "support/placed_parts.hpp"

namespace kinesphere::true_shapes {

/// The convex parts of a box, a triangle or a mesh that a body carries, analysed once.
class CarriedHulls {
 public:
  explicit CarriedHulls(const Shape& shape) {
    if (const auto* box = std::get_if<Box>(&shape)) parts_.push_back(box_part(*box, 0.0));
    if (const auto* triangle = std::get_if<Triangle>(&shape)) add(*triangle);
    if (const auto* mesh = std::get_if<Mesh>(&shape))
      for (std::size_t k = 0; k < mesh->size(); ++k) add(mesh->triangle(k));
    for (const RigidPart& part : parts_) hulls_.emplace_back(placed_parts::points_of(part));
  }

  const std::vector<RigidPart>& parts() const { return parts_; }

  /// Returns the gap to a shape, which may be carried: minus the depth where parts overlap. Beyond `enough`,
  /// a lower limit will do.
  double gap(const Vec3& position, const Shape& other, const Vec3& origin, double enough) const {
    double least = infinity;
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      const placed_parts::PlacedPart part(parts_[k], hulls_[k], position, {});
      // A negative distance of a point in a solid is a depth, not a lower limit.
      const double near = placed_parts::distance_of(other, part.middle - origin) - part.reach;
      if (near > enough) {
        least = std::min(least, near);
      } else {
        least = std::min(least, placed_parts::gap_of(part, other, origin, true, enough));
      }
    }
    return least;
  }

 private:
  void add(const Triangle& t) { parts_.push_back(hull_part(std::vector{t.a, t.b, t.c}, 0.0)); }

  std::vector<RigidPart> parts_;
  std::vector<true_hulls::Hull> hulls_;
};

}  // namespace kinesphere::true_shapes
