// The kinds of recordings that are read as a whole, each with one reader.
#pragma once

#include <string>
#include <string_view>

#include "base/program_error.hpp"
#include "formats/tables/row_table.hpp"
#include "formats/tables/table_columns.hpp"

namespace kinesphere::program {

/// The whole text of a file, without a byte order mark.
struct RecordingText {
  std::string_view text;
  const std::string& file;  ///< its name, for messages
  bool geometric = false;   ///< heights of aircraft are those of satellite navigation
};

/// The entry of a kind in the catalogue.
struct RecordingKind {
  std::string_view name;  ///< what a file of it is, as "GPX"
  /// True for the beginning of such a text, of some thousand bytes, and for the whole of it.
  bool (*is_of_it)(std::string_view beginning);
  /// Returns the rows. Throws ProgramError naming the file and, for a damaged one, the line.
  RowTable (*read)(const RecordingText& recording);
  bool is_json_records = false;  ///< a table in JSON, which --format table does not exclude
};

/// Returns the kind of a text with this beginning; null for other text. Sentences of NMEA 0183 are a log of a
/// receiver only if none of AIS is among them. With --format table no kind counts but records in JSON.
/// Objects in lines that are messages by their names are records only with --columns or --format json.
const RecordingKind* recording_kind_of(std::string_view beginning, const ColumnHints& hints = {});

// One file each.
RowTable read_gpx(const RecordingText& recording);
RowTable read_fcd(const RecordingText& recording);
RowTable read_xyz(const RecordingText& recording);
RowTable read_lammps(const RecordingText& recording);
RowTable read_gps_log(const RecordingText& recording);
RowTable read_oem(const RecordingText& recording);
RowTable read_geojson(const RecordingText& recording);
RowTable read_gtfs(const RecordingText& recording);
RowTable read_asterix(const RecordingText& recording);
RowTable read_json_trace(const RecordingText& recording);
RowTable read_json_list(const RecordingText& recording);
RowTable read_json_lines(const RecordingText& recording);

// What a text is by its beginning.
bool is_gps_log(std::string_view text);
bool is_xyz(std::string_view text);
bool is_json_trace(std::string_view text);
bool is_geojson(std::string_view text);
bool is_gtfs(std::string_view text);
bool is_asterix(std::string_view text);
/// A list of objects.
bool is_json_list(std::string_view text);
/// An object in each line.
bool are_json_lines(std::string_view text);

}  // namespace kinesphere::program
