// The catalogue of recordings that are read as a whole.
#include "formats/recordings/recording_kinds.hpp"

#include <algorithm>

#include "base/ascii_text.hpp"
#include "formats/tables/stream_format.hpp"

namespace kinesphere::program {
namespace {

/// The first kind that a text is counts.
constexpr RecordingKind kinds[] = {
    {"a trace of tar1090", is_json_trace, read_json_trace},
    {"GPX", [](std::string_view text) { return root_element(text) == "gpx"; }, read_gpx},
    {"the FCD output of SUMO", [](std::string_view text) { return root_element(text) == "fcd-export"; },
     read_fcd},
    {"a dump of LAMMPS", [](std::string_view text) { return text.starts_with("ITEM: "); }, read_lammps},
    {"XYZ", is_xyz, read_xyz},
    {"a log of a GPS receiver", is_gps_log, read_gps_log},
    {"an ephemeris (OEM)",
     [](std::string_view text) { return trimmed(text.substr(0, 100)).starts_with("CCSDS_OEM_VERS"); },
     read_oem},
    {"GeoJSON", is_geojson, read_geojson},
    {"a feed of GTFS-realtime", is_gtfs, read_gtfs},
    {"ASTERIX in JSON", is_asterix, read_asterix},
    {"a list of JSON records", is_json_list, read_json_list, true},
    {"JSON records in lines", are_json_lines, read_json_lines, true}};

}  // namespace

const RecordingKind* recording_kind_of(std::string_view beginning, const ColumnHints& hints) {
  if (beginning.starts_with("\xEF\xBB\xBF")) beginning.remove_prefix(3);
  const bool is_said = !hints.columns.empty() || hints.format == "json";
  const auto* const found = std::ranges::find_if(kinds, [&](const RecordingKind& kind) {
    return (kind.is_json_records || hints.format != "table") && kind.is_of_it(beginning);
  });
  if (found == std::end(kinds)) return nullptr;
  constexpr std::size_t enough = 4096;
  const bool may_be_messages = found->read == read_json_lines && !is_said;
  return may_be_messages && recognised_format(beginning.substr(0, enough)) ? nullptr : found;
}

std::string_view root_element(std::string_view text) {
  for (;;) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
    if (!text.starts_with('<')) return {};
    const bool is_comment = text.starts_with("<!--");
    if (!is_comment && !text.starts_with("<?") && !text.starts_with("<!")) break;
    // A document type may have declarations in brackets.
    const bool has_declarations = !is_comment && text.find('[') < text.find('>');
    const std::string_view end = is_comment ? "-->" : has_declarations ? "]>" : ">";
    text.remove_prefix(std::min(text.find(end), text.size() - end.size()) + end.size());
  }
  text.remove_prefix(1);
  const std::string_view name = text.substr(0, text.find_first_of(" \t\r\n/<>"));
  return name.substr(name.rfind(':') + 1);
}

}  // namespace kinesphere::program
