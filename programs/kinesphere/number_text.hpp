// Numbers as text.
#pragma once

#include <optional>
#include <string_view>

namespace kinesphere::program {

/// The number that `text` is, all of it, when it is one and finite.
std::optional<double> parse_number(std::string_view text);

}  // namespace kinesphere::program
