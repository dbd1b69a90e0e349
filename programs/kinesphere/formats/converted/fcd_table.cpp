// SUMO's FCD output in XML: vehicles and persons at each time step.
#include <fmt/format.h>

#include "formats/converted/converted_table.hpp"
#include "formats/fields/xml_elements.hpp"

namespace kinesphere::program {
namespace {

#ifdef KINESPHERE_WITH_EXPAT

/// Vehicles have their id; those of persons and containers are other names, so that they begin with the kind.
class FcdReader final : XmlElements {
 public:
  FcdReader(std::string_view text, const std::string& file) : XmlElements(text, file, "FCD output of SUMO") {}

  ConvertedTable read() {
    read_all();
    return table_of_places("SUMO FCD", file(), "vehicle_id,time,x,y,speed,course", "z", places_,
                           [](const Place& place) {
                             return fmt::format("{},{},{},{},{},{}", place.id, place.time, place.x, place.y,
                                                place.speed, place.course);
                           });
  }

 private:
  struct Place {
    std::string id, time, x, y, height;
    std::string speed, course;  ///< metres per second, degrees clockwise from north
    std::size_t line = 0;
  };

  void begin(std::string_view name, const char** attributes) override {
    if (name == "timestep") time_ = attribute(attributes, "time");
    if (name != "vehicle" && name != "person" && name != "container") return;
    const std::string kind = name == "vehicle" ? "" : std::string(name) + ' ';
    places_.push_back({.id = kind + attribute(attributes, "id"),
                       .time = time_,
                       .x = attribute(attributes, "x"),
                       .y = attribute(attributes, "y"),
                       .height = attribute(attributes, "z"),
                       .speed = attribute(attributes, "speed"),
                       .course = attribute(attributes, "angle"),
                       .line = line()});
  }
  void end(std::string_view) override {}

  std::string time_;
  std::vector<Place> places_;
};

#endif

}  // namespace

std::optional<ConvertedTable> convert_fcd(std::string_view text, const std::string& file) {
  if (!is_xml_with(text, "<fcd-export")) return std::nullopt;
#ifdef KINESPHERE_WITH_EXPAT
  return FcdReader(text, file).read();
#else
  throw without_expat(file, "XML");
#endif
}

}  // namespace kinesphere::program
