// Text of formats that are ASCII, whatever the locale.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace kinesphere::program {

/// Characters to trim around the fields of a line.
inline constexpr std::string_view blanks = " \t\r";

/// Returns the lower-case letter of A to Z, and any other character unchanged.
constexpr char lower_case(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

constexpr bool is_control(char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; }

/// Returns the text with blanks for control characters, so that it can neither add lines to a message nor
/// move the cursor of a terminal.
inline std::string without_controls(std::string text) {
  std::ranges::replace_if(text, is_control, ' ');
  return text;
}

/// Returns true if the text has letters and digits of ASCII and these other characters alone.
inline bool has_only(std::string_view text, std::string_view others) {
  return std::ranges::all_of(text, [&](char c) {
    return (lower_case(c) >= 'a' && lower_case(c) <= 'z') || (c >= '0' && c <= '9') ||
           others.find(c) != std::string_view::npos;
  });
}

/// Returns the text as it stands between the single quotes of a shell.
inline std::string between_single_quotes(std::string_view text) {
  std::string escaped;
  for (const char c : text) escaped += c == '\'' ? "'\\''" : std::string(1, c);
  return escaped;
}

/// Returns the text as a word of a shell's command line: in quotes, if need be.
inline std::string shell_word(std::string_view text) {
  if (!text.empty() && has_only(text, "_-.,:=/@%+")) return std::string(text);
  return "'" + between_single_quotes(text) + "'";
}

/// Returns true if the names are equal, ignoring the case of A to Z.
constexpr bool same_name(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, {}, lower_case, lower_case);
}

/// Returns the text without the blanks at its ends.
constexpr std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

}  // namespace kinesphere::program
