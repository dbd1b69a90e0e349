// Splits a line into fields.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "tracks/time_scale.hpp"

namespace kinesphere::program {

/// Returns the first of ; , tab in the line, else a blank.
char field_separator_of(std::string_view line);

/// Drops blanks around fields, and quotes around whole ones. Separators in quotes belong to the field.
/// Returns false for an unclosed quote.
bool split_fields(std::string_view line, char separator, std::vector<std::string_view>& fields);

struct TimeField {
  FileTime time{};
  TimeKind kind = TimeKind::number;
};
/// Parses a number or a date; returns nothing for other text.
std::optional<TimeField> time_field(std::string_view text);

}  // namespace kinesphere::program
