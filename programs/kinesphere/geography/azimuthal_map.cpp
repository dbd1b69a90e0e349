// Plane maps of the earth, with GeographicLib.
#include "geography/azimuthal_map.hpp"

#include "base/program_error.hpp"

#ifdef KINESPHERE_WITH_GEOGRAPHICLIB
#include <GeographicLib/AzimuthalEquidistant.hpp>
#endif

namespace kinesphere::program {

#ifdef KINESPHERE_WITH_GEOGRAPHICLIB

namespace {

const GeographicLib::AzimuthalEquidistant& equidistant() {
  static const GeographicLib::AzimuthalEquidistant projection;
  return projection;
}

}  // namespace

AzimuthalMap::AzimuthalMap(double latitude, double longitude) : latitude_(latitude), longitude_(longitude) {}

AzimuthalMap::Point AzimuthalMap::point(const Vec3& geographic) const {
  Point point{.position = geographic};
  equidistant().Forward(latitude_, longitude_, geographic.y, geographic.x, point.position.x, point.position.y,
                        point.azimuth, point.reciprocal_scale);
  return point;
}

Vec3 AzimuthalMap::geographic(const Vec3& position) const {
  Vec3 place = position;
  equidistant().Reverse(latitude_, longitude_, position.x, position.y, place.y, place.x);
  return place;
}

#else

AzimuthalMap::AzimuthalMap(double latitude, double longitude) : latitude_(latitude), longitude_(longitude) {
  throw ProgramError(
      "longitudes and latitudes need GeographicLib, and this program was built without it "
      "(libgeographiclib-dev)");
}
AzimuthalMap::Point AzimuthalMap::point(const Vec3& geographic) const { return {geographic}; }
Vec3 AzimuthalMap::geographic(const Vec3& position) const { return position; }

#endif

}  // namespace kinesphere::program
