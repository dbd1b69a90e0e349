// Finds lengths that may be degrees by their numbers.
#pragma once

#include <limits>
#include <string>

namespace kinesphere::program {

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
