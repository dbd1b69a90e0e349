// What the name of a column says: which quantity it has, in which unit.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "tracks/time_scale.hpp"

namespace kinesphere::program {

enum class Quantity { id, time, frame, x, y, longitude, latitude, z };

/// A unit of times: so many seconds each or, with `rate`, so many to a second.
struct TimeUnit {
  double seconds = 1.0;
  double rate = 1.0;
};
/// s, ms, us, ns, min, h, d.
std::optional<TimeUnit> time_unit_named(std::string_view name);
/// Metres of m, km, cm, mm, ft, nmi.
std::optional<double> length_unit_named(std::string_view name);

struct ColumnMeaning {
  Quantity quantity;
  std::string unit;  ///< as in x/m, "time [ms]", lat_deg; empty when the name has none
};

/// By the usual names in any case, with or without blanks, - and _ between their words; none for others.
std::optional<ColumnMeaning> meaning_of(std::string_view column_name);

}  // namespace kinesphere::program
