// The fields of one line.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "tracks/time_scale.hpp"

namespace kinesphere::program {

/// The first of ; , tab that the line has, else a blank.
char field_separator_of(std::string_view line);

/// Blanks around fields, and quotes around whole ones, do not count. Separators in quotes belong to the
/// field. False for a quote that does not end.
bool split_fields(std::string_view line, char separator, std::vector<std::string_view>& fields);

struct TimeField {
  FileTime time{};
  TimeKind kind = TimeKind::number;
};
/// A number or a date. Nothing for another text.
std::optional<TimeField> time_field(std::string_view text);

}  // namespace kinesphere::program
