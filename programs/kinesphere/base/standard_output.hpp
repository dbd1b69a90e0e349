// Checked writes to standard output and standard error: a full disk must not pass for success.
#pragma once

#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace kinesphere::program {

/// Throws ProgramError naming the system's reason. Errors of buffered text appear in finish_output() alone.
void write_output(std::string_view text);
/// Flushes standard output. Throws ProgramError if any write failed. To be called before success is reported.
void finish_output();

/// Returns true if standard output is a terminal that shows colours, and NO_COLOR (no-color.org) does not
/// forbid them.
bool output_has_colour();
/// Returns output_has_colour() for these: whether it is a terminal, and the values of NO_COLOR and TERM, null
/// where they are not set.
bool has_colour(bool is_terminal, const char* no_color, const char* term);

template <class... Values>
void print(fmt::format_string<Values...> format, Values&&... values) {
  write_output(fmt::format(format, std::forward<Values>(values)...));
}

/// Writes a message to standard error. A failure is not thrown, since it must not end a watch that runs for
/// weeks; check_messages() reports it.
void write_message(std::string_view text);
/// Throws ProgramError naming the system's reason if a message could not be written. To be called before
/// success is reported.
void check_messages();

template <class... Values>
void print_message(fmt::format_string<Values...> format, Values&&... values) {
  write_message(fmt::format(format, std::forward<Values>(values)...));
}

}  // namespace kinesphere::program
