#include "watch/output/pair_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kinesphere::program {
namespace {

/// Returns the limits of the vertical distance of two tracks in any of their places.
PairDistance::Vertical vertical_between(const TrackView& first, const TrackView& second) {
  PairDistance::Vertical vertical{.lower = std::numeric_limits<double>::infinity()};
  vertical.likely = std::abs(first.places.front().centre.z - second.places.front().centre.z);
  for (const TrackView::Place& one : first.places)
    for (const TrackView::Place& other : second.places) {
      const double between = std::abs(one.centre.z - other.centre.z);
      const double radius = one.radius.vertical() + other.radius.vertical();
      vertical.lower = std::min(vertical.lower, std::max(0.0, between - radius));
      vertical.upper = std::max(vertical.upper, between + radius);
    }
  return vertical;
}

}  // namespace

PairDistance distance_now(const Monitor& monitor, const Separation& separation, TrackId first,
                          TrackId second) {
  const TrackView one = monitor.track(first).value(), other = monitor.track(second).value();
  Vec3 between = one.places.front().centre - other.places.front().centre;
  PairDistance distance;
  const bool is_flat = monitor.definition().dimensions == 2;
  if (!is_flat) distance.vertical = vertical_between(one, other);
  const bool is_ellipsoid = separation.shape == Separation::Shape::ellipsoid;
  between.z *= is_flat || !is_ellipsoid ? 0.0 : separation.horizontal / separation.vertical;
  distance.likely = norm(between);
  return distance;
}

}  // namespace kinesphere::program
