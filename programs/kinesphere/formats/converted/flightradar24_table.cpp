// Flights that Flightradar24 exports as CSV: latitude and longitude are one field.
#include <fmt/format.h>

#include <algorithm>

#include "base/program_error.hpp"
#include "formats/converted/converted_table.hpp"
#include "formats/fields/field_text.hpp"

namespace kinesphere::program {

bool is_flightradar24(std::string_view text) {
  return text.starts_with("Timestamp,UTC,Callsign,Position,Altitude,Speed,Direction");
}

std::optional<ConvertedTable> convert_flightradar24(std::string_view text, const std::string& file) {
  if (!is_flightradar24(text)) return std::nullopt;
  ConvertedTable table{.format = "Flightradar24", .text = "id,time_s,lat,lon,altitude_ft,speed_kt,course\n"};
  LineCutter lines(text);
  lines.next();
  while (const auto line = lines.next()) {
    std::string plain(*line);
    std::erase(plain, '"');
    const auto fields = fields_of(plain, ',');
    constexpr std::size_t all = 8;
    if (!plain.empty() && fields.size() != all)
      throw ProgramError(fmt::format(
          "{}:{}: expected 7 fields, the fourth \"LATITUDE,LONGITUDE\", but got {}{}", file, lines.line(),
          shown_field(*line), lines.has_end() ? "" : " in the last line, which may be cut off"));
    if (!plain.empty())
      table.text += fmt::format("{},{},{},{},{},{},{}", quoted_field(fields[2]), fields[0], fields[3],
                                fields[4], fields[5], fields[6], fields[7]);
    table.text += '\n';
  }
  return table;
}

}  // namespace kinesphere::program
