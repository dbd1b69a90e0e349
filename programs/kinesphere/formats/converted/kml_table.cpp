// KML: tracks with times (gx:Track).
#include <fmt/format.h>

#include <utility>
#include <vector>

#include "base/number_text.hpp"
#include "base/program_error.hpp"
#include "formats/converted/converted_table.hpp"
#include "formats/converted/track_labels.hpp"
#include "formats/fields/line_text.hpp"
#include "formats/fields/xml_elements.hpp"

namespace kinesphere::program {
namespace {

#ifdef KINESPHERE_WITH_EXPAT

class KmlReader final : XmlElements {
 public:
  KmlReader(std::string_view text, const std::string& file) : XmlElements(text, file, "KML") {}

  ConvertedTable read() {
    read_all();
    if (places_.empty())
      throw ProgramError(fmt::format(
          "{}: expected tracks with times (gx:Track), but there are none: other lines of KML have "
          "no times",
          file()));
    ConvertedTable table =
        table_of_places("KML", file(), "id,time,lon,lat", "alt", places_, [](const Place& place) {
          return fmt::format("{},{},{},{}", place.track, place.time, place.longitude, place.latitude);
        });
    if (has_other_heights_)
      table.warnings.push_back(fmt::format(
          "{}: heights whose altitudeMode is not absolute are not above the sea, and are not used", file()));
    return table;
  }

 private:
  struct Place {
    std::string track, time, longitude, latitude, height;
    std::size_t line = 0;
  };

  void begin(std::string_view name, const char**) override {
    if (name == "Placemark") {
      name_ = fmt::format("track {}", ++placemarks_);
      has_label_ = false;
    }
    if (name != "Track") return;
    // All tracks of a placemark are one body.
    if (!std::exchange(has_label_, true)) name_ = labels_.label(name_);
    is_in_track_ = true;
    has_heights_ = false;
    times_.clear();
    places_before_ = places_.size();
  }
  void end(std::string_view name) override {
    if (name == "name" && !is_in_track_) name_ = content();
    if (!is_in_track_) return;
    // Others are above ground, or have none.
    if (name == "altitudeMode") has_heights_ = content() == "absolute";
    if (name == "when") times_.push_back(content());
    if (name == "coord") add_place(words_of(content()));
    if (name == "Track") end_track();
  }

  void add_place(const std::vector<std::string_view>& words) {
    const auto word = [&](std::size_t place) {
      return std::string(place < words.size() ? words[place] : "");
    };
    has_other_heights_ = has_other_heights_ || (!has_heights_ && parse_number(word(2)).value_or(0.0) != 0.0);
    places_.push_back({.track = name_,
                       .time = {},
                       .longitude = word(0),
                       .latitude = word(1),
                       .height = has_heights_ ? word(2) : "",
                       .line = line()});
  }
  void end_track() {
    is_in_track_ = false;
    const std::size_t places = places_.size() - places_before_;
    if (times_.size() != places)
      return fail(fmt::format("expected as many times as places of track '{}', but got {} and {}", name_,
                              times_.size(), places));
    for (std::size_t k = 0; k < places; ++k) places_[places_before_ + k].time = times_[k];
  }

  std::vector<Place> places_;
  std::vector<std::string> times_;  ///< of the track
  std::string name_;                ///< of the placemark
  TrackLabels labels_;
  std::size_t placemarks_ = 0, places_before_ = 0;
  bool is_in_track_ = false, has_heights_ = false, has_other_heights_ = false, has_label_ = false;
};

#endif

}  // namespace

std::optional<ConvertedTable> convert_kml(std::string_view text, const std::string& file) {
  if (!is_xml_with(text, "<kml")) return std::nullopt;
#ifdef KINESPHERE_WITH_EXPAT
  return KmlReader(text, file).read();
#else
  throw without_expat(file, "KML");
#endif
}

}  // namespace kinesphere::program
