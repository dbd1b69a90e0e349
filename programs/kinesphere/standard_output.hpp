// Standard output and messages on standard error, with every write checked: a full disk must not pass for
// success.
#pragma once

#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace kinesphere::program {

/// Throws ProgramError naming the system's reason. What is buffered is checked by finish_output() alone.
void write_output(std::string_view text);
/// Everything so far has been written; otherwise throws ProgramError. To be called before success is
/// reported.
void finish_output();

template <class... Values>
void print(fmt::format_string<Values...> format, Values&&... values) {
  write_output(fmt::format(format, std::forward<Values>(values)...));
}

/// Writes a message to standard error. A failure ends nothing by itself, since a watch that runs for weeks is
/// worth more than its warnings; check_messages() tells of it.
void write_message(std::string_view text);
/// Throws ProgramError naming the system's reason if a message could not be written. To be called before
/// success is reported.
void check_messages();

template <class... Values>
void print_message(fmt::format_string<Values...> format, Values&&... values) {
  write_message(fmt::format(format, std::forward<Values>(values)...));
}

}  // namespace kinesphere::program
