// What a file is that is no table of text.
#include "formats/file_kind.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace kinesphere::program {
namespace {

using namespace std::string_view_literals;

struct FileKind {
  std::string_view begins;
  std::string_view is;
};

constexpr std::string_view as_csv = ": write it as CSV, with pandas for example";

/// Files that begin with certain bytes.
constexpr FileKind kinds_by_bytes[] = {
    {"\xFF\xFE"sv, "text in UTF-16: convert it with iconv -f UTF-16 -t UTF-8"},
    {"\xFE\xFF"sv, "text in UTF-16: convert it with iconv -f UTF-16 -t UTF-8"},
    {"PK\3\4"sv, "a zip archive (or .xlsx, .kmz, .npz): unpack it, or write the sheet as CSV"},
    {"PK\5\6"sv, "an empty zip archive"},
    {"7z\xBC\xAF"sv, "a 7z archive: unpack it first"},
    {"\xFD"
     "7zXZ"sv,
     "compressed by xz: unpack it with xz -d, or use gzip"},
    {"\x28\xB5\x2F\xFD"sv, "compressed by zstd: unpack it with zstd -d, or use gzip"},
    {"BZh"sv, "compressed by bzip2: unpack it with bzip2 -d, or use gzip"},
    {"\xD0\xCF\x11\xE0"sv, "a sheet of old Excel (.xls): save it as CSV"},
    {"Obj\1"sv, "an Avro file: write it as CSV"},
    {"RDX"sv, "data of R: write it as CSV, with write.csv"},
    {"PAR1"sv, "a Parquet file: write it as CSV, with pandas: read_parquet(...).to_csv(...)"},
    {"ARROW1"sv, "an Arrow file: write it as CSV, with pandas: read_feather(...).to_csv(...)"},
    {"\x89HDF"sv, "an HDF5 file (or .mat of version 7.3, or NetCDF 4): write its table as CSV"},
    {"CDF\1"sv, "a NetCDF file: write its table as CSV"},
    {"CDF\2"sv, "a NetCDF file: write its table as CSV"},
    {"MATLAB"sv, "a .mat file: write its table as CSV, with writetable"},
    {"\x93NUMPY"sv, "a NumPy file: write it as CSV, with numpy.savetxt"},
    {"SQLite format 3"sv, "a SQLite database: write its table as CSV, with sqlite3 -csv -header"},
    {"#ROSBAG"sv, "a ROS bag: write the topic as CSV"},
    {"ULog\x01\x12\x35"sv, "a PX4 log: write it as CSV, with ulog2csv"},
    {"%PDF"sv, "a PDF file"},
    {"{\\rtf"sv, "a document of RTF: save it as text"},
    {"$GP"sv, "NMEA 0183: write it as CSV or GPX, with gpsbabel"},
    {"$GN"sv, "NMEA 0183: write it as CSV or GPX, with gpsbabel"},
};

/// XML by a word in its beginning.
constexpr FileKind kinds_of_xml[] = {
    {"<gpx", "a GPX file: write it as CSV, with gpsbabel -t -i gpx -f FILE -o unicsv -F FILE.csv"},
    {"<kml", "a KML file: write it as CSV, with gpsbabel -t -i kml -f FILE -o unicsv -F FILE.csv"},
    {"<fcd-export", "the FCD output of SUMO: write it as CSV, with SUMO's xml2csv.py"},
    {"<TrackMate", "a file of TrackMate: export the spots as CSV"},
    {"<html", "a page of HTML: save the table as CSV"},
    {"<!DOCTYPE html", "a page of HTML: save the table as CSV"},
};

bool has_begin(std::string_view text, std::string_view begin) {
  return text.substr(0, begin.size()) == begin;
}

}  // namespace

std::string other_file_kind(std::string_view beginning) {
  for (const FileKind& kind : kinds_by_bytes)
    if (has_begin(beginning, kind.begins)) return std::string(kind.is);
  // Text in UTF-16 may lack its mark.
  if (beginning.size() >= 4 && (beginning[0] == '\0') != (beginning[1] == '\0') &&
      (beginning[0] == '\0') == (beginning[2] == '\0') && (beginning[1] == '\0') == (beginning[3] == '\0'))
    return std::string(kinds_by_bytes[0].is);
  constexpr std::size_t place_of_tar = 257;
  if (beginning.size() > place_of_tar && has_begin(beginning.substr(place_of_tar), "ustar"))
    return "a tar archive: unpack it first";
  if (has_begin(beginning, "\xEF\xBB\xBF")) beginning.remove_prefix(3);
  beginning.remove_prefix(std::min(beginning.find_first_not_of(" \t\r\n"), beginning.size()));
  if (has_begin(beginning, "{") || has_begin(beginning, "["))
    return "JSON of none of the formats that are read (docs/tables.md): write it as CSV, for example with jq "
           "-r "
           "'[.id,.time,.x,.y]|@csv'";
  if (!has_begin(beginning, "<")) return {};
  const std::string_view head = beginning.substr(0, 4000);
  for (const FileKind& kind : kinds_of_xml)
    if (head.find(kind.begins) != std::string_view::npos) return std::string(kind.is);
  return fmt::format("XML{}", as_csv);
}

}  // namespace kinesphere::program
