// The space in which bodies move: unbounded, a plane, or a box that repeats.
//
// On an axis that repeats, the box's size L there is the period. A body at x is also at x + n L for all whole
// n: its images. The world keeps one image of each body. For that image, take the box around the body's safe
// region, with its radius and the margin for what the body senses: the centre of this box lies in the primary
// box. Two rules, (1) on bodies and (2) on these boxes, ensure that a pair has
// to be examined in one image only. Let r be the radius of a body plus its sensing distance, e0 the error of
// its reports, and h the gap at which a contact has certainly ended (separation distance and tolerance):
//   (1) 2 r + 6 e0 + h <= 3/8 L, which a body with a third of the box for its diameter obeys;
//   (2) the box is narrower than L/2 - h - 4 e0: by (1) that leaves at least L/8 to move in (a little less,
//       for rounding: docs/guarantee.md). Safe regions are chosen so small that rule (2) holds.
// By (2) the centres of two boxes that overlap are less than L/2 apart on every axis that repeats. The boxes
// therefore overlap in at most one image, the one in which their centres are nearest. Bodies that touch do so
// in this image too, even when they have moved apart up to h and their boxes no longer overlap: reports are
// within e0 of the bodies, so the centres of the boxes are at most half of the two widths, h and 2 e0 of each
// body apart, which is again less than L/2. By (1) two bodies that touch in one image, with their centres at
// most 3/8 L apart, are at least 5/8 L apart in all others.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "kinesphere/world_definition.hpp"

namespace kinesphere {

class Space {
 public:
  /// Unbounded space with three dimensions.
  Space() = default;
  /// Space of a world. Precondition: the definition has been checked.
  explicit Space(const WorldDefinition& definition);

  bool is_flat() const { return flat_; }
  bool repeats() const { return repeats_; }
  bool repeats(int axis) const { return period_[axis] > 0.0; }
  /// Period of each axis (length); 0 on axes that do not repeat.
  const Vec3& period() const { return period_; }

  /// Returns the shift, in whole periods, that added to `from` gives its image nearest to `to`.
  Vec3 shift_to_nearest(const Vec3& from, const Vec3& to) const {
    Vec3 shift;
    if (!repeats_) return shift;
    for (int axis = 0; axis < 3; ++axis)
      if (repeats(axis))
        shift[axis] = std::floor((to[axis] - from[axis]) * per_period_[axis] + 0.5) * period_[axis];
    return shift;
  }
  /// Returns the shift that shift_to_nearest() returns, by comparisons only. Precondition: the points lie in
  /// the primary box, or hardly outside.
  Vec3 shift_between_images(const Vec3& from, const Vec3& to) const {
    const auto shift = [](double way, double period) {
      if (way > 0.5 * period) return -period;
      return way < -0.5 * period ? period : 0.0;
    };
    const auto on_axis = [&](int axis) {
      return repeats(axis) ? shift(from[axis] - to[axis], period_[axis]) : 0.0;
    };
    return {on_axis(0), on_axis(1), on_axis(2)};
  }
  Vec3 shift_of(const Vec3& images) const {
    return {images.x * period_.x, images.y * period_.y, images.z * period_.z};
  }
  /// A point given by its image in the primary box, lower <= position < upper, and the number of whole
  /// periods from there to the point: point = position + shift_of(images).
  struct Wrapped {
    Vec3 position;
    Vec3 images;
  };
  Wrapped wrapped(const Vec3& point) const {
    return is_primary(point) ? Wrapped{point, {}} : wrapped_from_outside(point);
  }

  /// Returns the part of a box that lies in this space.
  Box within(Box box) const {
    if (flat_) box.lower.z = box.upper.z = 0.0;
    return box;
  }
  /// True if the box is narrower than half the period on each axis that repeats.
  bool is_narrow(const Box& box) const;
  /// Calls visit(shift) for each shift in whole periods that makes `box` overlap `other`. Precondition: each
  /// box is at most a few periods wide.
  template <class Visit>
  void for_each_shift(const Box& box, const Box& other, Visit visit) const;

  /// Calls visit(image, shift) for each image of `box` that may overlap a box whose extent is at most
  /// `largest_extent` and whose centre lies in the primary box. Where space does not repeat, that is `box`
  /// itself.
  template <class Visit>
  void for_each_image(const Box& box, double largest_extent, Visit visit) const {
    if (!repeats_) return visit(within(box), Vec3{});
    const Images images = images_near(box, largest_extent);
    for (int z = 0; z < images.count[2]; ++z)
      for (int y = 0; y < images.count[1]; ++y)
        for (int x = 0; x < images.count[0]; ++x) {
          const Vec3 shift = shift_of(images.first + Vec3{double(x), double(y), double(z)});
          visit(moved(images.box, shift), shift);
        }
  }

 private:
  /// The images of a box that come near the primary box.
  struct Images {
    Box box;
    Vec3 first{};  ///< shift of the first image, in periods
    std::array<int, 3> count{1, 1, 1};
  };

  /// True if the point lies in the primary box, as far as space repeats.
  bool is_primary(const Vec3& point) const {
    const auto on_axis = [&](int axis) { return lower_[axis] <= point[axis] && point[axis] < upper_[axis]; };
    return !repeats_ ||
           ((on_axis(0) || !repeats(0)) && (on_axis(1) || !repeats(1)) && (on_axis(2) || !repeats(2)));
  }
  [[gnu::cold]] Wrapped wrapped_from_outside(const Vec3& point) const;
  Images images_near(const Box& box, double largest_extent) const;
  static Box moved(const Box& box, const Vec3& shift);

  Vec3 lower_{};
  Vec3 upper_{};
  Vec3 period_{};
  Vec3 per_period_{};  ///< 1 / period; 0 on axes that do not repeat
  bool repeats_ = false;
  bool flat_ = false;
};

template <class Visit>
void Space::for_each_shift(const Box& box, const Box& other, Visit visit) const {
  if (!repeats_) return visit(Vec3{});
  Vec3 first;
  std::array<int, 3> count{1, 1, 1};
  for (int axis = 0; axis < 3; ++axis) {
    if (!repeats(axis)) continue;
    first[axis] = std::ceil((other.lower[axis] - box.upper[axis]) * per_period_[axis]);
    const double last = std::floor((other.upper[axis] - box.lower[axis]) * per_period_[axis]);
    count[static_cast<std::size_t>(axis)] = static_cast<int>(std::clamp(last - first[axis] + 1.0, 0.0, 64.0));
  }
  for (int z = 0; z < count[2]; ++z)
    for (int y = 0; y < count[1]; ++y)
      for (int x = 0; x < count[0]; ++x) visit(shift_of(first + Vec3{double(x), double(y), double(z)}));
}

}  // namespace kinesphere
