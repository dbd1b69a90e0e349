// KML: tracks with times (gx:Track).
#include <fmt/format.h>

#include <utility>
#include <vector>

#include "base/number_text.hpp"
#include "base/program_error.hpp"
#include "formats/fields/line_text.hpp"
#include "formats/recordings/recording_kinds.hpp"
#include "formats/recordings/track_labels.hpp"
#include "formats/recordings/xml_elements.hpp"

namespace kinesphere::program {
namespace {

#ifdef KINESPHERE_WITH_EXPAT

class KmlReader final : XmlElements {
 public:
  explicit KmlReader(const RecordingText& recording) : XmlElements(recording, "KML") {}

  RowTable read() {
    read_all();
    if (table_.size() == 0)
      throw ProgramError(fmt::format(
          "{}: expected tracks with times (gx:Track), but there are none: other lines of KML have "
          "no times",
          file()));
    table_.use_heights_of_all(file());
    if (has_other_heights_)
      table_.warnings.push_back(fmt::format(
          "{}: heights whose altitudeMode is not absolute are not above the sea, and are not used", file()));
    return std::move(table_);
  }

 private:
  struct Place {
    std::string longitude, latitude, height;
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
    places_.clear();
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
    places_.push_back({word(0), word(1), has_heights_ ? word(2) : "", line()});
  }
  void end_track() {
    is_in_track_ = false;
    if (times_.size() != places_.size())
      return fail(fmt::format("expected as many times as places of track '{}', but got {} and {}", name_,
                              times_.size(), places_.size()));
    for (std::size_t k = 0; k < places_.size(); ++k) {
      const Place& place = places_[k];
      table_.add_row(place.line, name_, times_[k], place.longitude, place.latitude, place.height);
    }
  }

  RowTable table_{"KML", {"id", "time", "lon", "lat", "alt"}};
  std::vector<Place> places_;       ///< of the track
  std::vector<std::string> times_;  ///< of the track
  std::string name_;                ///< of the placemark
  TrackLabels labels_;
  std::size_t placemarks_ = 0;
  bool is_in_track_ = false, has_heights_ = false, has_other_heights_ = false, has_label_ = false;
};

#endif

}  // namespace

RowTable read_kml(const RecordingText& recording) {
#ifdef KINESPHERE_WITH_EXPAT
  return KmlReader(recording).read();
#else
  throw without_expat(recording.file, "KML");
#endif
}

}  // namespace kinesphere::program
