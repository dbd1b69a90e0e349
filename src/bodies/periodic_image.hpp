// PeriodicImage records which image of a body is stored in periodic space.
//
// Two bodies can meet in the image in which the centres of their safe regions are nearest (space/space.hpp).
// A bound is in one image: a report is shifted to the image nearest to the bound, and each new safe region
// moves both to the primary box. The only static bodies in periodic space are balls, whose bounds stand
// still.
#pragma once

#include <algorithm>
#include <cmath>

#include "space/space.hpp"

namespace kinesphere {

struct PeriodicImage {
  /// centre of the body's safe region; it selects the image in which the body can meet others
  Vec3 middle{};
  /// Largest magnitude of an image count; fits into 64 bits.
  static constexpr double most_images = 0x1p62;

  /// Whole numbers: bound.position + image * period is on the path since the caller placed the body. Where
  /// images slide: bound.position + Space::shift_of(image).
  Vec3 image{};

  /// Moves the image of a body with this centre at a time to the primary box. Returns the shift from the new
  /// position to the old one.
  Vec3 wrap(const Space& space, const Vec3& place, double time) {
    const auto [centre, images] = space.wrapped(place, time);
    middle = centre;
    if (images == Vec3{}) return {};
    count(images);
    return space.shift_of(images, time);
  }
  /// The body at `place` goes on in the image in which it is nearest to `centre`, a point in the primary box.
  /// Returns the shift from the old position to the new one.
  Vec3 follow(const Space& space, const Vec3& place, const Vec3& centre, double time) {
    middle = centre;
    const Vec3 shift = space.shift_to_nearest(place, centre, time);
    if (shift != Vec3{}) count(-space.images_of(shift, time));
    return shift;
  }
  /// Returns true if the counts are whole numbers, zero on axes that are not periodic, and the centre is
  /// finite.
  bool is_valid(const Space& space) const {
    if (!is_finite(middle)) return false;
    for (int axis = 0; axis < 3; ++axis) {
      if (!(std::abs(image[axis]) <= most_images) || std::floor(image[axis]) != image[axis]) return false;
      if (!space.repeats(axis) && image[axis] != 0.0) return false;
    }
    return true;
  }

 private:
  /// Counts saturate, because paths span any number of periods at times too coarse to distinguish periods.
  void count(const Vec3& images) {
    for (int axis = 0; axis < 3; ++axis)
      image[axis] = std::clamp(image[axis] + images[axis], -most_images, most_images);
  }
};

}  // namespace kinesphere
