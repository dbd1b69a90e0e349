// Files of other formats, turned into tables that are read as all others are.
#include "formats/converted_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "ascii_text.hpp"
#include "number_text.hpp"

namespace kinesphere::program {

std::optional<ConvertedTable> convert_to_table(std::string_view text, const std::string& file,
                                               bool geometric) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  if (auto table = convert_json_trace(text, file, geometric)) return table;
  if (auto table = convert_igc(text, file, geometric)) return table;
  for (auto* const convert : {&convert_gpx, &convert_kml, &convert_fcd, &convert_trackmate, &convert_lammps,
                              &convert_xyz, &convert_gro, &convert_pdb, &convert_gps, &convert_deeplabcut,
                              &convert_motion_capture, &convert_vissim, &convert_pneuma, &convert_xvg,
                              &convert_oem, &convert_geojson, &convert_json_records})
    if (auto table = convert(text, file)) return table;
  return std::nullopt;
}

std::string_view kind_of_recording(std::string_view beginning) {
  if (beginning.starts_with("\xEF\xBB\xBF")) beginning.remove_prefix(3);
  struct RecordingKind {
    std::string_view name;
    bool (*is_of_it)(std::string_view text);
  };
  constexpr RecordingKind kinds[] = {
      {"a trace of tar1090", is_json_trace},
      {"a flight log (IGC)", is_igc},
      {"GPX", [](std::string_view each) { return is_xml_with(each, "<gpx"); }},
      {"KML", [](std::string_view each) { return is_xml_with(each, "<kml"); }},
      {"the FCD output of SUMO", [](std::string_view each) { return is_xml_with(each, "<fcd-export"); }},
      {"tracks of TrackMate", [](std::string_view each) { return is_xml_with(each, "<Tracks "); }},
      {"a dump of LAMMPS", [](std::string_view each) { return each.starts_with("ITEM: "); }},
      {"XYZ", is_xyz},
      {"a .gro file of GROMACS", is_gro},
      {"a PDB file", is_pdb},
      {"a log of a GPS receiver", is_gps_log},
      {"a table of DeepLabCut", [](std::string_view each) { return each.starts_with("scorer,"); }},
      {"an export of motion capture", is_motion_capture},
      {"a record of Vissim", is_vissim},
      {"a table of pNEUMA", is_pneuma},
      {"coordinates of GROMACS (.xvg)", is_xvg},
      {"an ephemeris (OEM)",
       [](std::string_view each) { return trimmed(each.substr(0, 100)).starts_with("CCSDS_OEM_VERS"); }},
      {"GeoJSON", is_geojson},
      {"a list of JSON records", is_json_list}};
  for (const auto& [name, is_of_it] : kinds)
    if (is_of_it(beginning)) return name;
  return {};
}

ProgramError without_expat(const std::string& file, std::string_view kind) {
  return ProgramError(
      fmt::format("{}: {} needs expat, and this program was built without it (libexpat1-dev)", file, kind));
}

std::string warning_of_heights(const std::string& file, std::string_view height) {
  return fmt::format("{}: some points have no height ({}), so that none is used", file, height);
}

bool is_xml_with(std::string_view text, std::string_view element) {
  return text.substr(std::min(text.find_first_not_of(" \t\r\n"), text.size())).starts_with('<') &&
         text.substr(0, 4000).find(element) != std::string_view::npos;
}

std::optional<std::string_view> LineCutter::next() {
  if (rest_.empty()) return std::nullopt;
  const std::size_t end = rest_.find('\n');
  has_end_ = end != std::string_view::npos;
  whole_ = rest_.substr(0, end);
  rest_.remove_prefix(std::min(whole_.size() + 1, rest_.size()));
  ++line_;
  return trimmed(whole_);
}

std::string Unwrapper::position(const std::string& id, const std::array<std::string_view, 3>& texts) {
  const std::string as_it_is = fmt::format(",{},{},{}", texts[0], texts[1], texts[2]);
  if (!is_periodic()) return as_it_is;
  std::array<double, 3> place{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto number = parse_number(texts[axis]);
    if (!number) return as_it_is;
    place[axis] = *number;
  }
  const auto [last, is_new] = last_.try_emplace(id, place);
  bool has_jumped = false;
  // The last vector alone has a part along z, the first none but along x.
  for (std::size_t k = 3; !is_new && k-- > 0;) {
    const auto& vector = cell_[k];
    if (!(vector[k] > 0.0)) continue;
    const double jumps = std::round((place[k] - last->second[k]) / vector[k]);
    has_jumped = has_jumped || jumps != 0.0;
    for (std::size_t axis = 0; axis <= k; ++axis) place[axis] -= jumps * vector[axis];
  }
  last->second = place;
  return has_jumped ? fmt::format(",{},{},{}", place[0], place[1], place[2]) : as_it_is;
}

std::string Unwrapper::warning(const std::string& file) {
  return fmt::format(
      "{}: its box is periodic: tracks go on through its faces, but distances through them are not seen",
      file);
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (;;) {
    line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
    if (line.empty()) return words;
    words.push_back(line.substr(0, line.find_first_of(blanks)));
    line.remove_prefix(words.back().size());
  }
}

std::vector<std::string_view> fields_of(std::string_view line, char separator) {
  std::vector<std::string_view> fields;
  if (separator == ' ') {
    fields = words_of(line);
    if (fields.empty()) fields.emplace_back();
    return fields;
  }
  for (;;) {
    const std::size_t end = line.find(separator);
    fields.push_back(trimmed(line.substr(0, end)));
    if (end == std::string_view::npos) return fields;
    line.remove_prefix(end + 1);
  }
}

std::optional<std::size_t> count_in(std::string_view text) {
  std::size_t count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return count;
}

}  // namespace kinesphere::program
