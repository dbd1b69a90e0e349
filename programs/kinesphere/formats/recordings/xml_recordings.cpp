// Recordings in XML, which expat reads: GPX, and the FCD output of SUMO.
#include <fmt/format.h>

#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>

#include "base/ascii_text.hpp"
#include "base/program_error.hpp"
#include "formats/recordings/recording_kinds.hpp"
#include "formats/tables/table_columns.hpp"

#ifdef KINESPHERE_WITH_EXPAT
#include <expat.h>
#endif

namespace kinesphere::program {
namespace {

/// Returns a text of XML as a field of a table: on one line, without the blanks around it.
[[maybe_unused]] std::string plain_text(std::string_view content) {
  return std::string(trimmed(without_controls(std::string(content))));
}

/// An element that begins or ends, or the file that has it.
struct XmlElement {
  std::string_view name{};            ///< without a prefix
  const char** attributes = nullptr;  ///< names and values in turn, and a null pointer behind them
  std::size_t line = 0;

  /// Returns an attribute as a field of a table; empty if there is none.
  std::string operator[](std::string_view key) const {
    for (const char** each = attributes; *each != nullptr; each += 2)
      if (each[0] == key) return plain_text(each[1]);
    return {};
  }
};

/// What is done with the elements of a file.
struct XmlActions {
  std::function<void(const XmlElement& element)> begin;
  /// `content`: the text since the last beginning of an element, as a field of a table.
  std::function<void(std::string_view name, const std::string& content)> end{};
};

#ifdef KINESPHERE_WITH_EXPAT

/// Takes what expat tells.
struct XmlHandler {
  const XmlActions& actions;
  std::unique_ptr<std::remove_pointer_t<XML_Parser>, decltype(&XML_ParserFree)> parser{
      XML_ParserCreate(nullptr), XML_ParserFree};
  std::string content{};

  std::size_t line() const { return XML_GetCurrentLineNumber(parser.get()); }
  static std::string_view local_name(std::string_view name) { return name.substr(name.rfind(':') + 1); }
  static XmlHandler& of(void* self) { return *static_cast<XmlHandler*>(self); }

  static void begin(void* self, const char* name, const char** attributes) {
    of(self).content.clear();
    of(self).actions.begin({local_name(name), attributes, of(self).line()});
  }
  static void end(void* self, const char* name) {
    if (of(self).actions.end) of(self).actions.end(local_name(name), plain_text(of(self).content));
  }
  static void add(void* self, const char* part, int size) {
    of(self).content.append(part, static_cast<std::size_t>(size));
  }
  // Entities of its own could make a small file huge.
  static void refuse_entity(void* self, const char*, int, const char*, int, const char*, const char*,
                            const char*, const char*) {
    XML_StopParser(of(self).parser.get(), XML_FALSE);
  }
};

/// Reads the whole file. `kind` is what it is, for messages. Throws ProgramError naming file and line.
void read_xml(const RecordingText& recording, std::string_view kind, const XmlActions& actions) {
  if (recording.text.size() > std::numeric_limits<int>::max())
    throw ProgramError(fmt::format("{}: expected {} of less than 2 GiB", recording.file, kind));
  XmlHandler handler{actions};
  XML_Parser parser = handler.parser.get();
  XML_SetUserData(parser, &handler);
  XML_SetElementHandler(parser, XmlHandler::begin, XmlHandler::end);
  XML_SetCharacterDataHandler(parser, XmlHandler::add);
  XML_SetEntityDeclHandler(parser, XmlHandler::refuse_entity);
  const auto size = static_cast<int>(recording.text.size());
  if (XML_Parse(parser, recording.text.data(), size, 1) == XML_STATUS_ERROR)
    throw ProgramError(fmt::format("{}:{}: expected {}: {}", recording.file, handler.line(), kind,
                                   XML_ErrorString(XML_GetErrorCode(parser))));
}

#else

void read_xml(const RecordingText& recording, std::string_view kind, const XmlActions&) {
  throw ProgramError(fmt::format("{}: {} needs expat, and this program was built without it (libexpat1-dev)",
                                 recording.file, kind));
}

#endif

}  // namespace

/// The points of tracks (trk).
RowTable read_gpx(const RecordingText& recording) {
  enum GpxColumn : std::size_t { of_time = 1, of_height = 4 };
  RowTable table("GPX", {"id", "time", "lon", "lat", "ele"});
  std::string track;
  std::size_t tracks = 0;
  bool is_in_track = false, is_in_point = false, has_times = false;
  const auto begin = [&](const XmlElement& element) {
    if (element.name == "trk") {
      track = fmt::format("track {}", ++tracks);
      is_in_track = true;
    } else if (element.name == "trkpt" && is_in_track) {
      is_in_point = true;
      table.add_row(element.line, track, "", element["lon"], element["lat"]);
    }
  };
  const auto end = [&](std::string_view name, const std::string& content) {
    if (name == "trk") is_in_track = false;
    if (name == "trkpt") is_in_point = false;
    if (is_in_point && name == "ele") table.set(of_height, content);
    if (is_in_point && name == "time") {
      table.set(of_time, content);
      has_times = has_times || !content.empty();
    }
    if (is_in_track && !is_in_point && name == "name") track = table.label(content);
  };
  read_xml(recording, "GPX", {begin, end});
  if (!has_times)
    throw ProgramError(
        fmt::format("{}: expected tracks (trk) whose points have times, as receivers log them, but {}",
                    recording.file, table.size() == 0 ? "it has no tracks" : "none has a time"));
  table.use_heights_of_all(recording.file);
  return table;
}

/// Vehicles and persons at each time step, in metres per second, and degrees clockwise from north. Vehicles
/// have their id; those of persons and containers are other names, so that they begin with the kind. Sizes
/// are attributes of them, or of their type where the file has it.
RowTable read_fcd(const RecordingText& recording) {
  constexpr std::string_view sizes[] = {"length", "width", "height"};
  constexpr std::size_t first_size = 6;
  RowTable table("SUMO FCD", {"vehicle_id", "time", "x", "y", "speed", "course"});
  table.place_on_body = TableColumns::Place::front;
  // The heights have to be the last column.
  if (recording.text.find(" length=") != recording.text.npos)
    for (const std::string_view name : sizes) table.column_of(fmt::format("vehicle_{}", name));
  const std::size_t height = table.column_of("z");
  std::map<std::string, std::string> types;  // sizes, by type/name
  std::string time;
  const auto size_of = [&](const std::string& type, std::string_view size) -> std::string& {
    return types[fmt::format("{}/{}", type, size)];
  };
  const auto begin = [&](const XmlElement& element) {
    const std::string_view name = element.name;
    if (name == "timestep") time = element["time"];
    if (name == "vType")
      for (const std::string_view size : sizes) size_of(element["id"], size) = element[size];
    if (name != "vehicle" && name != "person" && name != "container") return;
    const std::string kind = name == "vehicle" ? "" : std::string(name) + ' ';
    table.add_row(element.line, kind + element["id"], time, element["x"], element["y"], element["speed"],
                  element["angle"]);
    for (std::size_t k = 0; first_size + k < height; ++k) {
      const std::string own = element[sizes[k]];
      table.set(first_size + k, own.empty() ? size_of(element["type"], sizes[k]) : own);
    }
    table.set(height, element["z"]);
  };
  read_xml(recording, "FCD output of SUMO", {begin});
  table.use_heights_of_all(recording.file);
  return table;
}

}  // namespace kinesphere::program
