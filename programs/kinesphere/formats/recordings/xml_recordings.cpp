// Recordings in XML, which expat reads: GPX, and the FCD output of SUMO.
#include <fmt/format.h>

#include <limits>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>

#include "base/ascii_text.hpp"
#include "base/program_error.hpp"
#include "formats/recordings/recording_kinds.hpp"
#include "formats/recordings/track_labels.hpp"
#include "formats/tables/table_columns.hpp"

#ifdef KINESPHERE_WITH_EXPAT
#include <expat.h>
#endif

namespace kinesphere::program {
namespace {

#ifdef KINESPHERE_WITH_EXPAT

/// Calls `begin` and `end` of a derived class for each element of a file.
class XmlElements {
 public:
  /// `kind` is what the file is, for messages.
  XmlElements(const RecordingText& recording, std::string_view kind)
      : text_(recording.text), file_(recording.file), kind_(kind), parser_(XML_ParserCreate(nullptr)) {
    XML_SetUserData(parser_.get(), this);
    XML_SetElementHandler(
        parser_.get(),
        [](void* self, const char* name, const char** attributes) {
          static_cast<XmlElements*>(self)->content_.clear();
          static_cast<XmlElements*>(self)->begin(local_name(name), attributes);
        },
        [](void* self, const char* name) { static_cast<XmlElements*>(self)->end(local_name(name)); });
    XML_SetCharacterDataHandler(parser_.get(), [](void* self, const char* text_part, int size) {
      static_cast<XmlElements*>(self)->content_.append(text_part, static_cast<std::size_t>(size));
    });
    // Entities of its own could make a small file huge.
    XML_SetEntityDeclHandler(parser_.get(), [](void* self, const char*, int, const char*, int, const char*,
                                               const char*, const char*, const char*) {
      XML_StopParser(static_cast<XmlElements*>(self)->parser_.get(), XML_FALSE);
    });
  }
  XmlElements(const XmlElements&) = delete;
  XmlElements& operator=(const XmlElements&) = delete;

  /// Reads the whole text. Throws ProgramError naming file and line.
  void read_all() {
    if (text_.size() > std::numeric_limits<int>::max())
      throw ProgramError(fmt::format("{}: expected {} of less than 2 GiB", file_, kind_));
    const XML_Status status = XML_Parse(parser_.get(), text_.data(), static_cast<int>(text_.size()), 1);
    if (status == XML_STATUS_ERROR)
      throw ProgramError(fmt::format("{}:{}: expected {}: {}", file_, line(), kind_,
                                     XML_ErrorString(XML_GetErrorCode(parser_.get()))));
  }

 protected:
  virtual ~XmlElements() = default;

  /// `attributes` are names and values in turn, and a null pointer behind them.
  virtual void begin(std::string_view name, const char** attributes) = 0;
  virtual void end(std::string_view name) = 0;

  /// The text since the last beginning of an element, as a field of a table.
  std::string content() const { return plain(content_); }
  std::size_t line() const { return XML_GetCurrentLineNumber(parser_.get()); }
  const std::string& file() const { return file_; }
  /// Returns an attribute as a field of a table; empty if there is none.
  static std::string attribute(const char** attributes, std::string_view name) {
    for (; *attributes != nullptr; attributes += 2)
      if (attributes[0] == name) return plain(attributes[1]);
    return {};
  }

 private:
  struct Free {
    void operator()(XML_Parser parser) const { XML_ParserFree(parser); }
  };

  static std::string_view local_name(std::string_view name) { return name.substr(name.rfind(':') + 1); }
  /// Returns the text on one line, without the blanks around it.
  static std::string plain(std::string_view content) {
    return std::string(trimmed(without_controls(std::string(content))));
  }

  std::string_view text_;
  const std::string& file_;
  std::string_view kind_;
  std::unique_ptr<std::remove_pointer_t<XML_Parser>, Free> parser_;
  std::string content_;
};

/// The points of tracks (trk).
class GpxReader final : XmlElements {
 public:
  using XmlElements::XmlElements;

