// What a file is that is no table of text.
#include "formats/recordings/file_kind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "base/ascii_text.hpp"
#include "formats/fields/line_text.hpp"
#include "formats/tables/column_names.hpp"

namespace kinesphere::program {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view as_players =
    "write it as a table with the columns frame, id, x and y, a row for each player, with kloppy for example";
constexpr std::string_view utf_16 = "text in UTF-16: convert it with iconv -f UTF-16 -t UTF-8";
constexpr std::string_view mode_s =
    "raw messages of Mode S (Beast or AVR): decode them with readsb or dump1090, and read port 30003 (SBS) "
    "or aircraft.json";
constexpr std::string_view vtk =
    "data of VTK: write the points of all steps as CSV, with ParaView: save data, all time steps";
constexpr std::string_view garmin_fit =
    "a FIT file: write it as GPX, with gpsbabel -i garmin_fit -f FILE -o gpx -F FILE.gpx";

// Of these docs/tables.md has a line of Python each.
constexpr std::string_view molecules =
    "frames of atoms (GRO or PDB): make a table with the line of pandas in docs/tables.md, of what gmx "
    "trjconv -pbc nojump writes";

struct FileKind {
  std::array<std::string_view, 7> begins;  ///< the bytes with which a file of it begins: one of these
  std::string_view is;
};

/// Files that begin with certain bytes. Line ends are \n.
constexpr FileKind kinds_by_bytes[] = {
    {{"\xFF\xFE\0\0"sv, "\0\0\xFE\xFF"sv}, "text in UTF-32: convert it with iconv -f UTF-32 -t UTF-8"},
    {{"\xFF\xFE"sv, "\xFE\xFF"sv}, utf_16},
    {{"PK\3\4"sv}, "a zip archive (or .xlsx, .kmz, .npz): unpack it, or write the sheet as CSV"},
    {{"PK\5\6"sv}, "an empty zip archive"},
    {{"7z\xBC\xAF"sv}, "a 7z archive: unpack it first"},
    {{"\xFD\x37zXZ"sv}, "compressed by xz: unpack it with xz -d, or use gzip"},
    {{"\x28\xB5\x2F\xFD"sv}, "compressed by zstd: unpack it with zstd -d, or use gzip"},
    {{"\x1F\x8B"sv}, "compressed by gzip twice: unpack it with gzip -d first"},
    {{"BZh"sv}, "compressed by bzip2: unpack it with bzip2 -d, or use gzip"},
    {{"\xD0\xCF\x11\xE0"sv}, "a sheet of old Excel (.xls): save it as CSV"},
    {{"Obj\1"sv}, "an Avro file: write it as CSV"},
    {{"RDX"sv}, "data of R: write it as CSV, with write.csv"},
    {{"PAR1"sv}, "a Parquet file: write it as CSV, with pandas: read_parquet(...).to_csv(...)"},
    {{"ARROW1"sv}, "an Arrow file: write it as CSV, with pandas: read_feather(...).to_csv(...)"},
    {{"\x89HDF"sv}, "an HDF5 file (or .mat of version 7.3, or NetCDF 4): write its table as CSV"},
    {{"CDF\1"sv, "CDF\2"sv}, "a NetCDF file: write its table as CSV"},
    {{"MATLAB"sv}, "a .mat file: write its table as CSV, with writetable"},
    {{"\x93NUMPY"sv}, "a NumPy file: write it as CSV, with numpy.savetxt"},
    {{"SQLite format 3"sv}, "a SQLite database: write its table as CSV, with sqlite3 -csv -header"},
    {{"ATOM  "sv, "HETATM"sv, "CRYST1"sv, "TITLE     "sv, "REMARK "sv, "MODEL  "sv, "HEADER    "sv},
     molecules},
    {{"#ROSBAG"sv}, "a ROS bag: write the topic as CSV"},
    {{"ULog\x01\x12\x35"sv}, "a PX4 log: write it as CSV, with ulog2csv"},
    {{"\x1A\x31"sv, "\x1A\x32"sv, "\x1A\x33"sv}, mode_s},
    {{"%PDF"sv}, "a PDF file"},
    {{"\xD4\xC3\xB2\xA1"sv, "\n\r\r\n"sv},
     "a recording of a network (pcap): write what it carries as text, with tshark"},
    {{"\x80\4"sv, "\x80\5"sv},
     "a pickle of Python: write it as CSV, with pandas: read_pickle(...).to_csv(...)"},
    {{"version https://git-lfs"sv}, "what Git keeps in place of a large file: fetch that with git lfs pull"},
    {{"{'"sv}, "dictionaries as Python prints them: write each with json.dumps"},
    {{"{\\rtf"sv}, "a document of RTF: save it as text"},
    {{"\0\0\x07\xCB"sv, "\0\0\x07\xC9"sv, "T\0\0\0CORD"sv},
     "a trajectory of molecular dynamics (XTC, TRR or DCD): write it as XYZ, with MDAnalysis: "
     "Universe(...).atoms.write('atoms.xyz', frames='all')"},
    {{"\x02P"sv}, "a C3D file of motion capture: write it as CSV, with ezc3d or Mokka"},
    {{"\xB5\x62"sv}, "raw data of a u-blox receiver: write it as NMEA or GPX, with gpsbabel or RTKLIB"},
    {{"\x89MCAP0"sv}, "a log of ROS 2 (MCAP): write the topic as CSV"},
    {{"\0\0\x27\x0A"sv}, "a shapefile: write its points as CSV, with ogr2ogr -lco GEOMETRY=AS_XY"},
    {{"stk.v."sv}, "an ephemeris of STK: write its rows as CSV, with columns id, time, x, y, z"},
    {{"#aP"sv, "#cP"sv, "#dP"sv}, "an ephemeris (SP3): write it as CSV, with columns id, time, x, y, z"},
    {{"FMT, 128,"sv, "\xA3\x95"sv},
     "an ArduPilot log: write its messages GPS as CSV, with mavlogdump.py --types GPS --format csv"},
    {{"# vtk DataFile"sv}, vtk},
    {{"\xDF\x65\xDF\x65"sv}, "a trajectory of HOOMD (GSD): write it as XYZ, with OVITO, or as CSV"},
    {{"---\ncreator: LAMMPS"sv}, "a dump of LAMMPS in YAML: write it with dump_style custom, as text"},
    {{"HIERARCHY"sv}, "motion capture as angles of joints (BVH): write positions as CSV, with Blender"},
    {{"#!OML:ASF"sv, ":FULLY-SPECIFIED"sv},
     "motion capture as angles of joints (AMC): write positions as CSV, with Blender"},
    {{"Trajectories\n"sv, "PathFileType\t"sv, "NO_OF_FRAMES\t"sv, "Format Version,1."sv},
     "motion capture with columns of each marker (Vicon, TRC, Qualisys or OptiTrack): make a table with the "
     "line of pandas in docs/tables.md"},
    {{"$VISION"sv, "$VEHICLE:"sv, "$PEDESTRIAN:"sv},
     "a record of Vissim: make a table with the line of pandas in docs/tables.md"},
    {{"track_id; type; traveled_d; avg_speed; "sv},
     "a table of pNEUMA, with many places in a row: make a table with the line of pandas in docs/tables.md"},
    {{"OziExplorer Track Point File"sv},
     "a track of OziExplorer (PLT): write it as GPX, with gpsbabel -i ozi -f FILE -o gpx -F FILE.gpx"},
    {{"Geolife trajectory"sv},
     "a walk of GeoLife (PLT): make a table with the line of pandas in docs/tables.md"},
    {{"Timestamp,UTC,Callsign,Position,Altitude,Speed,Direction\n"sv},
     "a flight of Flightradar24, whose places are one field: split it, with the line of pandas in "
     "docs/tables.md"},
    {{"\"Number of header lines:"sv, "Number of header lines:"sv},
     "an export of EthoVision, with lines about the trial: leave them out, with the line of pandas in "
     "docs/tables.md"},
    {{"CCSDS_OPM_VERS"sv}, "one state of an orbit (OPM), no path: propagate it, and write an OEM or CSV"},
    {{"MTrackJ "sv}, "tracks of MTrackJ: write them as CSV, with Measure, which shows a table of points"},
    {{"*******************************************************************************\nEphemeris / "sv},
     "an ephemeris of JPL (HORIZONS): write its rows between $$SOE and $$EOE as CSV, with columns id, time, "
     "x, y, z"},
    {{"Type,Local Number,Message,Field 1,Value 1,Units 1"sv},
     "a FIT file as its SDK prints it: write the .fit file as GPX, with gpsbabel -i garmin_fit -f FILE -o "
     "gpx -F FILE.gpx"},
    {{"header: \n"sv, "header:\n"sv},
     "messages as rostopic echo prints them: write a table, with rostopic echo -p (ros2 topic echo --csv)"},
};

/// XML by its outermost element.
constexpr std::pair<std::string_view, std::string_view> kinds_of_xml[] = {
    {"TrainingCenterDatabase",
     "a TCX file: write it as GPX, with gpsbabel -i gtrnctr -f FILE -o gpx -F FILE.gpx"},
    {"kml",
     "KML: write its tracks with times (gx:Track) as GPX, with gpsbabel -i kml -f FILE -o gpx -F FILE.gpx"},
    {"events",
     "events of MATSim, which say links and no places: write positions as CSV, with Via, or the end of each "
     "link with its time"},
    {"oem", "an ephemeris (OEM): write its rows as CSV, with columns id, time, x, y, z"},
    {"TrackMate", "a file of TrackMate: export the spots of its tracks as CSV"},
    {"Tracks",
     "tracks of TrackMate in XML: export its spots as CSV, or use the line of Python in docs/tables.md"},
    {"VTKFile", vtk},
    {"mvnx", "motion capture of Xsens (MVNX): write it as C3D or CSV, with MVN"},
    {"trackfile", "tracks of Icy: write them as CSV, with its track manager"},
    {"trajectories", "trajectories of JuPedSim in XML: write them as text, with <format>plain</format>"},
    {"html", "a page of HTML: save the table as CSV"},
};

/// A set of two lines of orbital elements: numbers 1 and 2, and the same satellite.
bool are_orbital_elements(std::string_view first, std::string_view second) {
  const auto is_line = [](std::string_view line, char number) {
    return line.size() == 69 && line[0] == number && line[1] == ' ' && line[8] == ' ';
  };
  return is_line(first, '1') && is_line(second, '2') && first.substr(2, 5) == second.substr(2, 5);
}

/// A frame of TRACAB: its number, "team,id,shirt,x,y,speed;" of each player, and the ball, with : between
/// them.
bool is_tracab(std::string_view line) {
  const std::size_t colon = line.find_first_not_of("0123456789");
  return colon != 0 && line.substr(std::min(colon, line.size())).starts_with(':') && line.ends_with(":") &&
         line.find(';') != line.npos;
}

/// A segment of SO6: its name, A_B, 20 words in all, of which the eleventh and twelfth are days, yymmdd.
bool is_so6(std::string_view line) {
  const auto words = words_of(line);
  return words.size() == 20 && words[0].find('_') != words[0].npos && words[10].size() == 6 &&
         words[11].size() == 6 && words[10].find_first_not_of("0123456789") == words[10].npos;
}

/// A frame of GROMACS: below a title a count, and atoms with two numbers of five columns before their places.
bool is_gro(std::string_view second, std::string_view third) {
  return count_in(trimmed(second)) && third.size() > 20 && count_in(trimmed(third.substr(0, 5))) &&
         count_in(trimmed(third.substr(15, 5))) && third.find('.', 20) != third.npos;
}

/// The rows above the numbers of DeepLabCut and Lightning Pose.
bool is_deeplabcut(const std::array<std::string_view, 3>& lines) {
  return lines[0].starts_with("scorer,") &&
         ((lines[1].starts_with("bodyparts,") && lines[2].starts_with("coords,")) ||
          (lines[1].starts_with("individuals,") && lines[2].starts_with("bodyparts,")));
}

/// An object of JSON behind other text, as mosquitto_sub -v and servers that send events write it.
bool has_json_behind_text(std::string_view line) {
  const std::size_t object = line.find("{\"");
  return object != 0 && object != line.npos && line.ends_with('}') && line.find_first_of(",;[") > object;
}

/// Files that are known by their first lines.
std::string kind_by_lines(std::string_view text) {
  constexpr auto elements =
      "orbital elements ({}), not positions: python/examples/conjunctions.py finds the approaches of a TLE "
      "(docs/satellites.md)";
  if (has_orbital_elements(text)) return fmt::format(elements, "OMM");
  const std::string_view head = text.substr(0, 4096);
  std::array<std::string_view, 3> lines;
  for (std::string_view& line : lines) {
    line = take_part(text, '\n');
    if (line.ends_with('\r')) line.remove_suffix(1);
  }
  if (are_orbital_elements(lines[0], lines[1]) || are_orbital_elements(lines[1], lines[2]))
    return fmt::format(elements, "TLE");
  if (has_json_behind_text(lines[0]) || has_json_behind_text(lines[1]))
    return "JSON behind other text: leave that out, with sed -n 's/^[^{]*{/{/p' (-u in a pipe)";
  if (head.substr(0, 400).find("\nData Block ") != head.npos || lines[0].starts_with("Asterix.CAT"))
    return "ASTERIX as text: write it as JSON, with asterix -j";
  if (lines[0].starts_with("$node_(") || lines[0].starts_with("$ns_ at"))
    return "movements of ns-2, which say where each goes next and how fast: write the time and place at both "
           "ends of each move as a row of a table with the columns id, time, x and y";
  if (lines[0].starts_with("HFDTE") || (lines[0].starts_with("A") && head.find("\nHFDTE") != head.npos))
    return "a flight log (IGC): write it as GPX, with gpsbabel -i igc -f FILE -x "
           "track,name=PRESALTTRK,pack,title=NAME -o gpx -F FILE.gpx (or name=GNSSALTTRK)";
  if (is_gro(lines[1], lines[2])) return std::string(molecules);
  if (is_deeplabcut(lines))
    return "a table of DeepLabCut, with rows of names above its numbers: make a table with the line of "
           "pandas in docs/tables.md";
  if (is_tracab(lines[0])) return fmt::format("tracking data of TRACAB: {}", as_players);
  if (lines[0].starts_with(",,,Home,") || lines[0].starts_with(",,,Away,"))
    return fmt::format("tracking data of Metrica, in parts of the pitch: {}", as_players);
  if (is_so6(lines[0]))
    return "segments of flights (SO6): write both ends of each as rows of a table with the columns id, time, "
           "lon, lat and FL; its angles are minutes";
  const bool is_of_grace = lines[0].starts_with('#') || lines[0].starts_with('@');
  if (is_of_grace && head.find("axis  label \"") != head.npos)
    return "coordinates of GROMACS in a column each (.xvg): make a table with the line of pandas in "
           "docs/tables.md";
  if ((lines[0].starts_with('*') || lines[0].starts_with('@')) && lines[0].ends_with(';') &&
      lines[0].find_first_not_of("0123456789abcdefABCDEF", 1) == lines[0].size() - 1)
    return std::string(mode_s);
  return {};
}

/// Returns the beginning of a text without certain characters.
std::string beginning_without(std::string_view text, std::string_view characters) {
  std::string kept(text.substr(0, 4096));
  std::erase_if(kept, [&](char c) { return characters.find(c) != characters.npos; });
  return kept;
}

/// JSON that has none of the forms that are read; empty for other text.
std::string kind_of_json(std::string_view text) {
  if (is_czml(text))
    return "CZML, whose positions are in a list of each body: write it as KML, GeoJSON or CSV";
  if (is_columnar_json(text))
    return text.find("\"latlng\"") != text.npos || text.find("\"series_type\"") != text.npos
               ? "streams of Strava, whose times count from the start of their activity: export the activity "
                 "as GPX, which has dates"
               : "JSON with a list for each name: write it as records, with pandas: "
                 "to_json(orient='records', lines=True)";
  // Lines of logs may begin with [INFO].
  const bool is_json = text.starts_with("{") ||
                       (text.starts_with("[") &&
                        text.find_first_of("{[\"0123456789-]", 1) == text.find_first_not_of(" \t\r\n", 1));
  return is_json ? "JSON of none of the formats that are read (docs/tables.md): write it as CSV, for example "
                   "with jq -r '[.id,.time,.x,.y]|@csv'; jq -c . writes records over several lines, or "
                   "several in one, each in a line"
                 : "";
}

}  // namespace

