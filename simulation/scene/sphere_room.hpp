// A box for spheres, with walls or periodic, and the spheres that have a place in it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "kinesphere/random.hpp"
#include "kinesphere/vec3.hpp"
#include "simulation/grid/hash_grid.hpp"

namespace kinesphere {

/// Centres of spheres in a box. In a periodic box they may be anywhere, and spheres meet the images of
/// others.
class SphereRoom {
 public:
  /// `clearance` (length) is kept free between spheres, and between spheres and walls.
  SphereRoom(const std::vector<double>& radii, const Box& box, double clearance, bool periodic)
      : radii_(radii),
        box_(box),
        clearance_(clearance),
        largest_reach_(radii.empty() ? 0.0 : *std::max_element(radii.begin(), radii.end()) + clearance),
        periodic_(periodic),
        centres_(radii.size()) {}

  const std::vector<Vec3>& centres() const { return centres_; }
  double radius(std::uint32_t sphere) const { return radii_[sphere]; }
  /// Returns the least distance of two centres without overlap (length).
  double least_distance(std::uint32_t a, std::uint32_t b) const { return radii_[a] + radii_[b] + clearance_; }

  /// Returns where the centre of a sphere may be, or nothing if the sphere has no room.
  std::optional<Box> range(std::uint32_t sphere) const {
    const double reach = radii_[sphere] + clearance_;
    const Vec3 half{reach, reach, reach};
    const Box inside{box_.lower + half, box_.upper - half};
    if (!(inside.lower.x <= inside.upper.x && inside.lower.y <= inside.upper.y &&
          inside.lower.z <= inside.upper.z))
      return std::nullopt;
    return periodic_ ? box_ : inside;
  }
  static Vec3 random_point(const Box& range, Random& random) {
    return {random.uniform(range.lower.x, range.upper.x), random.uniform(range.lower.y, range.upper.y),
            random.uniform(range.lower.z, range.upper.z)};
  }

  /// Moves a sphere to a centre, or to the nearest one within its range; in a periodic box to its image in
  /// the box. Precondition: the sphere has a range.
  void move_to(std::uint32_t sphere, Vec3 centre) {
    const Box inside = *range(sphere);
    for (int axis = 0; axis < 3; ++axis) {
      if (!periodic_) {
        centre[axis] = std::clamp(centre[axis], inside.lower[axis], inside.upper[axis]);
      } else if (centre[axis] < inside.lower[axis]) {
        centre[axis] += inside.upper[axis] - inside.lower[axis];
      } else if (centre[axis] >= inside.upper[axis]) {
        centre[axis] -= inside.upper[axis] - inside.lower[axis];
      }
    }
    centres_[sphere] = centre;
    grid_.set(sphere, around(sphere, centre));
  }

  /// Returns the vector from a point of the box to the centre of a sphere; in a periodic box, to its nearest
  /// image.
  Vec3 offset(const Vec3& from, std::uint32_t sphere) const {
    Vec3 offset = centres_[sphere] - from;
    if (!periodic_) return offset;
    for (int axis = 0; axis < 3; ++axis) {
      const double size = box_.upper[axis] - box_.lower[axis];
      offset[axis] -= size * std::round(offset[axis] / size);
    }
    return offset;
  }

  /// Calls visit(other) for each sphere with a place that might overlap this one at `centre`, once or, in a
  /// periodic box, once for each of its images. Visits the sphere itself if it has a place. `visit` may not
  /// move spheres.
  template <class Visit>
  void for_each_near(std::uint32_t sphere, const Vec3& centre, Visit visit) const {
    const Box near = around(sphere, centre);
    const auto visit_image = [&](const Vec3& shift) {
      grid_.for_each_overlap({near.lower + shift, near.upper + shift}, visit);
    };
    if (!periodic_) return visit_image({});
    const Vec3 size = box_.upper - box_.lower;
    const auto first = [&](int axis) {
      return near.upper[axis] + largest_reach_ > box_.upper[axis] ? -1 : 0;
    };
    const auto last = [&](int axis) { return near.lower[axis] - largest_reach_ < box_.lower[axis] ? 1 : 0; };
    for (int x = first(0); x <= last(0); ++x)
      for (int y = first(1); y <= last(1); ++y)
        for (int z = first(2); z <= last(2); ++z) visit_image({x * size.x, y * size.y, z * size.z});
  }

 private:
  Box around(std::uint32_t sphere, const Vec3& centre) const {
    const double reach = radii_[sphere] + clearance_;
    const Vec3 half{reach, reach, reach};
    return {centre - half, centre + half};
  }

  const std::vector<double>& radii_;
  Box box_;
  double clearance_;
  double largest_reach_;
  bool periodic_;
  HashGrid grid_;
  std::vector<Vec3> centres_;
};

}  // namespace kinesphere
