// In which image a body is, where space repeats.
//
// The image in which two bodies can meet is the one in which the middles of their capsules are nearest
// (space/space.hpp). A body's bound is in one image: reports are moved to that nearest to the bound, and a
// new capsule brings both home to the primary box. Of fixed bodies there are only balls there, which are
// bounds at rest.
#pragma once

#include <algorithm>
#include <cmath>

#include "space/space.hpp"

namespace kinesphere {

struct PeriodicImage {
  Vec3 middle{};  ///< of the body's capsule, which tells in which image it can meet others
  /// Largest magnitude of an image count; fits into 64 bits.
  static constexpr double most_images = 0x1p62;

  /// Whole numbers: bound.position + image * period is on the path since the caller placed the body.
  Vec3 image{};

  /// The capsule goes home, from around a way: the shift from there to where it was.
  Vec3 wrap(const Space& space, const Box& way) {
    const auto [home, images] = space.wrapped(0.5 * (way.lower + way.upper));
    middle = home;
    if (images == Vec3{}) return {};
    image += images;
    // Counts saturate: at times that cannot tell a period from the next, ways are as long as any number of
    // periods.
    for (int axis = 0; axis < 3; ++axis) image[axis] = std::clamp(image[axis], -most_images, most_images);
    return space.shift_of(images);
  }
  /// Whole numbers, and none on axes that do not repeat; the middle is a point.
  bool is_valid(const Space& space) const {
    if (!is_finite(middle)) return false;
    for (int axis = 0; axis < 3; ++axis) {
      if (!(std::abs(image[axis]) <= most_images) || std::floor(image[axis]) != image[axis]) return false;
      if (!space.repeats(axis) && image[axis] != 0.0) return false;
    }
    return true;
  }
  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    auto& [of_capsule, images] = self;
    archive(of_capsule, images);
  }
};

}  // namespace kinesphere
