// Projects longitudes and latitudes to lengths.
#include "tracks/projection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "base/program_error.hpp"
#include "geography/azimuthal_map.hpp"

#ifdef KINESPHERE_WITH_GEOGRAPHICLIB
#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/LocalCartesian.hpp>
#include <GeographicLib/UTMUPS.hpp>
#endif

namespace kinesphere::program {

UtmZone parse_utm_zone(std::string_view text, std::string_view option) {
  UtmZone zone{0, false};
  const char* const end = text.data() + text.size();
  const auto [letter, error] = std::from_chars(text.data(), end, zone.number);
  const bool valid = error == std::errc() && 1 <= zone.number && zone.number <= 60 && letter + 1 == end &&
                     std::string_view("NnSs").find(*letter) != std::string_view::npos;
  if (!valid)
    throw ProgramError(fmt::format("{}: expected a UTM zone such as 33N or 5S, but got '{}'", option, text));
  zone.north = *letter == 'N' || *letter == 'n';
  return zone;
}

#ifndef KINESPHERE_WITH_GEOGRAPHICLIB

namespace {
[[noreturn]] void fail() {
  throw ProgramError(
      "longitudes and latitudes need GeographicLib, and this program was built without it "
      "(libgeographiclib-dev)");
}
}  // namespace

std::shared_ptr<const Projection> project(std::span<const Vec3>, bool, ProjectionChoice) { fail(); }
Vec3 geographic_from_utm(const UtmZone&, const Vec3&) { fail(); }

#else

namespace {

using GeographicLib::Geocentric;

constexpr double largest_distortion = 1e-3;

struct LongitudeLatitude {
  double longitude, latitude;
};

/// Returns the place above or below the mean of the points in space; the date line does not disturb it.
LongitudeLatitude middle_of(std::span<const Vec3> points) {
  Vec3 sum{};
  for (const Vec3& point : points) {
    Vec3 place;
    Geocentric::WGS84().Forward(point.y, point.x, 0, place.x, place.y, place.z);
    sum += place / static_cast<double>(points.size());
  }
  LongitudeLatitude middle{};
  double height = 0;
  Geocentric::WGS84().Reverse(sum.x, sum.y, sum.z, middle.latitude, middle.longitude, height);
  return middle;
}

std::string place_text(const LongitudeLatitude& place) {
  return fmt::format("{:.4f} {}, {:.4f} {}", std::abs(place.latitude), place.latitude < 0 ? 'S' : 'N',
                     std::abs(place.longitude), place.longitude < 0 ? 'W' : 'E');
}

class Plane final : public Projection {
 public:
  explicit Plane(std::span<const Vec3> points) : map_(map_around(middle_of(points))) {
    double smallest = 1.0;
    for (const Vec3& point : points) smallest = std::min(smallest, map_.point(point).reciprocal_scale);
    distortion_ = smallest > 0 ? 1.0 / smallest - 1.0 : std::numeric_limits<double>::infinity();
  }

  double distortion() const { return distortion_; }

  Vec3 local(const Vec3& geographic) const override { return map_.point(geographic).position; }
  Vec3 geographic(const Vec3& local) const override { return map_.geographic(local); }
  bool is_plane() const override { return true; }
  std::string description() const override {
    return fmt::format("plane around {}; lengths are at most {:.2g} % too long",
                       place_text({map_.longitude(), map_.latitude()}), 100 * distortion_);
  }

 private:
  static AzimuthalMap map_around(const LongitudeLatitude& middle) {
    return {middle.latitude, middle.longitude};
  }

  AzimuthalMap map_;
  double distortion_ = 0;
};

class Earth final : public Projection {
 public:
  explicit Earth(std::span<const Vec3> points)
      : middle_(middle_of(points)), frame_(middle_.latitude, middle_.longitude, 0) {}

  Vec3 local(const Vec3& geographic) const override {
    Vec3 result;
    frame_.Forward(geographic.y, geographic.x, geographic.z, result.x, result.y, result.z);
    return result;
  }
  Vec3 geographic(const Vec3& local) const override {
    Vec3 result;
    frame_.Reverse(local.x, local.y, local.z, result.y, result.x, result.z);
    return result;
  }
  bool is_plane() const override { return false; }
  std::string description() const override {
    return fmt::format("space around {}; lengths are true, in a straight line", place_text(middle_));
  }

 private:
  LongitudeLatitude middle_;
  GeographicLib::LocalCartesian frame_;
};

}  // namespace

std::shared_ptr<const Projection> project(std::span<const Vec3> geographic, bool has_heights,
                                          ProjectionChoice choice) {
  if (choice == ProjectionChoice::earth || (choice == ProjectionChoice::automatic && has_heights))
    return std::make_shared<Earth>(geographic);
  auto plane = std::make_shared<Plane>(geographic);
  if (choice == ProjectionChoice::automatic && !(plane->distortion() <= largest_distortion))
    return std::make_shared<Earth>(geographic);
  if (choice == ProjectionChoice::ground && !(plane->distortion() <= largest_distortion)) {
    throw ProgramError(fmt::format(
        "--projection: expected places at most 490 km from their middle for a cylinder, but some are "
        "farther, and lengths between them are up to {:.2g} % too long: say --projection plane to take "
        "them so",
        100 * plane->distortion()));
  }
  if (!(plane->distortion() <= 0.5)) {
    throw ProgramError(
        "--projection plane: expected points on one side of the Earth, but they are all around it: use "
        "--projection earth");
  }
  return plane;
}

Vec3 geographic_from_utm(const UtmZone& zone, const Vec3& position) {
  Vec3 result{0, 0, position.z};
  try {
    GeographicLib::UTMUPS::Reverse(zone.number, zone.north, position.x, position.y, result.y, result.x);
  } catch (const GeographicLib::GeographicErr& error) {
    throw ProgramError(fmt::format("--positions utm: {}", error.what()));
  }
  return result;
}

#endif

}  // namespace kinesphere::program
