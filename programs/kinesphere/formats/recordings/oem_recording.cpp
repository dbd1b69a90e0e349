// Orbit ephemeris messages (OEM, CCSDS 502.0-B) in keywords and values: one object or several.
#include <fmt/format.h>

#include <array>
#include <string>
#include <utility>

#include "base/ascii_text.hpp"
#include "base/program_error.hpp"
#include "formats/fields/line_text.hpp"
#include "formats/recordings/recording_kinds.hpp"

namespace kinesphere::program {

RowTable read_oem(const RecordingText& recording) {
  // Files with other frames or times are asked about by the names of these columns.
  constexpr std::size_t of_first_word = 1, words_with_velocity = 7;
  RowTable table("OEM", {"id", "time", "x_km", "y_km", "z_km", "vx_km/s", "vy_km/s", "vz_km/s", "center_name",
                         "ref_frame", "time_system"});
  std::array<std::pair<std::string_view, std::string>, 4> values{
      {{"OBJECT_NAME", ""}, {"CENTER_NAME", ""}, {"REF_FRAME", ""}, {"TIME_SYSTEM", ""}}};
  LineCutter lines(recording.text);
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
      throw ProgramError(fmt::format("{}:{}: expected a time and a position, but got '{}'", recording.file,
                                     lines.line(), *line));
    words.resize(words_with_velocity);
    table.add_row(lines.line(), values[0].second);
    for (std::size_t k = 0; k < words.size(); ++k) table.set(of_first_word + k, words[k]);
    for (std::size_t k = 1; k < values.size(); ++k)
      table.set(of_first_word + words.size() + k - 1, values[k].second);
  }
  return table;
}

}  // namespace kinesphere::program
