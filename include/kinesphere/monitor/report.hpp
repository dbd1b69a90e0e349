// Input of a monitor: reports of tracks, each with its own timestamp and errors, and the motion limits of
// track classes.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "kinesphere/body.hpp"

namespace kinesphere {

/// An upper limit of an error: in the horizontal plane (x, y), along the vertical (z), and in total. The unit
/// is that of the quantity, for example a length for positions. A plain number is a ball of that radius:
///   report.position_error = 3.0;
///   report.position_error = ErrorBound::cylinder(30.0, 8.0);
class ErrorBound {
 public:
  constexpr ErrorBound() = default;
  /// A ball.
  constexpr ErrorBound(double radius) : horizontal_(radius), vertical_(radius), total_(radius) {}
  /// Returns the bound for which the horizontal and the vertical limit hold simultaneously.
  static ErrorBound cylinder(double horizontal, double vertical) {
    ErrorBound error;
    error.horizontal_ = horizontal;
    error.vertical_ = vertical;
    error.total_ = around(horizontal, vertical);
    return error;
  }

  /// Return the limit in the plane, and that along z.
  constexpr double horizontal() const { return horizontal_; }
  constexpr double vertical() const { return vertical_; }
  /// Returns the total limit with lengths along z multiplied by `stretch` >= 0.
  double total(double stretch = 1.0) const {
    // No diagonal is shorter than its longer side.
    if (stretch == 1.0 && total_ <= std::max(horizontal_, vertical_)) return total_;
    return std::min(around(horizontal_, stretch * vertical_), std::max(1.0, stretch) * total_);
  }
  /// Returns the limit in the plane, without z.
  constexpr ErrorBound flat() const { return ErrorBound(horizontal_); }

  friend constexpr bool operator==(const ErrorBound&, const ErrorBound&) = default;
  /// Bounds of the sum of two errors, and of a multiple (factor >= 0) of one.
  friend ErrorBound operator+(const ErrorBound& a, const ErrorBound& b) {
    return of(a.horizontal_ + b.horizontal_, a.vertical_ + b.vertical_, a.total_ + b.total_);
  }
  friend ErrorBound operator*(const ErrorBound& a, double factor) {
    return of(a.horizontal_ * factor, a.vertical_ * factor, a.total_ * factor);
  }
  /// Returns the larger one of each limit.
  friend ErrorBound largest(const ErrorBound& a, const ErrorBound& b) {
    return of(std::max(a.horizontal_, b.horizontal_), std::max(a.vertical_, b.vertical_),
              std::max(a.total_, b.total_));
  }
  /// Returns the smaller one of each limit.
  friend ErrorBound least(const ErrorBound& a, const ErrorBound& b) {
    return of(std::min(a.horizontal_, b.horizontal_), std::min(a.vertical_, b.vertical_),
              std::min(a.total_, b.total_));
  }

  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    auto& [horizontal, vertical, total] = self;
    archive(horizontal, vertical, total);
  }

 private:
  static ErrorBound of(double horizontal, double vertical, double total) {
    ErrorBound error;
    error.horizontal_ = horizontal;
    error.vertical_ = vertical;
    error.total_ = total;
    return error;
  }
  /// Returns the diagonal, rounded up.
  static double around(double horizontal, double vertical) {
    if (vertical == 0.0) return horizontal;
    if (horizontal == 0.0) return vertical;
    return std::sqrt(horizontal * horizontal + vertical * vertical) * (1.0 + 0x1p-50);
  }

  double horizontal_ = 0.0;
  double vertical_ = 0.0;
  double total_ = 0.0;
};

/// Motion limits that hold for all tracks of a class. At least one of the two limits has to be finite.
struct TrackClass {
  /// Largest difference of the acceleration from `planned_acceleration` (length / time^2).
  ErrorBound acceleration_limit = std::numeric_limits<double>::infinity();
  Vec3 planned_acceleration{};
  /// Largest speed (length / time).
  ErrorBound largest_speed = std::numeric_limits<double>::infinity();

  friend constexpr bool operator==(const TrackClass&, const TrackClass&) = default;
};

/// A reported state of a track. The errors are bounds. If a source gives an accuracy that holds only with
/// some probability, the caller declares which multiple of it contains all errors.
struct TrackReport {
  /// Time of the state on the monitor's clock. Reports may be late, out of order and repeated.
  double timestamp = 0.0;
  State state{};
  /// Largest distance of the true position from the reported one (length).
  ErrorBound position_error{};
  /// Largest difference of the true velocity from the reported one (length / time). Infinite if no velocity
  /// was reported, which requires a class with a largest speed.
  ErrorBound velocity_error{};
  /// Largest difference of the timestamp from the true time (time).
  double timestamp_error = 0.0;

  /// A plan in force from the report's timestamp until `valid_until`, whatever reports follow. While it is in
  /// force, the acceleration differs from the plan's by at most the plan's limit. These replace the class's
  /// planned_acceleration and acceleration_limit; the class's largest_speed holds all the time. If several
  /// plans are in force at a time, each of them holds. Examples: a satellite's gravity, a filed manoeuvre.
  /// Effect: a plan within the limits of its class tightens verdicts and ends none. A plan beyond them ends
  /// every verdict about the track's pairs, which the monitor then decides anew. Verdicts before such a plan
  /// arrives rely on the class's limits alone.
  struct Plan {
    Vec3 acceleration{};
    ErrorBound acceleration_limit{};
    double valid_until = std::numeric_limits<double>::infinity();

    friend constexpr bool operator==(const Plan&, const Plan&) = default;
  };
  std::optional<Plan> plan{};

  /// Class of the track, an index into MonitorDefinition::classes. A report with another class than those
  /// before starts the track anew, for example when a vessel anchors.
  std::size_t track_class = 0;

  friend constexpr bool operator==(const TrackReport&, const TrackReport&) = default;
};

}  // namespace kinesphere
