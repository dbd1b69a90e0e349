// Checks of numbers on the command line, stricter and clearer than the parser's own.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>

namespace kinesphere::program {

/// Accepts a finite decimal number.
CLI::Validator finite_number();
/// Accepts digits only, from `least` to `largest`; the parser by itself takes -1 for 2^64 - 1 and 010 for 8.
CLI::Validator whole_number(std::uint64_t largest, std::uint64_t least = 0);

}  // namespace kinesphere::program
