// Positions in a periodic box.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <unordered_map>

namespace kinesphere::program {

/// Undoes the jumps of positions at the faces of a periodic box: each goes on from the last of its atom by
/// less than half of the box.
class Unwrapper {
 public:
  /// Vectors along x, in the plane of x and y, and any; 0 where the box is not periodic.
  using Cell = std::array<std::array<double, 3>, 3>;
  void set_cell(const Cell& cell) { cell_ = cell; }
  /// Size of a box with right angles on each axis; 0 where it is not periodic.
  void set_box(const std::array<double, 3>& sizes) {
    cell_ = {{{sizes[0], 0.0, 0.0}, {0.0, sizes[1], 0.0}, {0.0, 0.0, sizes[2]}}};
  }
  bool is_periodic() const { return cell_ != Cell{}; }
  /// Returns the three texts of a position, each behind a comma: as they are, unless it jumped. What is no
  /// number stays, too, and is refused by the reader of the table.
  std::string position(const std::string& id, const std::array<std::string_view, 3>& texts);
  /// Returns the warning that distances through the faces are not seen.
  static std::string warning(const std::string& file);

 private:
  Cell cell_{};
  std::unordered_map<std::string, std::array<double, 3>> last_;
};

}  // namespace kinesphere::program
