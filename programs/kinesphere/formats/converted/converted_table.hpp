// Files of other formats, turned into tables that are read as all others are.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/program_error.hpp"

namespace kinesphere::program {

class JsonRows;

struct ConvertedTable {
  std::string format;  ///< for the summary
  /// A table with a header; its rows stand in the lines in which the file has them.
  std::string text;
  /// So many lines more than in the file stand before the rows: a file of JSON has no header.
  std::size_t lines_before = 0;
  /// So many rows stand for each line of the file.
  std::size_t rows_per_line = 1;
  std::vector<std::size_t> row_lines;  ///< of each row the line of the file; empty: see rows_per_line
  bool is_one_body = false;            ///< all rows are of one body, called like the file

  /// Returns the line of the file for a line of the text.
  std::size_t line_in_file(std::size_t line) const {
    if (line <= lines_before) return line;
    const std::size_t row = line - lines_before - 1;
    return row < row_lines.size() ? row_lines[row] : row / rows_per_line + 1;
  }
  std::vector<std::string> warnings;
};

/// Converts GPX (tracks of a GPS receiver), KML, GeoJSON, logs of NMEA 0183 and IGC, FCD output of SUMO,
/// orbit ephemeris messages, XYZ and extended XYZ, GRO, PDB, dumps of LAMMPS, tables of DeepLabCut, of
/// EthoVision and of motion capture, records of Vissim, tables of pNEUMA, coordinates of GROMACS, traces of
/// tar1090, flights of Flightradar24, PLT of OziExplorer and GeoLife, and JSON records; returns nothing for
/// other text. `geometric`: heights of aircraft are those of satellite navigation. Throws ProgramError naming
/// `file` and the line for a damaged file.
std::optional<ConvertedTable> convert_to_table(std::string_view text, const std::string& file,
                                               bool geometric);

// One file each. They return nothing for another format.
std::optional<ConvertedTable> convert_gpx(std::string_view text, const std::string& file);
std::optional<ConvertedTable> convert_fcd(std::string_view text, const std::string& file);
std::optional<ConvertedTable> convert_trackmate(std::string_view text, const std::string& file);
std::optional<ConvertedTable> convert_xyz(std::string_view text, const std::string& file);
std::optional<ConvertedTable> convert_lammps(std::string_view text, const std::string& file);
std::optional<ConvertedTable> convert_kml(std::string_view text, const std::string& file);
std::optional<ConvertedTable> convert_geojson(std::string_view text, const std::string& file);
std::optional<ConvertedTable> convert_oem(std::string_view text, const std::string& file);
std::optional<ConvertedTable> convert_json_records(std::string_view text, const std::string& file);
std::optional<ConvertedTable> convert_json_trace(std::string_view text, const std::string& file,
                                                 bool geometric);
std::optional<ConvertedTable> convert_igc(std::string_view text, const std::string& file, bool geometric);
std::optional<ConvertedTable> convert_gps(std::string_view text, const std::string& file);
std::optional<ConvertedTable> convert_gro(std::string_view text, const std::string& file);
std::optional<ConvertedTable> convert_pdb(std::string_view text, const std::string& file);
std::optional<ConvertedTable> convert_deeplabcut(std::string_view text, const std::string& file);
std::optional<ConvertedTable> convert_motion_capture(std::string_view text, const std::string& file);
std::optional<ConvertedTable> convert_vissim(std::string_view text, const std::string& file);
std::optional<ConvertedTable> convert_pneuma(std::string_view text, const std::string& file);
std::optional<ConvertedTable> convert_xvg(std::string_view text, const std::string& file);
std::optional<ConvertedTable> convert_ethovision(std::string_view text, const std::string& file);
std::optional<ConvertedTable> convert_flightradar24(std::string_view text, const std::string& file);
std::optional<ConvertedTable> convert_plt(std::string_view text, const std::string& file);

/// Returns what a text with this beginning is that convert_to_table() turns into a table, as "GPX"; empty for
/// another text. Sentences of NMEA 0183 are such only if none of AIS follows.
std::string_view kind_of_recording(std::string_view beginning);

/// Returns rows of JSON records as a table; nothing where no column was found.
std::optional<ConvertedTable> table_of(const JsonRows& rows);

// What a text is by its beginning.
bool is_igc(std::string_view text);
bool is_gps_log(std::string_view text);
bool is_deeplabcut(std::string_view text);
bool is_gro(std::string_view text);
bool is_pdb(std::string_view text);
bool is_xyz(std::string_view text);
bool is_vissim(std::string_view text);
bool is_pneuma(std::string_view text);
bool is_xvg(std::string_view text);
bool is_ethovision(std::string_view text);
bool is_flightradar24(std::string_view text);
bool is_plt(std::string_view text);
bool is_motion_capture(std::string_view text);
bool is_json_trace(std::string_view text);
bool is_geojson(std::string_view text);
/// A list of objects.
bool is_json_list(std::string_view text);
/// An object in each line.
bool are_json_lines(std::string_view text);
/// Lists of values, one for each name, such as {"time":[0,1],"x":[2,3]}.
bool is_columnar_json(std::string_view text);
/// A document of CZML, for CesiumJS.
bool is_czml(std::string_view text);
/// Streams of an activity of Strava, which are such lists.
bool is_strava(std::string_view text);

/// Returns the error for a file of a kind of XML in a program without expat.
ProgramError without_expat(const std::string& file, std::string_view kind);

/// Returns the warning of a file in which only some places have the height of this name.
std::string warning_of_heights(const std::string& file, std::string_view height);

/// Returns a table of places, each on the line of the file that it has (Place::line). `fields` returns all
/// fields of a place but its height (Place::height, perhaps empty). Unless all places have one, none is used,
/// with a warning.
template <class Place, class Fields>
ConvertedTable table_of_places(std::string_view format, const std::string& file, const std::string& columns,
                               const std::string& height, const std::vector<Place>& places, Fields fields) {
  const auto with_height =
      std::count_if(places.begin(), places.end(), [](const Place& place) { return !place.height.empty(); });
  const bool have_heights = with_height == std::ssize(places);
  ConvertedTable table{.format = std::string(format),
                       .text = columns + (have_heights ? "," + height : "") + "\n"};
  if (with_height > 0 && !have_heights) table.warnings.push_back(warning_of_heights(file, height));
  std::size_t line = 2;
  for (const Place& place : places) {
    for (; line < place.line; ++line) table.text += '\n';
    table.text += fields(place) + (have_heights ? "," + place.height : "") + "\n";
    ++line;
  }
  return table;
}

/// True for XML whose first elements contain `element`, such as "<gpx".
bool is_xml_with(std::string_view text, std::string_view element);

}  // namespace kinesphere::program
