#include "core/first_radii.hpp"

#include <algorithm>

#include "core/even_spacing.hpp"

namespace kinesphere::core {
namespace {

/// So many that arrive together are as far apart as they are on average.
constexpr std::size_t even_arrivals = 32;

}  // namespace

void BoundingBox::add(const Vec3& point) {
  for (int axis = 0; axis < 3; ++axis) {
    box_.lower[axis] = std::min(box_.lower[axis], point[axis]);
    box_.upper[axis] = std::max(box_.upper[axis], point[axis]);
  }
}

double first_radius(const Box& extent, std::size_t balls, double tolerance) {
  if (balls == 0) return tolerance;
  double edges[3] = {extent.upper.x - extent.lower.x, extent.upper.y - extent.lower.y,
                     extent.upper.z - extent.lower.z};
  return tolerance + 0.35 * even_spacing(edges, static_cast<double>(balls));
}

void choose_first_radii(std::span<Arrival> arrivals, double tolerance) {
  BoundingBox bounds;
  for (const Arrival& arrival : arrivals) bounds.add(arrival.position);
  if (arrivals.size() <= even_arrivals) {
    const double radius = first_radius(bounds.box(), arrivals.size(), tolerance);
    for (Arrival& arrival : arrivals) arrival.radius = radius;
    return;
  }
  const Vec3 edges = bounds.box().upper - bounds.box().lower;
  const int axis = edges.x >= edges.y && edges.x >= edges.z ? 0 : edges.y >= edges.z ? 1 : 2;
  const auto middle = arrivals.begin() + static_cast<std::ptrdiff_t>(arrivals.size() / 2);
  std::nth_element(arrivals.begin(), middle, arrivals.end(), [axis](const Arrival& a, const Arrival& b) {
    return a.position[axis] < b.position[axis] || (a.position[axis] == b.position[axis] && a.ball < b.ball);
  });
  choose_first_radii(arrivals.first(arrivals.size() / 2), tolerance);
  choose_first_radii(arrivals.subspan(arrivals.size() / 2), tolerance);
}

}  // namespace kinesphere::core
