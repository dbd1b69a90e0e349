// From the coordinates of a file to those that are calculated with, and back.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "kinesphere/body.hpp"
#include "kinesphere/shape.hpp"
#include "tracks/projection.hpp"

namespace kinesphere::program {

/// Calculated with are lengths from an origin near the recording, so that no digits are lost to a large
/// offset such as that of UTM: in metres where the file's unit is known or its positions are longitudes and
/// latitudes, else in the file's unit. A recording that lies near zero keeps its own zero as origin.
class Coordinates {
 public:
  Coordinates() = default;
  /// Lengths of `unit` metres each (1: kept as they are), which lie in `extent`.
  Coordinates(const Box& extent, double unit, std::optional<UtmZone> zone = {});
  /// Degrees and metres of height.
  explicit Coordinates(std::shared_ptr<const Projection> projection) : projection_(std::move(projection)) {}

  Vec3 local(const Vec3& position) const;
  /// x, y, z or longitude, latitude, height, as in the file.
  Vec3 as_in_file(const Vec3& local) const;
  /// Whether the file's positions are longitudes and latitudes.
  bool are_geographic() const { return projection_ != nullptr; }
  /// Longitude, latitude (degrees) and height (metres), where they are known: the file has them, or its UTM
  /// zone was given. Throws ProgramError for positions outside the zone's range.
  std::optional<Vec3> geographic(const Vec3& local) const;
  /// Whether motion without heights stays in the plane z = 0.
  bool are_plane() const { return !projection_ || projection_->is_plane(); }
  /// What was projected, and how well; empty where nothing was.
  std::string description() const { return projection_ ? projection_->description() : ""; }

 private:
  Vec3 origin_{};      ///< as in the file
  double unit_ = 1.0;  ///< metres, of the file's lengths
  std::optional<UtmZone> zone_;
  std::shared_ptr<const Projection> projection_;
};

}  // namespace kinesphere::program
