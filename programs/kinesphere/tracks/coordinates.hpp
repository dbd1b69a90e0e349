// Converts the coordinates of a file to those of the computation, and back.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "kinesphere/body.hpp"
#include "kinesphere/shape.hpp"
#include "tracks/own_frame.hpp"
#include "tracks/projection.hpp"

namespace kinesphere::program {

/// Computed coordinates are lengths from an origin near the track set, so that no digits are lost to a large
/// offset such as that of UTM. Unit: metres if the file's unit is known or its positions are longitudes and
/// latitudes, else the file's unit. A track set near zero keeps zero as its origin.
class Coordinates {
 public:
  Coordinates() = default;
  /// Lengths whose x, y and z have these units (1: unchanged), which lie in `extent`.
  Coordinates(const Box& extent, const Vec3& units, std::optional<UtmZone> zone = {});
  /// Longitude, latitude and height in these units of degrees and metres.
  explicit Coordinates(std::shared_ptr<const Projection> projection, const Vec3& units = {1.0, 1.0, 1.0})
      : units_(units), projection_(std::move(projection)) {}

  Vec3 local(const Vec3& position) const;
  /// Returns x, y, z or longitude, latitude, height, in the file's coordinates.
  Vec3 as_in_file(const Vec3& local) const;
  /// True if the file's positions are longitudes and latitudes.
  bool are_geographic() const { return projection_ != nullptr; }
  /// Returns longitude, latitude (degrees) and height (metres) if the file has them or its UTM zone was
  /// given; else nothing. Throws ProgramError for positions outside the zone's range.
  std::optional<Vec3> geographic(const Vec3& local) const;
  /// Returns east, north and up at a place on the earth; else the axes of the file.
  LocalAxes axes_at(const Vec3& local) const;
  /// True if motion without heights stays in the plane z = 0.
  bool are_plane() const { return !projection_ || projection_->is_plane(); }
  /// Text about the projection and its accuracy; empty without a projection.
  std::string description() const { return projection_ ? projection_->description() : ""; }

 private:
  Vec3 origin_{};              ///< in the file's coordinates
  Vec3 units_{1.0, 1.0, 1.0};  ///< metres or degrees, of the file's x, y and z
  std::optional<UtmZone> zone_;
  std::shared_ptr<const Projection> projection_;
};

}  // namespace kinesphere::program
