// What a monitor is told of a track: reports, each with its own time and errors, and what the class of the
// track promises in between.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "kinesphere/body.hpp"

namespace kinesphere {

/// How far off something is at most: in the horizontal plane (x, y), upright (z) and altogether. All units:
/// lengths for positions, and so on. A number alone means a ball of that radius:
///   report.position_error = 3.0;
///   report.position_error = Spread::cylinder(30.0, 8.0);
class ErrorBound {
 public:
  constexpr ErrorBound() = default;
  constexpr ErrorBound(double radius) : horizontal_(radius), vertical_(radius), total_(radius) {}
  /// Both limits hold at once.
  static ErrorBound cylinder(double horizontal, double vertical) {
    ErrorBound error;
    error.horizontal_ = horizontal;
    error.vertical_ = vertical;
    error.total_ = around(horizontal, vertical);
    return error;
  }

  constexpr double horizontal() const { return horizontal_; }
  constexpr double vertical() const { return vertical_; }
  /// Where lengths along z count `stretch` >= 0 times.
  double total(double stretch = 1.0) const {
    // No diagonal is shorter than its longer side.
    if (stretch == 1.0 && total_ <= std::max(horizontal_, vertical_)) return total_;
    return std::min(around(horizontal_, stretch * vertical_), std::max(1.0, stretch) * total_);
  }
  /// In the plane: as if there were no z.
  constexpr ErrorBound flat() const { return ErrorBound(horizontal_); }

  friend constexpr bool operator==(const ErrorBound&, const ErrorBound&) = default;
  friend ErrorBound operator+(const ErrorBound& a, const ErrorBound& b) {
    return of(a.horizontal_ + b.horizontal_, a.vertical_ + b.vertical_, a.total_ + b.total_);
  }
  friend ErrorBound operator*(const ErrorBound& a, double factor) {
    return of(a.horizontal_ * factor, a.vertical_ * factor, a.total_ * factor);
  }
  /// The larger of each.
  friend ErrorBound largest(const ErrorBound& a, const ErrorBound& b) {
    return of(std::max(a.horizontal_, b.horizontal_), std::max(a.vertical_, b.vertical_),
              std::max(a.total_, b.total_));
  }
  /// The lesser of each.
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
  /// The diagonal, rounded up.
  static double around(double horizontal, double vertical) {
    if (vertical == 0.0) return horizontal;
    if (horizontal == 0.0) return vertical;
    return std::sqrt(horizontal * horizontal + vertical * vertical) * (1.0 + 0x1p-50);
  }

  double horizontal_ = 0.0;
  double vertical_ = 0.0;
  double total_ = 0.0;
};

/// What all tracks of a class promise about their motion. One of the two limits has to be finite.
struct TrackClass {
  /// The acceleration differs from the planned one by at most this (length / time^2).
  ErrorBound acceleration_limit = std::numeric_limits<double>::infinity();
  Vec3 planned_acceleration{};
  /// No speed is larger (length / time).
  ErrorBound largest_speed = std::numeric_limits<double>::infinity();
};

/// Where a track was, as somebody reported it. The errors are bounds: where a source tells of an accuracy
/// that holds with some probability, it is the caller who declares which multiple of it contains all errors.
struct TrackReport {
  /// When it was so, by the clock of the monitor. Reports may be late, come out of order and be repeated.
  double timestamp = 0.0;
  State state{};
  /// The true position is within this of the reported one (length).
  ErrorBound position_error{};
  /// The true velocity is within this of the reported one (length / time); infinite if none was reported,
  /// which needs a class with a largest speed.
  ErrorBound velocity_error{};
  /// The stamp is within this of the true time.
  double timestamp_error = 0.0;

  /// A plan is in force from the report's stamp until `valid_until`, whatever reports follow. While it is,
  /// the acceleration differs from the plan's by at most the plan's limit, and that takes the place of the
  /// class's planned_acceleration and acceleration_limit; the class's largest_speed holds all the time. Of
  /// several plans in force at a time each holds. Examples: a satellite's gravity, a filed manoeuvre. Cost: a
  /// plan within the class's promise adds to what is certain and ends nothing; one beyond it ends what was
  /// certain of the track's pairs, which the monitor then decides anew. What was told before such a plan came
  /// in rests upon the class's promise alone.
  struct Plan {
    Vec3 acceleration{};
    ErrorBound acceleration_limit{};
    double valid_until = std::numeric_limits<double>::infinity();
  };
  std::optional<Plan> plan{};

  /// Of a track that is new: its class, a number of MonitorDefinition::classes. Later it may not change.
  std::size_t track_class = 0;
};

}  // namespace kinesphere
