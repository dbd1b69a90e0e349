// The text of one field: numbers, missing values, its form in messages.
#include "formats/fields/field_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/ascii_text.hpp"
#include "base/number_text.hpp"

namespace kinesphere::program {

std::string_view with_decimal_point(std::string_view text, std::string& buffer) {
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos || text.find_first_not_of("0123456789,+-eE") != std::string_view::npos)
    return text;
  buffer.assign(text);
  buffer[comma] = '.';
  return buffer;
}

std::optional<double> number_field(std::string_view text, bool decimal_comma) {
  if (const auto number = parse_number(text)) return number;
  constexpr std::string_view minus = "\xE2\x88\x92";
  if (text.starts_with(minus))
    return number_field('-' + std::string(text.substr(minus.size())), decimal_comma);
  std::string buffer;
  return decimal_comma ? parse_number(with_decimal_point(text, buffer)) : std::nullopt;
}

std::string number_advice(std::string_view field) {
  constexpr std::string_view digits = "0123456789";
  const std::size_t end = std::min(field.find_first_not_of("0123456789+-eE."), field.size());
  const std::string_view number = field.substr(0, end), rest = field.substr(end);
  if (number.find_first_of(digits) == std::string_view::npos || rest.empty()) return {};
  const bool is_decimal_comma = rest[0] == ',' && number.find('.') == std::string_view::npos &&
                                rest.find_first_not_of(digits, 1) == std::string_view::npos;
  constexpr std::size_t of_thousands = 4;
  if (is_decimal_comma && rest.size() == of_thousands && number.find_first_of("123456789") == 0)
    return ": leave out what separates thousands, or make a decimal comma a point";
  if (is_decimal_comma)
    return ": decimal commas are read where ; or tabs separate; else make them points, as sed -E "
           "'s/([0-9]),([0-9])/\\1.\\2/g' does";
  if (rest.size() > 1 && (rest[0] == 'D' || rest[0] == 'd') &&
      rest.find_first_not_of("+-0123456789", 1) == rest.npos)
    return ": exponents of Fortran are read as 1.5E+00, which sed -E 's/([0-9.])[Dd]([-+0-9])/\\1E\\2/g' "
           "writes";
  if (rest.find_first_of(digits) == std::string_view::npos)
    return ": leave units out, and say them in the name of the column or with --columns";
  // Narrow blanks and the apostrophe of typography begin with the last three bytes.
  return std::string_view(",' \xA0\xC2\xE2").find(rest[0]) == std::string_view::npos
             ? ""
             : ": leave out what separates thousands";
}

std::optional<double> angle_field(std::string_view text, bool decimal_comma, std::string_view letters) {
  std::string numbers;
  int hemispheres = 0, sign = 1;
  bool has_signs = false;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (const std::size_t which = letters.find(c);
        which != std::string_view::npos && (at == 0 || at + 1 == text.size())) {
      ++hemispheres;
      sign = which == 0 ? 1 : -1;
    } else if (c == ':' || (c == '-' && !numbers.empty() && numbers.back() != ' ')) {  // 55-30.5N, 47:30:15
      has_signs = has_signs || c == ':';
      numbers += ' ';
    } else if ((c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+') {
      numbers += c;
    } else if (c == ',' && decimal_comma) {
      numbers += '.';
    } else if (c == '\'' || c == '"' || static_cast<unsigned char>(c) >= 0x80) {  // also as UTF-8 and Latin 1
      has_signs = true;
      numbers += ' ';
    } else if (c == ' ') {
      numbers += ' ';
    } else {
      return std::nullopt;
    }
  }
  double degrees = 0.0, unit = 1.0;
  int parts = 0;
  for (std::string_view rest = trimmed(numbers); !rest.empty(); ++parts) {
    const std::string_view word = rest.substr(0, rest.find(' '));
    rest = trimmed(rest.substr(word.size()));
    const auto number = parse_number(word);
    if (!number || parts == 3 || (parts > 0 && !(*number >= 0.0 && *number <= 60.0))) return std::nullopt;
    degrees = parts == 0 ? *number : degrees + std::copysign(*number / unit, degrees);
    unit *= 60.0;
  }
  const bool is_signed = numbers.find_first_of("+-") != std::string::npos;
  if (parts == 0 || hemispheres > 1 || (hemispheres == 0 && !has_signs && parts < 2) ||
      (hemispheres == 1 && is_signed))
    return std::nullopt;
  return sign * degrees;
}

bool is_missing(std::string_view field) {
  constexpr std::string_view names[] = {
      "", "nan", "-nan", "inf", "-inf", "+inf", "infinity", "-infinity", "na", "n/a", "#n/a", "<na>", "nat",
      "null", "nil", "none", "\\N", "-", "--", "?", "nodata",
      // Of spreadsheets, of programs for Windows, and of aircraft that stand.
      "#value!", "#ref!", "#div/0!", "#num!", "nan(ind)", "-nan(ind)", "ground",
      // Of SAS and Stata, and long dashes.
      ".", "\xE2\x80\x93", "\xE2\x80\x94"};
  // 1.#QNAN0, -1.#IND and 1.#INF, of older programs for Windows.
  if (field.starts_with("1.#") || field.starts_with("-1.#")) return true;
  return std::any_of(std::begin(names), std::end(names),
                     [field](std::string_view name) { return same_name(field, name); });
}

std::string shown_field(std::string_view field) {
  if (field.empty()) return "nothing";
  constexpr std::size_t most = 60;
  std::string text(field.substr(0, most));
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return fmt::format("'{}{}'", text, field.size() > most ? "..." : "");
}

}  // namespace kinesphere::program
