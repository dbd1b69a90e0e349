// Writes every event of a run to a table, one row each.
#pragma once

#include <cstdint>
#include <string>

#include "base/table_file.hpp"
#include "kinesphere/event.hpp"

namespace kinesphere::program {

/// Columns: time, kind, first, second (empty if there is none), wall (likewise), gap, approach_speed,
/// point_x/y/z, normal_x/y/z, repeated, position_excess, velocity_excess. Event documents their meaning.
class ContactLog {
 public:
  explicit ContactLog(const std::string& path);
  ContactLog(TableFormat format, OutputPlace place);
  void write(const Event& event);
  std::uint64_t sync() { return table_.sync(); }
  void commit() { table_.commit(); }

 private:
  TableFile table_;
};

}  // namespace kinesphere::program
