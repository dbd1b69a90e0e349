// Sets of positions and velocities that a track can reach after a report, and the distances that a separation
// compares.
#pragma once

#include <algorithm>
#include <cmath>

#include "bound/rounding.hpp"
#include "kinesphere/bound.hpp"
#include "kinesphere/monitor/report.hpp"
#include "kinesphere/monitor/separation.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

/// A ball that contains the track from `time` until `end`. With s = t - time, its centre is position +
/// velocity s + 1/2 acceleration s^2, and its radius is radius + speed s + 1/2 growth s^2. The velocity of
/// the track differs from velocity + acceleration s by at most speed + growth s (docs/monitoring.md, Lemma
/// 5).
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
  /// Returns this set re-expressed with reference time t, before or after `time`; `end` is unchanged. Its
  /// errors include the rounding of this computation, relative to the magnitudes of all summands, since sums
  /// may cancel.
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
  /// Returns the set as a time-varying ball, with the total of each limit.
  Bound bound() const {
    return {time, position, velocity, acceleration, radius.total(), speed.total(), growth.total()};
  }

 private:
  ErrorBound radius_after(double s) const { return radius + (speed + growth * (0.5 * s)) * s; }
};

/// A distance that a separation limits: in space with lengths along z multiplied by `stretch`, in the plane,
/// or along the vertical.
struct Component {
  enum class Axes { space, plane, upright };
  Axes axes = Axes::space;
  double stretch = 1.0;
  double limit = 0.0;
  /// A point whose measured distance exceeds `limit` by at most this length is outside of the separation by
  /// at most the tolerance of the monitor (docs/monitoring.md, Lemma 4).
  double tolerance = 0.0;
  double modified_tau = 0.0;  ///< Separation::modified_tau; for the plane alone.

  double length(const ErrorBound& error) const {
    if (axes == Axes::plane) return error.horizontal();
    return axes == Axes::upright ? error.vertical() : error.total(stretch);
  }
  Vec3 part(const Vec3& v) const {
    if (axes == Axes::plane) return {v.x, v.y, 0.0};
    return axes == Axes::upright ? Vec3{0.0, 0.0, v.z} : Vec3{v.x, v.y, stretch * v.z};
  }
};

/// The components of a separation. A pair is apart if its distance exceeds the limit of any component, and
/// within if it exceeds none.
struct Components {
  Component parts[2];
  int count = 1;
  double look_ahead = 0.0;  ///< Separation::look_ahead
  /// True if predictions are about the time at which two first are within the separation; else about that of
  /// their closest approach.
  bool predicts_entry = false;

  Components(const Separation& separation, int dimensions, double tolerance) {
    const auto& [shape, horizontal, vertical, ahead, modified_tau] = separation;
    look_ahead = ahead;
    predicts_entry = shape == Separation::Shape::well_clear;
    if (shape != Separation::Shape::ellipsoid) {
      parts[0] = {Component::Axes::plane, 1.0, horizontal, tolerance, modified_tau};
      parts[1] = {Component::Axes::upright, 1.0, vertical, tolerance};
      count = dimensions == 2 ? 1 : 2;
    } else {
      const double stretch = dimensions == 2 ? 1.0 : horizontal / vertical;
      parts[0] = {Component::Axes::space, stretch, horizontal, std::min(1.0, stretch) * tolerance};
    }
  }
  /// Returns this separation enlarged by a distance.
  Components enlarged(const ErrorBound& distance) const {
    Components enlarged = *this;
    for (Component& component : enlarged.parts) component.limit += component.length(distance);
    return enlarged;
  }
  /// Returns this separation enlarged by a part of it (ratio, >= 0).
  Components enlarged(double part) const {
    Components enlarged = *this;
    for (Component& component : enlarged.parts) component.limit *= 1.0 + part;
    return enlarged;
  }
  const Component* begin() const { return parts; }
  const Component* end() const { return parts + count; }
};

}  // namespace kinesphere
