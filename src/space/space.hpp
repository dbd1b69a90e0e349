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
//
// With WorldDefinition::shear_rate the images across y slide along x: the one that is n rows (periods of y)
// away is displaced by (n S(t), n L_y), and moves by n V along x, where V is the shear rate times L_y, and S
// is V times the time since the world began. So a shift between images holds at a time, and has a velocity.
// S is reduced by whole periods of x, which leads to other images of the same row. What is said above holds
// on y. It holds on x, too, as images slide by no more than `most_slide` periods while a pair is examined in
// one of them, and safe regions are so much narrower there (core/safe_regions.cpp).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "kinesphere/bound.hpp"
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

  // Images that slide.
  bool slides() const { return slides_; }
  /// Speed along x (length / time) of the next row of images, up y, against that of the primary box.
  double slide_speed() const { return slide_speed_; }
  /// Returns how far (length) the next row of images, up y, is displaced along x at a time, less whole
  /// periods: at most half of one, but for rounding, which is relative to the period. Requires slides().
  double slide_at(double time) const;
  /// Images slide by at most this part of the period of x while one search, or one shift, is relied on.
  static constexpr double most_slide = 0.05;
  /// Returns how many rows up y a shift leads, and the velocity of the image to which it leads.
  double rows_of(const Vec3& shift) const { return std::round(shift.y * per_period_.y); }
  Vec3 velocity_of(const Vec3& shift) const { return {slide_speed_ * rows_of(shift), 0.0, 0.0}; }
  /// Move a state or a bound to another image, by a shift at the time of the state, or at `now`.
  void move(State& state, const Vec3& shift) const {
    state.position += shift;
    if (slides()) [[unlikely]]
      state.velocity += velocity_of(shift);
  }
  void move(Bound& bound, const Vec3& shift, double now) const {
    bound.position += shift;
    if (slides()) [[unlikely]] {
      const Vec3 velocity = velocity_of(shift);
      bound.position -= velocity * (now - bound.time);
      bound.velocity += velocity;
    }
  }
  /// Returns the velocity that a body with this velocity at `from` has in its image in the row of `to`.
  Vec3 velocity_in_row(const Vec3& velocity, const Vec3& from, const Vec3& to) const {
    if (slides()) [[unlikely]]
      return velocity + velocity_of(to - from);
    return velocity;
  }

  /// Returns the shift at a time, in whole periods, that added to `from` gives its image nearest to `to`;
  /// where images slide, the nearest one of the nearest row.
  Vec3 shift_to_nearest(const Vec3& from, const Vec3& to, double time) const {
    Vec3 shift;
    if (!repeats_) return shift;
    if (slides()) [[unlikely]]
      return sliding_shift(from, to, time);
    for (int axis = 0; axis < 3; ++axis)
      if (repeats(axis))
        shift[axis] = std::floor((to[axis] - from[axis]) * per_period_[axis] + 0.5) * period_[axis];
    return shift;
  }
  /// Returns the shift that shift_to_nearest() returns, by comparisons only. Precondition: the points lie in
  /// the primary box, or hardly outside.
  Vec3 shift_between_images(const Vec3& from, const Vec3& to, double time) const {
    if (slides()) [[unlikely]]
      return sliding_shift(from, to, time);
    const auto shift = [](double way, double period) {
      if (way > 0.5 * period) return -period;
      return way < -0.5 * period ? period : 0.0;
    };
    const auto on_axis = [&](int axis) {
      return repeats(axis) ? shift(from[axis] - to[axis], period_[axis]) : 0.0;
    };
    return {on_axis(0), on_axis(1), on_axis(2)};
  }
  /// Calls visit(shift) as shift_to_nearest() would return it and, where images slide, also for the nearest
  /// image of each other row that may be nearer to a region around `to` with this height (length, on y).
  template <class Visit>
  void for_each_near_row(const Vec3& from, const Vec3& to, double height, double time, Visit visit) const;
  /// Returns the shift at a time by so many images, and the images that a shift leads to. Where images slide,
  /// those on x are counted from where V times the time since the world began would be.
  Vec3 shift_of(const Vec3& images, double time) const {
    const double across = slides() ? images.y * slide_at(time) : 0.0;
    const double along = slides() ? images.x + images.y * turns_at(time) : images.x;
    return {along * period_.x + across, images.y * period_.y, images.z * period_.z};
  }
  Vec3 images_of(const Vec3& shift, double time) const;
  /// A point at a time given by its image in the primary box, lower <= position < upper, and the number of
  /// whole periods from there to the point: point = position + shift_of(images).
  struct Wrapped {
    Vec3 position;
    Vec3 images;
  };
  Wrapped wrapped(const Vec3& point, double time) const {
    return is_primary(point) ? Wrapped{point, {}} : wrapped_from_outside(point, time);
  }
  /// Moves a state at a time to the image in which it lies in the primary box.
  void wrap(State& state, double time) const {
    if (is_primary(state.position)) return;
    const Wrapped place = wrapped_from_outside(state.position, time);
    if (slides()) state.velocity -= velocity_of({0.0, place.images.y * period_.y, 0.0});
    state.position = place.position;
  }

  /// Returns the part of a box that lies in this space.
  Box within(Box box) const {
    if (flat_) box.lower.z = box.upper.z = 0.0;
    return box;
  }
  /// True if the box is narrower than half the period on each axis that repeats.
  bool is_narrow(const Box& box) const;
  /// Calls visit(shift) for each shift in whole periods that makes `box` overlap `other`. Precondition: each
  /// box is at most a few periods wide, and images do not slide.
  template <class Visit>
  void for_each_shift(const Box& box, const Box& other, Visit visit) const;

  /// Calls visit(image, shift) for each image of `box` at a time that may overlap a box whose extent is at
  /// most `largest_extent` and whose centre lies in the primary box. Where space does not repeat, that is
  /// `box` itself.
  template <class Visit>
  void for_each_image(const Box& box, double largest_extent, double time, Visit visit) const {
    if (!repeats_) return visit(within(box), Vec3{});
    const Images images = images_near(box, largest_extent);
    for (int z = 0; z < images.count[2]; ++z)
      for (int y = 0; y < images.count[1]; ++y) {
        const double row = images.first.y + double(y);
        const Vec3 slid{slides() ? row * slide_at(time) : 0.0, 0.0, 0.0};
        const Images of_row = slides() ? images_near(moved(box, slid), largest_extent) : images;
        for (int x = 0; x < of_row.count[0]; ++x) {
          const Vec3 shift = periods({of_row.first.x + double(x), row, images.first.z + double(z)});
          visit(moved(of_row.box, shift), shift + slid);
        }
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
  [[gnu::cold]] Wrapped wrapped_from_outside(const Vec3& point, double time) const;
  Images images_near(const Box& box, double largest_extent) const;
  static Box moved(const Box& box, const Vec3& shift);
  Vec3 periods(const Vec3& counts) const {
    return {counts.x * period_.x, counts.y * period_.y, counts.z * period_.z};
  }
  [[gnu::cold]] Vec3 sliding_shift(const Vec3& from, const Vec3& to, double time) const;
  double turns_at(double time) const;

  Vec3 lower_{};
  Vec3 upper_{};
  Vec3 period_{};
  Vec3 per_period_{};  ///< 1 / period; 0 on axes that do not repeat
  double slide_speed_ = 0.0;
  double start_ = 0.0;  ///< when images had slid by nothing
  bool repeats_ = false;
  bool slides_ = false;
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
      for (int x = 0; x < count[0]; ++x) visit(periods(first + Vec3{double(x), double(y), double(z)}));
}

template <class Visit>
void Space::for_each_near_row(const Vec3& from, const Vec3& to, double height, double time,
                              Visit visit) const {
  const Vec3 shift = shift_to_nearest(from, to, time);
  visit(shift);
  if (!slides()) return;
  const Vec3 way = to - from - shift;
  const double reach = (0.5 * height + std::abs(way.x) + std::abs(way.y)) * (1.0 + 0x1p-20);
  for (const double side : {-1.0, 1.0})
    for (double row = side; std::abs(way.y - row * period_.y) <= reach; row += side)
      visit(shift_to_nearest(from, {to.x, from.y + shift.y + row * period_.y, to.z}, time));
}

}  // namespace kinesphere
