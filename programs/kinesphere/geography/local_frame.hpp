// A plane map of a part of the earth, with the bound of its error.
#pragma once

#include <optional>

#include "geography/azimuthal_map.hpp"
#include "kinesphere/body.hpp"
#include "kinesphere/monitor/report.hpp"
#include "kinesphere/monitor/separation.hpp"

namespace kinesphere::program {

/// The azimuthal equidistant projection of WGS 84 around an origin: x to the east, y to the north, heights
/// kept as z. Distances of places on the earth are those of the shortest ways on the ellipsoid, below the
/// tracks.
///
/// Let b be the polar radius, R the radius of the map and t = R / b. What follows holds for all that is
/// within R of the origin.
///
/// 1. In geodesic polar coordinates (r, azimuth) lengths on the earth are ds^2 = dr^2 + m^2 da^2, on the map
///    dr^2 + r^2 da^2. The reduced length m is the solution of m'' + K m = 0, m(0) = 0, m'(0) = 1. The
///    curvature K of the ellipsoid lies in (0, 1/b^2] (the upper limit is that of the equator). So, by
///    Sturm's comparison, b sin(r/b) <= m <= r, and a way on the map is as long as on the earth or longer, by
///    at most the factor
///        kappa = t / sin t.
///    The disc is convex on the map, and on the earth as long as R < pi b / 2. So the straight way on the
///    map, and the shortest one on the earth, both stay in it, and
///        distance on the earth <= distance on the map <= kappa * distance on the earth.
///    Two that are farther apart on the map than kappa D are farther apart on the earth than D; two that are
///    within D on the map are within D on the earth.
/// 2. A velocity v over ground has a part along r, which stays, and one across, which becomes r/m in [1,
/// kappa]
///    times as long. It is transformed exactly; an error of it grows by at most kappa. What flies at the
///    height h has the velocity v a / (a + h) on the ellipsoid below, with a radius of curvature a in [b^2/e,
///    e^2/b], where e is the equatorial radius: 6335 to 6400 km. With 6371 km that is wrong by less than 0.01
///    h/b. A height above the sea, or of pressure, is within 1500 m of the one above the ellipsoid.
///    A velocity in terms of east and north that was measured at most a distance d away from where it is
///    drawn has turned meanwhile: east and north by d tan(latitude) / b, and the map, as in 3, by 1.2 kappa^2
///    (t/b) d.
/// 3. A path whose acceleration on the earth, in the plane that touches it, is at most A has on the map at
/// most
///        kappa A + 1.2 kappa^2 (t/b) V^2
///    where V is its largest speed: its parts along and across r differ from those on the earth times 1 and
///    r/m by (r - m m') a'^2 and 2 r' a' (1 - r m'/m), and by r/m * dm/da * a'^2. From 0 <= K <= 1/b^2 follow
///    m >= r (1 - r^2/6b^2), m' >= 1 - r^2/2b^2 and m' <= m/r, and m a' is the speed across: so the first is
///    at most 2/3 kappa^2 (r/b^2) V^2, the second half of kappa (r/b^2) V^2, and with |dK/ds| <= 2 (1 -
///    b^2/e^2) / (b^2 * 6335 km) the third is less than 0.02 times the first. At a height h that changes with
///    the speed W it is by at most V W / b + V^2 h / b^2 more.
class LocalFrame {
 public:
  /// Reports are accepted within `radius` < largest_radius; tracks may move up to `margin` beyond it before
  /// they are forgotten. Unit: metres. Throws ProgramError without GeographicLib.
  LocalFrame(double latitude, double longitude, double radius, double margin);

  /// Metres.
  static constexpr double largest_radius = 5e6;
  /// Largest height and depth of a track. Unit: metres.
  static constexpr double largest_height = 30e3;

  double latitude() const { return map_.latitude(); }
  double longitude() const { return map_.longitude(); }
  double radius() const { return radius_; }
  /// The largest factor by which distances on the map are too long: kappa.
  double stretch() const { return stretch_; }

  struct Placed {
    State state;
    double velocity_error = 0.0;  ///< added by the transformation of the velocity
  };
  /// Degrees east and north, and metres of height (if known) in a Vec3. The velocity may have been measured
  /// up to that distance from the position. Returns nothing for a place beyond the radius.
  std::optional<Placed> place(const Vec3& geographic, bool has_height, const Vec3& velocity,
                              double away = 0.0) const;
  /// Returns degrees east and north, and metres.
  Vec3 geographic(const Vec3& position) const { return map_.geographic(position); }

  /// Returns the bound of a horizontal position error on the map.
  double position_error(double metres) const { return stretch_ * metres + rounding; }
  double velocity_error(double metres_per_second) const { return stretch_ * metres_per_second; }
  /// Returns the limits on the map of a class with these limits on the earth.
  TrackClass promise(const ErrorBound& acceleration, const ErrorBound& largest_speed) const;
  /// Returns a separation on the map; if it certainly does not hold there, `separation` does not hold on the
  /// earth. The modified tau of well clear is that of the map: products of relative positions and velocities
  /// differ there by at most the factor kappa^2 - 1 of the product of their lengths.
  Separation separation(const Separation& separation) const;

 private:
  /// Unit: metres. GeographicLib's geodesics are exact to 15 nanometres.
  static constexpr double rounding = 1e-6;

  /// Returns the largest curvature of a straight way on the map. Unit: 1 / metre.
  double curving() const;

  AzimuthalMap map_;
  double radius_, outer_radius_;
  double stretch_;
};

}  // namespace kinesphere::program
