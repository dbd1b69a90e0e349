// Orbit ephemeris messages (OEM, CCSDS 502.0-B) in keywords and values: one object or several.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "base/ascii_text.hpp"
#include "base/program_error.hpp"
#include "formats/converted/converted_table.hpp"
#include "formats/fields/field_text.hpp"
#include "formats/fields/line_text.hpp"

namespace kinesphere::program {

std::optional<ConvertedTable> convert_oem(std::string_view text, const std::string& file) {
  if (!trimmed(text.substr(0, 100)).starts_with("CCSDS_OEM_VERS")) return std::nullopt;
  // Files with other frames or times are asked about by the names of these columns.
  ConvertedTable table{
      .format = "OEM",
      .text = "id,time,x_km,y_km,z_km,vx_km/s,vy_km/s,vz_km/s,center_name,ref_frame,time_system\n"};
  std::array<std::pair<std::string_view, std::string>, 4> values{
      {{"OBJECT_NAME", ""}, {"CENTER_NAME", ""}, {"REF_FRAME", ""}, {"TIME_SYSTEM", ""}}};
  LineCutter lines(text);
  std::size_t row_line = 2;
  bool is_covariance = false;
  while (const auto line = lines.next()) {
    const std::string_view key = trimmed(line->substr(0, line->find('=')));
    if (key.starts_with("COVARIANCE_ST")) is_covariance = key == "COVARIANCE_START";
    if (line->size() > key.size() && line->find('=') != std::string_view::npos) {
      for (auto& [name, value] : values)
        if (key == name) value = trimmed(line->substr(line->find('=') + 1));
      continue;
    }
    std::vector<std::string_view> words = words_of(*line);
    if (is_covariance || words.empty() || !(words[0][0] >= '0' && words[0][0] <= '9')) continue;
    if (words.size() < 4)
      throw ProgramError(
          fmt::format("{}:{}: expected a time and a position, but got '{}'", file, lines.line(), *line));
    for (; row_line < lines.line(); ++row_line) table.text += '\n';
    constexpr std::size_t with_velocity = 7;
    words.resize(with_velocity);
    table.text += fmt::format("{},{},{},{},{}\n", quoted_field(values[0].second), fmt::join(words, ","),
                              quoted_field(values[1].second), quoted_field(values[2].second),
                              quoted_field(values[3].second));
    ++row_line;
  }
  return table;
}

}  // namespace kinesphere::program