  RowTable read() {
    read_all();
    if (!has_times_)
      throw ProgramError(
          fmt::format("{}: expected tracks (trk) whose points have times, as receivers log them, but {}",
                      file(), table_.size() == 0 ? "it has no tracks" : "none has a time"));
    table_.use_heights_of_all(file());
    return std::move(table_);
  }

 private:
  enum Column : std::size_t { of_time = 1, of_height = 4 };

  void begin(std::string_view name, const char** attributes) override {
    if (name == "trk") {
      ++tracks_;
      name_ = fmt::format("track {}", tracks_);
      is_in_track_ = true;
    } else if (name == "trkpt" && is_in_track_) {
      is_in_point_ = true;
      table_.add_row(line(), name_, "", attribute(attributes, "lon"), attribute(attributes, "lat"));
    }
  }
  void end(std::string_view name) override {
    if (name == "trk") is_in_track_ = false;
    if (name == "trkpt") is_in_point_ = false;
    if (is_in_point_ && name == "ele") table_.set(of_height, content());
    if (is_in_point_ && name == "time") {
      table_.set(of_time, content());
      has_times_ = has_times_ || !content().empty();
    }
    if (is_in_track_ && !is_in_point_ && name == "name") name_ = labels_.label(content());
  }

  RowTable table_{"GPX", {"id", "time", "lon", "lat", "ele"}};
  std::string name_;
  TrackLabels labels_;
  std::size_t tracks_ = 0;
  bool is_in_track_ = false, is_in_point_ = false, has_times_ = false;
};

/// Vehicles and persons at each time step. Vehicles have their id; those of persons and containers are other
/// names, so that they begin with the kind. Sizes are attributes of them, or of their type where the file has
/// it.
class FcdReader final : XmlElements {
 public:
  FcdReader(const RecordingText& recording, std::string_view kind) : XmlElements(recording, kind) {
    table_.place_on_body = TableColumns::Place::front;
    // The heights have to be the last column.
    if (recording.text.find(" length=") != recording.text.npos)
      for (const char* const name : sizes) table_.column_of(fmt::format("vehicle_{}", name));
    height_ = table_.column_of("z");
  }

  RowTable read() {
    read_all();
    table_.use_heights_of_all(file());
    return std::move(table_);
  }

 private:
  void begin(std::string_view name, const char** attributes) override {
    if (name == "timestep") time_ = attribute(attributes, "time");
    const auto value = [&](std::string_view of) { return attribute(attributes, of); };
    if (name == "vType")
      for (const char* const size : sizes) types_[value("id") + '/' + size] = value(size);
    if (name != "vehicle" && name != "person" && name != "container") return;
    const std::string kind = name == "vehicle" ? "" : std::string(name) + ' ';
    table_.add_row(line(), kind + value("id"), time_, value("x"), value("y"), value("speed"), value("angle"));
    for (std::size_t k = 0; first_size + k < height_; ++k) {
      const std::string own = value(sizes[k]);
      table_.set(first_size + k, own.empty() ? types_[value("type") + '/' + sizes[k]] : own);
    }
    table_.set(height_, value("z"));
  }
  void end(std::string_view) override {}

  /// Metres per second, and degrees clockwise from north.
  RowTable table_{"SUMO FCD", {"vehicle_id", "time", "x", "y", "speed", "course"}};
  static constexpr const char* sizes[] = {"length", "width", "height"};
  static constexpr std::size_t first_size = 6;
  std::size_t height_;                        ///< column
  std::map<std::string, std::string> types_;  ///< sizes, by type/name
  std::string time_;
};

/// Returns the rows. `kind` is what the file is, for messages.
template <class Reader>
RowTable read_xml(const RecordingText& recording, std::string_view kind) {
  return Reader(recording, kind).read();
}

#else

class GpxReader;
class FcdReader;

template <class>
RowTable read_xml(const RecordingText& recording, std::string_view kind) {
  throw ProgramError(fmt::format("{}: {} needs expat, and this program was built without it (libexpat1-dev)",
                                 recording.file, kind));
}

#endif

}  // namespace

RowTable read_gpx(const RecordingText& recording) { return read_xml<GpxReader>(recording, "GPX"); }
RowTable read_fcd(const RecordingText& recording) {
  return read_xml<FcdReader>(recording, "FCD output of SUMO");
}

}  // namespace kinesphere::program
