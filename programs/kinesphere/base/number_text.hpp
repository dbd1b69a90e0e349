// Numbers as text.
#pragma once

#include <optional>
#include <string_view>

namespace kinesphere::program {

/// Returns the finite number that the whole `text` spells; nothing if it is not one.
std::optional<double> parse_number(std::string_view text);

}  // namespace kinesphere::program
