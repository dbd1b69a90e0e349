// Positions in a periodic box.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>

#include "formats/tables/row_table.hpp"

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
  /// Adds a row of id, time and position, whose texts stay as they are, unless it jumped. What is no number
  /// stays, too, and is refused by the reader of the rows.
  void add_row(RowTable& table, std::size_t line, const std::string& id, std::string_view time,
               const std::array<std::string_view, 3>& position);
  /// Returns the warning that distances through the faces are not seen.
  static std::string warning(const std::string& file);

 private:
  Cell cell_{};
  std::unordered_map<std::string, std::array<double, 3>> last_;
};

}  // namespace kinesphere::program
