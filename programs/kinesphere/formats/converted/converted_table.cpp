// Files of other formats, turned into tables that are read as all others are.
#include "formats/converted/converted_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/ascii_text.hpp"

namespace kinesphere::program {

std::optional<ConvertedTable> convert_to_table(std::string_view text, const std::string& file,
                                               bool geometric) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  if (auto table = convert_json_trace(text, file, geometric)) return table;
  if (auto table = convert_igc(text, file, geometric)) return table;
  for (auto* const convert : {&convert_gpx,
                              &convert_kml,
                              &convert_fcd,
                              &convert_trackmate,
                              &convert_lammps,
                              &convert_xyz,
                              &convert_gro,
                              &convert_pdb,
                              &convert_gps,
                              &convert_deeplabcut,
                              &convert_motion_capture,
                              &convert_vissim,
                              &convert_pneuma,
                              &convert_xvg,
                              &convert_oem,
                              &convert_ethovision,
                              &convert_flightradar24,
                              &convert_plt,
                              &convert_geojson,
                              &convert_json_records})
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
      {"a table of DeepLabCut", is_deeplabcut},
      {"an export of motion capture", is_motion_capture},
      {"a record of Vissim", is_vissim},
      {"a table of pNEUMA", is_pneuma},
      {"coordinates of GROMACS (.xvg)", is_xvg},
      {"an export of EthoVision", is_ethovision},
      {"a flight of Flightradar24", is_flightradar24},
      {"a track of OziExplorer or GeoLife (PLT)", is_plt},
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

}  // namespace kinesphere::program