bool has_orbital_elements(std::string_view beginning) {
  const std::string_view head = beginning.substr(0, 4000);
  return head.find("MEAN_MOTION") != head.npos && head.find("ECCENTRICITY") != head.npos;
}

bool is_columnar_json(std::string_view text) {
  // Names that are none of columns, of activities.
  constexpr std::string_view activity =
      "latlng distance velocity_smooth heartrate cadence watts temp moving grade_smooth";
  const std::string compact = beginning_without(text, " \t\r\n");
  std::string_view rest = compact;
  if (rest.starts_with('[')) rest.remove_prefix(1);
  if (!rest.starts_with("{\"")) return false;
  rest.remove_prefix(2);
  std::string_view name = take_part(rest, '"');
  // A list of columns names each by its type.
  const bool is_typed = name == "type" && rest.starts_with(":\"");
  if (is_typed) {
    rest.remove_prefix(2);
    name = take_part(rest, '"');
  }
  if (!meaning_of(name) && !is_word_of(name, activity)) return false;
  if (is_typed) return compact.substr(0, 200).find("\"data\"") != compact.npos;
  return rest.starts_with(":[") || rest.starts_with(":{\"0\":") || rest.starts_with(":{\"data\":[");
}

bool is_czml(std::string_view text) {
  return beginning_without(text, " \t\r\n").starts_with("[{\"id\":\"document\"");
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

std::string other_file_kind(std::string_view beginning) {
  if (beginning.empty()) return {};
  const std::string with_line_feeds = beginning_without(beginning, "\r");
  for (const auto& [begins, is] : kinds_by_bytes)
    for (const std::string_view begin : begins)
      if (!begin.empty() && (beginning.starts_with(begin) || with_line_feeds.starts_with(begin)))
        return std::string(is);
  // Text in UTF-16 may lack its mark.
  if (beginning.size() >= 4 && (beginning[0] == '\0') != (beginning[1] == '\0') &&
      (beginning[0] == '\0') == (beginning[2] == '\0') && (beginning[1] == '\0') == (beginning[3] == '\0'))
    return std::string(utf_16);
  const std::size_t first_return = beginning.find('\r');
  if (first_return < beginning.size() - 1 && beginning.find('\n') == std::string_view::npos)
    return "text whose lines end as on old Macs: convert it with tr '\\r' '\\n'";
  constexpr std::size_t place_of_tar = 257, place_of_fit = 8;
  if (beginning.substr(std::min(place_of_tar, beginning.size())).starts_with("ustar"))
    return "a tar archive: unpack it first";
  if (beginning.substr(std::min(place_of_fit, beginning.size())).starts_with(".FIT"))
    return std::string(garmin_fit);
  if (std::string kind = kind_by_lines(beginning); !kind.empty()) return kind;
  if (beginning.starts_with("\xEF\xBB\xBF")) beginning.remove_prefix(3);
  beginning.remove_prefix(std::min(beginning.find_first_not_of(" \t\r\n"), beginning.size()));
  if (std::string kind = kind_of_json(beginning); !kind.empty()) return kind;
  if (!beginning.starts_with('<')) return {};
  const auto* const kind = std::ranges::find_if(
      kinds_of_xml, [&](const auto& each) { return same_name(root_element(beginning), each.first); });
  return kind != std::end(kinds_of_xml) ? std::string(kind->second)
                                        : "XML: write it as CSV, with pandas for example";
}

}  // namespace kinesphere::program
