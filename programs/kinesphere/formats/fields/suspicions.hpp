// Finds numbers that may mean something else than they seem: times that may be those of a clock, or days, and
// lengths that may be degrees.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

#include "formats/fields/time_text.hpp"

namespace kinesphere::program {

/// Gathers times whose column does not say a unit, as the numbers of their file.
class TimeCheck {
 public:
  void add(const FileTime& time);
  /// Returns "the times 93000 to 101530 may be those of a clock ..." if all are, as 101530 is 10:15:30, and
  /// they are in several minutes; seconds then have 60 to 99 as last digits, too. Else empty.
  std::string clock_suspicion() const;
  /// False once a time is none of a clock.
  bool may_be_clock() const { return is_clock_; }
  /// Returns "the times 45351.5 to 45351.6 may be days ..." if all are in the years that spreadsheets, MATLAB
  /// or astronomers count in days, and would otherwise be more than a hundred `samples` of one body a second;
  /// also if all are whole seconds as parts of a day, as 0.75001157 is 18:00:01, a minute or less apart;
  /// or "the times 2024.25 to 2024.26 may be years ..." if they would be more than ten thousand; else empty.
  std::string day_suspicion(std::size_t samples) const;

 private:
  static constexpr double unbounded = std::numeric_limits<double>::infinity();
  bool is_clock_ = true, has_seconds_ = false;
  bool are_parts_of_days_ = true, has_decimals_ = false;
  std::int64_t first_clock_ = 240'000, last_clock_ = 0;
  double least_ = unbounded, largest_ = -unbounded;
};

/// Gathers the x and y of a table whose names and units do not say whether they are lengths.
class DegreeCheck {
 public:
  void add(double x, double y);
  /// Returns "x (8 to 9) and y (47 to 48) may be degrees: say ..." if they have the range of degrees, are not
  /// all whole, and are farther from zero than 8 times their width. Where the origin lies among the positions
  /// or beside them, they are lengths: empty.
  std::string suspicion() const;

 private:
  static constexpr double unbounded = std::numeric_limits<double>::infinity();
  double least_x_ = unbounded, least_y_ = unbounded, largest_x_ = -unbounded, largest_y_ = -unbounded;
  bool all_whole_ = true;
};

}  // namespace kinesphere::program
