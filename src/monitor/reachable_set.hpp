// What one report says of where a track is from then on.
#pragma once

#include <algorithm>
#include <cmath>

#include "bound/rounding.hpp"
#include "kinesphere/bound.hpp"
#include "kinesphere/monitor/report.hpp"
#include "kinesphere/monitor/separation.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

/// From `time` until `end`, with s = t - time, the track is within `radius + speed s + 1/2 growth s^2` of
/// position + velocity s + 1/2 acceleration s^2.
struct ReachableSet {
  double time = 0.0;
  double end = infinity;
  Vec3 position{};
  Vec3 velocity{};
  Vec3 acceleration{};
  ErrorBound radius{};
  ErrorBound speed{};
  ErrorBound growth{};

  Vec3 centre_at(double t) const {
    const double s = t - time;
    return position + (velocity + acceleration * (0.5 * s)) * s;
  }
  Vec3 velocity_at(double t) const { return velocity + acceleration * (t - time); }
  ErrorBound radius_at(double t) const { return radius_after(t - time); }
  /// The same motion, told as of another time, before or after its own; it holds for as long. The errors have
  /// room for the roundings of this: margins of all that is added up, which may cancel.
  ReachableSet moved_to(double t) const {
    const double s = std::abs(t - time);
    const double speeds = norm_one(velocity) + norm_one(acceleration) * s;
    const double lengths = norm_one(position) + speeds * s;
    constexpr double more = 1.0 + rounding::margin;
    ReachableSet moved = *this;
    moved.time = t;
    moved.position = centre_at(t);
    moved.velocity = velocity_at(t);
    moved.radius = radius_after(s) * more + ErrorBound(lengths * rounding::margin);
    moved.speed = (speed + growth * s) * more + ErrorBound(speeds * rounding::margin);
    return moved;
  }
  /// As a ball.
  Bound bound() const {
    return {time, position, velocity, acceleration, radius.total(), speed.total(), growth.total()};
  }

  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    auto& [time, end, position, velocity, acceleration, radius, speed, growth] = self;
    archive(time, end, position, velocity, acceleration, radius, speed, growth);
  }

 private:
  ErrorBound radius_after(double s) const { return radius + (speed + growth * (0.5 * s)) * s; }
};

/// One of the distances that a separation is about: in space, where lengths along z count `stretch` times, in
/// the plane, or upright.
struct Component {
  enum class Axes { space, plane, upright };
  Axes axes = Axes::space;
  double stretch = 1.0;
  double limit = 0.0;
  /// A point of which this length, measured along these axes, is the excess over `limit` is no farther
  /// outside of the separation than the tolerance (docs/monitoring.md, Lemma 4).
  double tolerance = 0.0;

  double length(const ErrorBound& error) const {
    if (axes == Axes::plane) return error.horizontal();
    return axes == Axes::upright ? error.vertical() : error.total(stretch);
  }
  Vec3 part(const Vec3& v) const {
    if (axes == Axes::plane) return {v.x, v.y, 0.0};
    return axes == Axes::upright ? Vec3{0.0, 0.0, v.z} : Vec3{v.x, v.y, stretch * v.z};
  }
};

/// A pair is apart if it is beyond the limit of one of these, and within if it is so of all.
struct Components {
  Component parts[2];
  int count = 1;

  Components(const Separation& separation, int dimensions, double tolerance) {
    const auto& [shape, horizontal, vertical] = separation;
    if (shape == Separation::Shape::cylinder) {
      parts[0] = {Component::Axes::plane, 1.0, horizontal, tolerance};
      parts[1] = {Component::Axes::upright, 1.0, vertical, tolerance};
      count = dimensions == 2 ? 1 : 2;
    } else {
      const double stretch = dimensions == 2 ? 1.0 : horizontal / vertical;
      parts[0] = {Component::Axes::space, stretch, horizontal, std::min(1.0, stretch) * tolerance};
    }
  }
  const Component* begin() const { return parts; }
  const Component* end() const { return parts + count; }
};

}  // namespace kinesphere
