// SUMO's FCD output in XML: vehicles and persons at each time step.
#include <fmt/format.h>

#include "formats/recordings/recording_kinds.hpp"
#include "formats/recordings/xml_elements.hpp"

namespace kinesphere::program {
namespace {

#ifdef KINESPHERE_WITH_EXPAT

/// Vehicles have their id; those of persons and containers are other names, so that they begin with the kind.
class FcdReader final : XmlElements {
 public:
  explicit FcdReader(const RecordingText& recording) : XmlElements(recording, "FCD output of SUMO") {}

  RowTable read() {
    read_all();
    table_.use_heights_of_all(file());
    return std::move(table_);
  }

 private:
  void begin(std::string_view name, const char** attributes) override {
    if (name == "timestep") time_ = attribute(attributes, "time");
    if (name != "vehicle" && name != "person" && name != "container") return;
    const std::string kind = name == "vehicle" ? "" : std::string(name) + ' ';
    const auto value = [&](std::string_view of) { return attribute(attributes, of); };
    table_.add_row(line(), kind + value("id"), time_, value("x"), value("y"), value("speed"), value("angle"),
                   value("z"));
  }
  void end(std::string_view) override {}

  /// Metres per second, and degrees clockwise from north.
  RowTable table_{"SUMO FCD", {"vehicle_id", "time", "x", "y", "speed", "course", "z"}};
  std::string time_;
};

#endif

}  // namespace

RowTable read_fcd(const RecordingText& recording) {
#ifdef KINESPHERE_WITH_EXPAT
  return FcdReader(recording).read();
#else
  throw without_expat(recording.file, "XML");
#endif
}

}  // namespace kinesphere::program
