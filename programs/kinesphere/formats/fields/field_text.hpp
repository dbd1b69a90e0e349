// The text of one field: numbers, missing values, its form in messages.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace kinesphere::program {

/// Returns a finite number, nothing for other text. With `decimal_comma`, 0,5 is 0.5 too. The minus may be
/// that of typography.
std::optional<double> number_field(std::string_view text, bool decimal_comma);
/// Returns what to do about a field that is no number, behind a colon: of decimal commas, thousands and
/// units; empty for others.
std::string number_advice(std::string_view field);
/// Returns the text with a decimal point where it has one decimal comma and nothing but digits, else itself.
/// `buffer` holds the changed text.
std::string_view with_decimal_point(std::string_view text, std::string& buffer);
/// True for a table whose numbers may have decimal commas: one with this separator.
constexpr bool has_decimal_commas(char separator) { return separator == ';' || separator == '\t'; }

/// Returns degrees with a hemisphere's letter or a sign of degrees: 47.5 N, S12.25, 47°30'15.5"N, 8 30.25 E,
/// 55-30.5N, 47:30:15.5; nothing for other text. `letters`: that of positive degrees, and that of negative
/// ones.
std::optional<double> angle_field(std::string_view text, bool decimal_comma, std::string_view letters);

/// True for what stands for no value: nothing, NaN, NaT, inf, NA, N/A, #N/A, <NA>, null, nil, none, nodata,
/// \N, -, --, ?, errors of spreadsheets, and the word ground, in any case.
bool is_missing(std::string_view field);
/// Returns the field on one line and shortened, for messages: in quotes, or the word nothing.
std::string shown_field(std::string_view field);

}  // namespace kinesphere::program
