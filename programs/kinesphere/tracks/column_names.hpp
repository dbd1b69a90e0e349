// Parses the names of columns: quantity and unit.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "tracks/time_scale.hpp"

namespace kinesphere::program {

enum class Quantity { id, time, frame, x, y, longitude, latitude, z };

/// A unit of time: `unit` seconds or, with `rate`, a number of steps in a second.
struct TimeUnit {
  double seconds = 1.0;
  double rate = 1.0;
};
/// Knows s, ms, us, ns, min, h, d; returns nothing for other names.
std::optional<TimeUnit> time_unit_named(std::string_view name);
/// Returns the metres of m, km, cm, mm, ft or nmi; nothing for other names.
std::optional<double> length_unit_named(std::string_view name);

struct ColumnMeaning {
  Quantity quantity;
  std::string unit;  ///< unit in the name, like x/m, "time [ms]", lat_deg; empty if there is none
};

/// Knows the usual names in any case, with or without blanks, - and _ between words; returns nothing for
/// others.
std::optional<ColumnMeaning> meaning_of(std::string_view column_name);

}  // namespace kinesphere::program
