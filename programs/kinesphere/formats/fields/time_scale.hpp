// Converts the times of a file to those of the computation, and back.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "formats/fields/time_text.hpp"

namespace kinesphere::program {

/// Computed times are seconds since an origin near the recording, so that no digits are lost to a large
/// offset such as that of Unix times. A recording near zero keeps zero as its origin.
class TimeScale {
 public:
  /// Numbers of `unit` seconds each or, with `rate`, that many to a second. Range: both > 0.
  explicit TimeScale(TimeKind kind = TimeKind::number, double unit = 1.0, double rate = 1.0)
      : kind_(kind), unit_(unit), rate_(rate) {}

  /// Puts the origin near the times from first to last.
  void set_origin(const FileTime& first, const FileTime& last);

  TimeKind kind() const { return kind_; }
  /// Frames per second, if the file counts frames.
  double rate() const { return rate_; }
  /// True if text() returns a number.
  bool is_number() const { return kind_ == TimeKind::number || kind_ == TimeKind::frames; }
  double seconds(const FileTime& time) const;
  /// Returns the time in the file's form: a number of its unit, a date that ends in Z for UTC, a date without
  /// a zone if the file has none, or seconds since frame 0 for frames. It has all exact digits, but at most
  /// `most_decimals` decimals.
  std::string text(double seconds, int most_decimals = 17) const;
  /// Returns seconds since 1970 (of local time where dates have no zone) for dates, and for numbers that can
  /// only be such; nothing for other numbers.
  std::optional<double> since_1970(double seconds) const;

 private:
  /// Returns the shortest number of the file's unit that is this time. Precondition: the origin is 0.
  std::string shortest(double seconds) const;

  TimeKind kind_;
  double unit_;
  double rate_;
  std::int64_t origin_ = 0;
};

/// A time as people read it: a date and a time of day. The date is empty for a stream without dates.
struct Moment {
  std::string date, time;
};

/// Returns the time of day in UTC, or without a zone as the dates of the file, for a date or seconds since
/// 1970; otherwise the number of the file, with at most one decimal.
Moment moment_of(const TimeScale& times, double seconds);

}  // namespace kinesphere::program
