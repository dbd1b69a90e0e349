// The space that bodies move in: all of it, a plane, or a box that repeats.
//
// On an axis that repeats, with the box's size L there as its period, a body at x is at x + n L for all whole
// n: its images. A body is kept in one of them: that in which the box around its way in its window, with the
// radius at the end of it and room for what the body senses, has its centre in the primary box. Two rules,
// the first on bodies and the second on these boxes, make sure that a pair has to be looked at in one image
// only. With r the radius of a body and how far it senses, e0 the error of its reports, and h the gap at
// which a contact has certainly ended (separation distance and tolerance):
//   (1) 2 r + 6 e0 + h <= 3/8 L, which a body with a third of the box for its diameter obeys;
//   (2) the box is narrower than L/2 - h - 4 e0: by (1) that leaves at least L/8 to move in (a little less,
//       for rounding: docs/guarantee.md). Windows are chosen so short that it is.
// By (2) the centres of two boxes that overlap are less than L/2 apart on every axis that repeats, so they
// overlap in one image at most, and it is that in which the centres are nearest. The same image is the one in
// which the bodies touch, also where they have moved apart up to h and their boxes do not overlap any more:
// reports are within e0 of the bodies, so the centres of the boxes are at most half of both widths, h and
// 2 e0 of each body apart, which is less than L/2 again. By (1) two bodies that touch in one image, with
// their centres at most 3/8 L apart, are at least 5/8 L apart in all others.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "kinesphere/world_definition.hpp"

namespace kinesphere {

class Space {
 public:
  /// All of it.
  Space() = default;
  /// Of a world whose definition has been checked.
  explicit Space(const WorldDefinition& definition);

  bool is_flat() const { return flat_; }
  bool repeats() const { return repeats_; }
  bool repeats(int axis) const { return period_[axis] > 0.0; }
  /// Zero on axes that do not repeat.
  const Vec3& period() const { return period_; }

  /// Whole periods that bring `from` to its image nearest to `to`: a shift, to be added to `from`.
  Vec3 shift_to_nearest(const Vec3& from, const Vec3& to) const {
    Vec3 shift;
    if (!repeats_) return shift;
    for (int axis = 0; axis < 3; ++axis)
      if (repeats(axis))
        shift[axis] = std::floor((to[axis] - from[axis]) * per_period_[axis] + 0.5) * period_[axis];
    return shift;
  }
  /// The same for points in the primary box, or hardly outside.
  Vec3 shift_between_homes(const Vec3& from, const Vec3& to) const {
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
  /// A point as its image in the primary box, lower <= position < upper, and the shift from there to where it
  /// is, in whole periods: point = position + shift_of(images).
  struct Wrapped {
    Vec3 position;
    Vec3 images;
  };
  Wrapped wrapped(const Vec3& point) const;

  /// The part of a box that is in space.
  Box within(Box box) const {
    if (flat_) box.lower.z = box.upper.z = 0.0;
    return box;
  }
  /// Narrower than half the period.
  bool is_narrow(const Box& box) const;
  /// Calls visit(shift) for each shift in whole periods that makes `box` overlap `other`. Both are at most a
  /// few periods wide.
  template <class Visit>
  void for_each_shift(const Box& box, const Box& other, Visit visit) const;

  /// Calls visit(image, shift) for each image of a box that may overlap one of this extent at most with its
  /// centre in the primary box: the box itself where space does not repeat.
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
  /// Those of a box that come near the primary box.
  struct Images {
    Box box;
    Vec3 first{};  ///< shift in periods
    std::array<int, 3> count{1, 1, 1};
  };

  Images images_near(const Box& box, double largest_extent) const;
  static Box moved(const Box& box, const Vec3& shift);

  Vec3 lower_{};
  Vec3 upper_{};
  Vec3 period_{};
  Vec3 per_period_{};  ///< 1 / period; 0 where there is none
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
