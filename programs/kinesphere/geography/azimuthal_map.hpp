// Plane maps of the earth, with GeographicLib.
#pragma once

#include "kinesphere/vec3.hpp"

namespace kinesphere::program {

/// The azimuthal equidistant projection of the ellipsoid WGS 84 around a place: x to the east, y to the
/// north, in metres. Geographic places are degrees east and north in x and y of a Vec3; z is kept.
class AzimuthalMap {
 public:
  /// Degrees. Throws ProgramError without GeographicLib.
  AzimuthalMap(double latitude, double longitude);

  double latitude() const { return latitude_; }
  double longitude() const { return longitude_; }

  struct Point {
    Vec3 position;
    double azimuth = 0.0;           ///< of the way from the middle, at its end (degrees)
    double reciprocal_scale = 1.0;  ///< of lengths across that way: on the earth by on the map
  };
  Point point(const Vec3& geographic) const;
  Vec3 geographic(const Vec3& position) const;

 private:
  double latitude_, longitude_;
};

}  // namespace kinesphere::program
