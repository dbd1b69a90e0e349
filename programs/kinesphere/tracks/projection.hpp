// Projects longitudes and latitudes to lengths, with GeographicLib. Without that library all projections
// fail.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "kinesphere/vec3.hpp"

namespace kinesphere::program {

/// Degrees east and north on the ellipsoid WGS 84, and metres above it, in x, y and z of a Vec3.
class Projection {
 public:
  virtual ~Projection() = default;
  /// Returns metres.
  virtual Vec3 local(const Vec3& geographic) const = 0;
  virtual Vec3 geographic(const Vec3& local) const = 0;
  /// True if points on the ground have z = 0.
  virtual bool is_plane() const = 0;
  /// Text for the summary: the projection, and the largest error of its lengths.
  virtual std::string description() const = 0;
};

enum class ProjectionChoice {
  automatic,  ///< plane where points are on the ground and that makes no length wrong by more than 0.1 %
  ground,     ///< plane with heights as z; fails where that makes a length wrong by more than 0.1 %
  plane,
  earth,
};

/// Returns a projection around the middle of these points.
///
/// Plane: azimuthal equidistant. Distances from the middle are true; no other is too short, and none is too
/// long by more than description() says. Heights are kept as z.
/// Earth: the Earth's space, turned so that z goes up in the middle. Distances are true, in a straight line
/// (through the ground, which makes 10 km a millimetre shorter). Motion is 3D.
///
/// `has_heights`: the points have heights above the ground; `automatic` then chooses earth. Throws
/// ProgramError without GeographicLib, and for a plane with points around the whole Earth.
std::shared_ptr<const Projection> project(std::span<const Vec3> geographic, bool has_heights,
                                          ProjectionChoice choice);

/// A UTM zone such as 33N or 5S, to turn easting and northing into longitude and latitude.
struct UtmZone {
  int number;  ///< 1 to 60
  bool north;
};
/// Throws ProgramError naming `option` if the text is no zone.
UtmZone parse_utm_zone(std::string_view text, std::string_view option);
/// Returns degrees and metres. Throws ProgramError without GeographicLib.
Vec3 geographic_from_utm(const UtmZone& zone, const Vec3& position);

}  // namespace kinesphere::program
