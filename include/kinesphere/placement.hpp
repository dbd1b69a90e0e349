// Starts of one's own: spheres at random places in a box, with or without walls, none of which overlap.
//
//   const Box box{{0, 0, 0}, {50, 50, 50}};
//   const std::vector<double> radii{0.5};  // as many spheres of this radius as fill 49 % of the box
//   const auto centres = place_spheres(radii, box, {.periodic = {true, true, true}, .packing = 0.49});
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kinesphere/result.hpp"
#include "kinesphere/vec3.hpp"
#include "kinesphere/world_definition.hpp"

namespace kinesphere {

/// How place_spheres() fills a box.
struct PlacementOptions {
  /// Axes on which space repeats with the box, without walls: centres are as dense at these faces as
  /// anywhere, and spheres keep clear of the images of others.
  Axes periodic{};
  /// 2 or 3. With 2, the spheres are discs in the plane z = 0, and the z range of the box is ignored.
  int dimensions = 3;
  /// Part of the box (of its area, for discs) to fill, in [0, 1). If positive, the radii are used in turn,
  /// from the first again after the last, for as many spheres as fill no more than this part. With 0 there is
  /// one sphere for each radius.
  double packing = 0.0;
  /// Least distance (>= 0, length) between the surfaces of two spheres, and between a sphere and a wall.
  /// Less than 2^-48 of the distance of the box's farthest corner from the origin counts as that, so that
  /// no rounding makes spheres overlap.
  double gap = 0.0;
  std::uint64_t seed = 1;

  friend constexpr bool operator==(const PlacementOptions&, const PlacementOptions&) = default;
};

/// Returns the centres of spheres of these radii (>= 0, length), all inside the box, none of which overlap:
/// in the order of the radii. The same arguments give the same bits on every machine.
///
/// Where little is filled (up to 28 % by spheres of about one size, 40 % by others, 40 % of a plane by discs)
/// each sphere gets a place drawn from all that are free, the largest first. Where more is filled, spheres at
/// random places push each other apart, and random moves then make the neighbourhood of each similar to that
/// in a gas. That reaches 60 % with spheres of one size, 80 % with discs and more with mixtures; walls take
/// some of it from small boxes. Neither is equilibrium: what has to be in equilibrium should be run until all
/// have met many others.
///
/// Errors: not_finite or out_of_range for a radius, box or option; out_of_range for `radii` if a sphere is
/// too large for the box (diameter and gap may be at most its size) or if no arrangement without overlap was
/// found. Cost, on one core: a microsecond for each sphere where little is filled, 10 at 49 %, 50 at 60 %.
[[nodiscard]] Result<std::vector<Vec3>> place_spheres(std::span<const double> radii, const Box& box,
                                                      const PlacementOptions& options = {});

}  // namespace kinesphere
