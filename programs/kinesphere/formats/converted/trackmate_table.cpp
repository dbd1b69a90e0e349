// Tracks of TrackMate in XML, as it exports them: particles with detections.
#include <fmt/format.h>

#include <optional>

#include "base/number_text.hpp"
#include "formats/converted/converted_table.hpp"
#include "formats/fields/units.hpp"
#include "formats/fields/xml_elements.hpp"

namespace kinesphere::program {
namespace {

#ifdef KINESPHERE_WITH_EXPAT

/// The id of a particle is its number, from 1.
class TrackMateReader final : XmlElements {
 public:
  TrackMateReader(std::string_view text, const std::string& file)
      : XmlElements(text, file, "tracks of TrackMate") {}

  ConvertedTable read() {
    read_all();
    const std::string unit = is_unit(space_unit_) ? "_" + space_unit_ : "";
    ConvertedTable table =
        table_of_places("TrackMate tracks", file(), fmt::format("id,frame,x{0},y{0}", unit), "z" + unit,
                        spots_, [](const Spot& spot) {
                          return fmt::format("{},{},{},{}", spot.particle, spot.frame, spot.x, spot.y);
                        });
    if (frame_interval_ && *frame_interval_ > 0.0) {
      table.text.insert(0, fmt::format("# framerate: {} fps\n", 1.0 / *frame_interval_));
      table.lines_before = 1;
    }
    return table;
  }

 private:
  struct Spot {
    std::size_t particle = 0;
    std::string frame, x, y, height;
    std::size_t line = 0;
  };

  void begin(std::string_view name, const char** attributes) override {
    if (name == "Tracks") {
      space_unit_ = attribute(attributes, "spaceUnits");
      const auto unit = time_unit_named(attribute(attributes, "timeUnits"));
      const auto interval = parse_number(attribute(attributes, "frameInterval"));
      if (unit && interval) frame_interval_ = *interval * unit->seconds / unit->rate;
    }
    if (name == "particle") ++particles_;
    if (name != "detection") return;
    spots_.push_back({.particle = particles_,
                      .frame = attribute(attributes, "t"),
                      .x = attribute(attributes, "x"),
                      .y = attribute(attributes, "y"),
                      .height = attribute(attributes, "z"),
                      .line = line()});
  }
  void end(std::string_view) override {}

  std::vector<Spot> spots_;
  std::size_t particles_ = 0;
  std::string space_unit_;
  std::optional<double> frame_interval_;  ///< in seconds
};

#endif

}  // namespace

std::optional<ConvertedTable> convert_trackmate(std::string_view text, const std::string& file) {
  if (!is_xml_with(text, "<Tracks ")) return std::nullopt;
#ifdef KINESPHERE_WITH_EXPAT
  return TrackMateReader(text, file).read();
#else
  throw without_expat(file, "XML");
#endif
}

}  // namespace kinesphere::program
