#include "window/window_layer.hpp"

#include <algorithm>

#include "number/powers.hpp"

namespace kinesphere {

void WindowLayer::open(const Vec3& base, double origin, float coarseness) {
  CapsuleFrame frame{.base = base, .per_length = SizeLevels::unit_of(-level)};
  if (window.end < infinity) {
    frame.origin = origin;
    frame.per_time = 1.0 / (window.end - origin);
  }
  capsules.clear(frame);
  capsules.set_coarseness(coarseness);
  has_frame = true;
}

Capsule WindowLayer::capsule(const RoomyBound& bound, double now) const {
  return capsule_of(bound.moved, now, duration_until(window.end, now), bound.room, capsules.frame());
}

float WindowLayer::time(double now) const {
  return window.end < infinity ? capsules.frame().time(now) : 0.0f;
}

CapsuleQuery WindowLayer::query(const RoomyBound& bound, double now, double end) const {
  CapsuleFrame frame = capsules.frame();
  float from = 0.0f;
  float to = 0.0f;
  if (end < infinity && window.end == infinity) {
    // What stands still has no times of its own.
    frame.origin = now;
    frame.per_time =
        power_of_two(-std::clamp(exponent_of(end - now), -Window::longest_tier, Window::longest_tier));
  }
  if (end < infinity || window.end < infinity) {
    from = frame.time(now);
    to = frame.time(std::min(end, window.end));
  }
  return {capsule_of(bound.moved, now, duration_until(end, now), bound.room, frame), from, to};
}

Box WindowLayer::box_at(std::uint32_t place, double now) const {
  const CapsuleFrame& frame = capsules.frame();
  const Capsule capsule = capsules.table().capsule_at(place);
  const double from = time(now);
  const double to = window.end < infinity ? 1.0 : 0.0;
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    const double first = double(capsule.centre[k]) + double(capsule.velocity[k]) * from;
    const double last = double(capsule.centre[k]) + double(capsule.velocity[k]) * to;
    const double radius = capsule.radius;
    box.lower[axis] = frame.base[axis] + (std::min(first, last) - radius) / frame.per_length;
    box.upper[axis] = frame.base[axis] + (std::max(first, last) + radius) / frame.per_length;
  }
  return box;
}

bool WindowLayer::is_sound() const {
  return capsules.is_sound() && SizeLevels::is_level(level) &&
         ((window.is_sound() && has_frame) || is_empty());
}

}  // namespace kinesphere
