// Every event of a run, one row each.
#pragma once

#include <cstdint>
#include <string>

#include "kinesphere/event.hpp"
#include "table_file.hpp"

namespace kinesphere::program {

/// Columns: time, kind, first, second (empty when there is none), wall (likewise), gap, approach_speed,
/// point_x/y/z, normal_x/y/z, repeated, position_excess, velocity_excess. See Event for their meaning.
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
