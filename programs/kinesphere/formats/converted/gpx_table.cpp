// GPX: the points of its tracks.
#include <fmt/format.h>

#include <algorithm>

#include "base/program_error.hpp"
#include "formats/converted/converted_table.hpp"
#include "formats/converted/track_labels.hpp"
#include "formats/fields/xml_elements.hpp"

namespace kinesphere::program {
namespace {

#ifdef KINESPHERE_WITH_EXPAT

class GpxReader final : XmlElements {
 public:
  GpxReader(std::string_view text, const std::string& file) : XmlElements(text, file, "GPX") {}

  ConvertedTable read() {
    read_all();
    const bool has_time =
        std::any_of(points_.begin(), points_.end(), [](const Point& point) { return !point.time.empty(); });
    if (!has_time)
      throw ProgramError(
          fmt::format("{}: expected tracks (trk) whose points have times, as receivers log them, but {}",
                      file(), points_.empty() ? "it has no tracks" : "none has a time"));
    return table_of_places("GPX", file(), "id,time,lon,lat", "ele", points_, [](const Point& point) {
      return fmt::format("{},{},{},{}", point.track, point.time, point.longitude, point.latitude);
    });
  }

 private:
  struct Point {
    std::string track, time, longitude, latitude, height;
    std::size_t line = 0;
  };

  void begin(std::string_view name, const char** attributes) override {
    if (name == "trk") {
      ++tracks_;
      name_ = fmt::format("track {}", tracks_);
      is_in_track_ = true;
    } else if (name == "trkpt" && is_in_track_) {
      is_in_point_ = true;
      points_.push_back({.track = name_,
                         .longitude = attribute(attributes, "lon"),
                         .latitude = attribute(attributes, "lat"),
                         .line = line()});
    }
  }
  void end(std::string_view name) override {
    if (name == "trk") is_in_track_ = false;
    if (name == "trkpt") is_in_point_ = false;
    if (is_in_point_ && name == "ele") points_.back().height = content();
    if (is_in_point_ && name == "time") points_.back().time = content();
    if (is_in_track_ && !is_in_point_ && name == "name") name_ = labels_.label(content());
  }

  std::vector<Point> points_;
  std::string name_;
  TrackLabels labels_;
  std::size_t tracks_ = 0;
  bool is_in_track_ = false, is_in_point_ = false;
};

#endif

}  // namespace

std::optional<ConvertedTable> convert_gpx(std::string_view text, const std::string& file) {
  if (!is_xml_with(text, "<gpx")) return std::nullopt;
#ifdef KINESPHERE_WITH_EXPAT
  return GpxReader(text, file).read();
#else
  throw without_expat(file, "GPX");
#endif
}

}  // namespace kinesphere::program
