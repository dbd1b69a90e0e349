#include "broadphase/grid_level.hpp"

#include <algorithm>

#include "number/powers.hpp"

namespace kinesphere {

void GridLevel::open(const Vec3& base, double origin, float coarseness) {
  SweptSphereFrame frame{.base = base, .per_length = SizeClasses::unit_of(-size_class)};
  if (window.end < infinity) {
    frame.origin = origin;
    frame.per_time = 1.0 / (window.end - origin);
  }
  spheres.clear(frame);
  spheres.set_coarseness(coarseness);
  has_frame = true;
}

SweptSphere GridLevel::swept_sphere(const InflatedBound& bound, double now) const {
  return swept_sphere_of(bound.moved, now, duration_until(window.end, now), bound.margin, spheres.frame());
}

float GridLevel::time(double now) const { return window.end < infinity ? spheres.frame().time(now) : 0.0f; }

SweptSphereQuery GridLevel::query(const InflatedBound& bound, double now, double end) const {
  SweptSphereFrame frame = spheres.frame();
  float from = 0.0f;
  float to = 0.0f;
  if (end < infinity && window.end == infinity) {
    // The frame of the endless window has no time scale, so the query brings its own: from now on, ending at
    // 2 or before.
    frame.origin = now;
    frame.per_time =
        power_of_two(-std::clamp(exponent_of(end - now), -Window::longest_rung, Window::longest_rung));
  }
  if (end < infinity || window.end < infinity) {
    from = frame.time(now);
    to = frame.time(std::min(end, window.end));
  }
  return {swept_sphere_of(bound.moved, now, duration_until(end, now), bound.margin, frame), from, to};
}

Box GridLevel::box_at(std::uint32_t slot, double now) const {
  const SweptSphereFrame& frame = spheres.frame();
  const SweptSphere sphere = spheres.table().swept_sphere_at(slot);
  const double from = time(now);
  const double to = window.end < infinity ? 1.0 : 0.0;
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    const double first = double(sphere.centre[k]) + double(sphere.velocity[k]) * from;
    const double last = double(sphere.centre[k]) + double(sphere.velocity[k]) * to;
    const double radius = sphere.radius;
    box.lower[axis] = frame.base[axis] + (std::min(first, last) - radius) / frame.per_length;
    box.upper[axis] = frame.base[axis] + (std::max(first, last) + radius) / frame.per_length;
  }
  return box;
}

bool GridLevel::is_valid() const {
  const bool is_unused = is_empty() && window.end == -infinity;
  return spheres.is_valid() && SizeClasses::is_size_class(size_class) &&
         (is_unused || (window.is_valid() && (has_frame || is_empty())));
}

}  // namespace kinesphere
