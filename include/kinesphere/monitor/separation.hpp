// How far apart two tracks are to be, and what is certain of it.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

namespace kinesphere {

/// Two tracks are *within* a separation when one is inside this region around the other, counted from
/// position to position.
struct Separation {
  enum class Shape {
    ellipsoid,  ///< (horizontal distance / horizontal)^2 + (vertical distance / vertical)^2 <= 1
    cylinder,   ///< horizontal distance <= horizontal, and vertical distance <= vertical
  };
  Shape shape = Shape::ellipsoid;
  double horizontal = 0.0;  ///< length, > 0
  double vertical = 0.0;    ///< length, > 0; of no meaning in two dimensions

  static constexpr Separation sphere(double distance) { return {Shape::ellipsoid, distance, distance}; }
  static constexpr Separation ellipsoid(double horizontal, double vertical) {
    return {Shape::ellipsoid, horizontal, vertical};
  }
  static constexpr Separation cylinder(double horizontal, double vertical) {
    return {Shape::cylinder, horizontal, vertical};
  }

  friend constexpr bool operator==(const Separation&, const Separation&) = default;

  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    auto& [shape, horizontal, vertical] = self;
    archive(shape, horizontal, vertical);
  }
};

/// What the reports so far say of two tracks and a separation at one time.
enum class Verdict {
  apart,      ///< certainly not within it
  undecided,  ///< the reports leave it open
  within,     ///< certainly within it, or no farther outside than the tolerance
};

/// Which separations count between the tracks of two classes. The first is the widest that is told of, say a
/// caution, the last an alarm: a pair is told of each by its number in this list, its level.
struct SeparationRule {
  std::size_t first_class = 0;
  std::size_t second_class = 0;
  std::vector<Separation> levels;
};

}  // namespace kinesphere
