// Separations between tracks, and verdicts about them.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

namespace kinesphere {

/// A region around a track. Two tracks are *within* a separation if the position of one lies in this region
/// around the position of the other. For well_clear the region depends on their velocities.
struct Separation {
  /// When two tracks are within the separation.
  enum class Shape {
    ellipsoid,  ///< (horizontal distance / horizontal)^2 + (vertical distance / vertical)^2 <= 1
    cylinder,   ///< horizontal distance <= horizontal, and vertical distance <= vertical
    /// Loss of well clear with the modified tau of RTCA DO-365, which counts velocities, too: vertical
    /// distance <= vertical, and one of two conditions in the plane. Either the horizontal distance is at
    /// most `horizontal`. Or the two close in, would pass at most `horizontal` from each other if they went
    /// straight on, and have 0 <= (horizontal^2 - s.s) / (s.v) <= modified_tau, where s and v are the
    /// horizontal position and velocity of one relative to the other. The tolerance of Verdict::within
    /// applies to `horizontal` and to `vertical`.
    well_clear,
  };
  Shape shape = Shape::ellipsoid;
  double horizontal = 0.0;  ///< length, > 0
  double vertical = 0.0;    ///< length, > 0; ignored in two dimensions
  /// Time for which tracks are predicted to go straight on (time, >= 0); with 0 nothing is predicted. The
  /// monitor then also reports closest approaches within the separation that come in this time
  /// (MonitorEventKind::predicted). For well_clear, losses of well clear that come in this time.
  double look_ahead = 0.0;
  double modified_tau = 0.0;  ///< Time, >= 0; 0 for shapes other than well_clear.

  /// Return a separation of the shape in the name, predicted `look_ahead` (time) ahead.
  static constexpr Separation sphere(double distance, double look_ahead = 0.0) {
    return {Shape::ellipsoid, distance, distance, look_ahead};
  }
  static constexpr Separation ellipsoid(double horizontal, double vertical, double look_ahead = 0.0) {
    return {Shape::ellipsoid, horizontal, vertical, look_ahead};
  }
  static constexpr Separation cylinder(double horizontal, double vertical, double look_ahead = 0.0) {
    return {Shape::cylinder, horizontal, vertical, look_ahead};
  }
  /// For example DO-365's en-route volume, in metres and seconds, 55 s ahead:
  ///   Separation::well_clear(1222.32, 137.16, 35.0, 55.0)
  static constexpr Separation well_clear(double horizontal, double vertical, double modified_tau,
                                         double look_ahead = 0.0) {
    return {Shape::well_clear, horizontal, vertical, look_ahead, modified_tau};
  }

  friend constexpr bool operator==(const Separation&, const Separation&) = default;
};

/// What the reports so far prove about two tracks and a separation at one time.
enum class Verdict {
  apart,      ///< the pair certainly is not within the separation
  undecided,  ///< the reports prove neither of the other two
  within,     ///< the pair certainly is within the separation, or outside of it by at most the tolerance
};

/// The separations between the tracks of two classes. A level is an index into `levels`; each level has its
/// own verdicts. The first level is the widest, for example a caution, the last one an alarm.
struct SeparationRule {
  std::size_t first_class = 0;
  std::size_t second_class = 0;
  std::vector<Separation> levels{};

  friend bool operator==(const SeparationRule&, const SeparationRule&) = default;
};

}  // namespace kinesphere
