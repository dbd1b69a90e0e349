// Finds the header of a table below other lines.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace kinesphere::program {

/// Returns the number, from 1, of a line below the first whose fields are the usual names of a time or frame
/// and of two coordinates, as many as the next line has; instruments write what they know of a recording
/// above it. Nothing if there is none in the first 200 lines.
std::optional<std::size_t> line_of_later_header(std::string_view text);

}  // namespace kinesphere::program
