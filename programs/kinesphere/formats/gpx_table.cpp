// GPX: the points of its tracks.
#include <fmt/format.h>

#include <algorithm>

#include "ascii_text.hpp"
#include "formats/converted_table.hpp"
#include "program_error.hpp"

#ifdef KINESPHERE_WITH_EXPAT
#include <expat.h>

#include <limits>
#include <memory>
#endif

namespace kinesphere::program {
namespace {

bool is_gpx(std::string_view text) {
  return text.substr(std::min(text.find_first_not_of(" \t\r\n"), text.size())).starts_with('<') &&
         text.substr(0, 4000).find("<gpx") != std::string_view::npos;
}

#ifdef KINESPHERE_WITH_EXPAT

class GpxReader {
 public:
  GpxReader(std::string_view text, const std::string& file)
      : text_(text), file_(file), parser_(XML_ParserCreate(nullptr)) {
    XML_SetUserData(parser_.get(), this);
    XML_SetElementHandler(
        parser_.get(),
        [](void* self, const char* name, const char** attributes) {
          static_cast<GpxReader*>(self)->begin(name, attributes);
        },
        [](void* self, const char* name) { static_cast<GpxReader*>(self)->end(name); });
    XML_SetCharacterDataHandler(parser_.get(), [](void* self, const char* text_part, int size) {
      static_cast<GpxReader*>(self)->content_.append(text_part, static_cast<std::size_t>(size));
    });
    // Entities of its own could make a small file huge.
    XML_SetEntityDeclHandler(parser_.get(), [](void* self, const char*, int, const char*, int, const char*,
                                               const char*, const char*, const char*) {
      XML_StopParser(static_cast<GpxReader*>(self)->parser_.get(), XML_FALSE);
    });
  }

  ConvertedTable read() {
    if (text_.size() > std::numeric_limits<int>::max())
      throw ProgramError(fmt::format("{}: expected GPX of less than 2 GiB", file_));
    const auto size = static_cast<int>(text_.size());
    if (XML_Parse(parser_.get(), text_.data(), size, 1) == XML_STATUS_ERROR)
      throw ProgramError(fmt::format("{}:{}: expected GPX: {}", file_,
                                     XML_GetCurrentLineNumber(parser_.get()),
                                     XML_ErrorString(XML_GetErrorCode(parser_.get()))));
    const bool have_heights =
        std::all_of(points_.begin(), points_.end(), [](const Point& point) { return !point.height.empty(); });
    const bool has_heights =
        std::any_of(points_.begin(), points_.end(), [](const Point& point) { return !point.height.empty(); });
    ConvertedTable table{.format = "GPX",
                         .text = have_heights ? "id,time,lon,lat,ele\n" : "id,time,lon,lat\n"};
    if (has_heights && !have_heights)
      table.warnings.push_back(
          fmt::format("{}: some points have no height (ele), so that none is used", file_));
    std::size_t line = 2;
    for (const Point& point : points_) {
      for (; line < point.line; ++line) table.text += '\n';
      table.text += fmt::format("{},{},{},{}{}\n", point.track, point.time, point.longitude, point.latitude,
                                have_heights ? "," + point.height : "");
      ++line;
    }
    return table;
  }

 private:
  struct Point {
    std::string track, time, longitude, latitude, height;
    std::size_t line = 0;
  };
  struct Free {
    void operator()(XML_Parser parser) const { XML_ParserFree(parser); }
  };

  static std::string_view local_name(std::string_view name) { return name.substr(name.rfind(':') + 1); }

  void begin(std::string_view name, const char** attributes) {
    content_.clear();
    name = local_name(name);
    if (name == "trk") {
      ++tracks_;
      name_ = fmt::format("track {}", tracks_);
      is_in_track_ = true;
    } else if (name == "trkpt" && is_in_track_) {
      is_in_point_ = true;
      Point point{.track = name_, .line = XML_GetCurrentLineNumber(parser_.get())};
      for (; *attributes != nullptr; attributes += 2) {
        if (std::string_view(attributes[0]) == "lon") point.longitude = plain(attributes[1]);
        if (std::string_view(attributes[0]) == "lat") point.latitude = plain(attributes[1]);
      }
      points_.push_back(std::move(point));
    }
  }
  void end(std::string_view name) {
    name = local_name(name);
    if (name == "trk") is_in_track_ = false;
    if (name == "trkpt") is_in_point_ = false;
    if (is_in_point_ && name == "ele") points_.back().height = plain(content_);
    if (is_in_point_ && name == "time") points_.back().time = plain(content_);
    if (is_in_track_ && !is_in_point_ && name == "name") name_ = plain(content_);
  }
  /// Returns the text without what would end a field.
  static std::string plain(std::string_view content) {
    std::string text(content);
    std::replace_if(
        text.begin(), text.end(),
        [](char c) { return c == ',' || c == '"' || c == '\n' || c == '\r' || c == '\t'; }, ' ');
    return std::string(trimmed(text));
  }

  std::string_view text_;
  const std::string& file_;
  std::unique_ptr<std::remove_pointer_t<XML_Parser>, Free> parser_;
  std::vector<Point> points_;
  std::string content_, name_;
  std::size_t tracks_ = 0;
  bool is_in_track_ = false, is_in_point_ = false;
};

#endif

}  // namespace

std::optional<ConvertedTable> convert_gpx(std::string_view text, const std::string& file) {
  if (!is_gpx(text)) return std::nullopt;
#ifdef KINESPHERE_WITH_EXPAT
  return GpxReader(text, file).read();
#else
  throw ProgramError(
      fmt::format("{}: GPX needs expat, and this program was built without it (libexpat1-dev)", file));
#endif
}

}  // namespace kinesphere::program
