// From the times of a file to the times that are calculated with, and back.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "tracks/time_text.hpp"

namespace kinesphere::program {

/// What a file's times are.
enum class TimeKind {
  number,  ///< numbers of a unit
  frames,  ///< frame numbers
  date,    ///< dates in an unknown zone
  utc,     ///< dates with Z or an offset
};

/// Calculated with are seconds since an origin near the recording, so that no digits are lost to a large
/// offset such as that of Unix times. A recording that lies near zero keeps its own zero as origin.
class TimeScale {
 public:
  /// Numbers of `unit` seconds each or, with `rate`, so many to a second; both > 0.
  explicit TimeScale(TimeKind kind = TimeKind::number, double unit = 1.0, double rate = 1.0)
      : kind_(kind), unit_(unit), rate_(rate) {}

  /// Puts the origin near times from first to last.
  void set_origin(const FileTime& first, const FileTime& last);

  TimeKind kind() const { return kind_; }
  /// Frames per second, where frames are counted.
  double rate() const { return rate_; }
  /// Whether text() is a number.
  bool is_number() const { return kind_ == TimeKind::number || kind_ == TimeKind::frames; }
  double seconds(const FileTime& time) const;
  /// A time as the file would tell it: a number of the file's unit, in UTC a date that ends in Z, a date
  /// without a zone where the file has none; for frames seconds since frame 0. It has as many digits as are
  /// certain, but at most so many behind the point.
  std::string text(double seconds, int most_decimals = 17) const;

 private:
  TimeKind kind_;
  double unit_;
  double rate_;
  std::int64_t origin_ = 0;
};

}  // namespace kinesphere::program
