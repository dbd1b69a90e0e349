// Numbers as text.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace kinesphere::program {

/// Returns the finite number that the whole `text` spells; nothing if it is not one.
std::optional<double> parse_number(std::string_view text);

/// Returns 1234567 as "1,234,567".
std::string grouped(std::uint64_t count);

}  // namespace kinesphere::program
