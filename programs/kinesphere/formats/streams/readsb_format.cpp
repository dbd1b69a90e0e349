// aircraft.json of readsb, dump1090 and tar1090: all aircraft that a receiver of ADS-B knows at one time.
// Also in the shapes of dump1090-mutability (keys altitude, speed, vert_rate, nucp), of ADSBexchange's API v2
// (the list "ac", "now" in milliseconds), and of readsb's --net-json-port (an aircraft in each line).
#include <fmt/format.h>

#include <array>

#include "formats/fields/json_reading.hpp"
#include "formats/fields/units.hpp"
#include "formats/streams/report_format.hpp"

namespace kinesphere::program {
namespace {

constexpr double unknown_accuracy = std::numeric_limits<double>::infinity();

// Limits of 95 % of errors, in metres and metres per second, by the codes of DO-260B and ICAO Doc 9871.
constexpr std::array position_accuracies{
    unknown_accuracy, 18520.0, 7408.0, 3704.0, 1852.0, 926.0, 555.6, 185.2, 92.6, 30.0, 10.0, 3.0};
constexpr std::array velocity_accuracies{unknown_accuracy, 10.0, 3.0, 1.0, 0.3};
constexpr std::array climb_accuracies{unknown_accuracy, 50.0 * foot, 15.0 * foot, 5.0 * foot, 1.5 * foot};
constexpr std::array height_accuracies{unknown_accuracy, 150.0, 45.0};

/// Radii that contain the position, by the NUCp of DO-260.
constexpr std::array containment_radii{
    unknown_accuracy, 37040.0, 18520.0, 3704.0, 1852.0, 926.0, 370.4, 185.2, 25.0, 7.5};

template <std::size_t count>
double accuracy(const std::array<double, count>& accuracies, double category) {
  if (!(category >= 0.0 && category < static_cast<double>(count))) return unknown_accuracy;
  return accuracies[static_cast<std::size_t>(category)];
}

/// One object of the list "aircraft", in its own units.
struct AircraftEntry {
  std::optional<std::string_view> hex, flight, category, designator;
  std::optional<double> lat, lon, alt_baro, alt_geom, gs, track, baro_rate, geom_rate, seen_pos, rc, nac_p,
      nac_v, gva, sil, nuc_p;
  bool on_ground = false;
  /// True if the position is from the aircraft itself, not from radar or receivers on the ground.
  bool is_from_aircraft = true;
  const char* wrong = nullptr;

  void read(ondemand::object object) {
    for (auto field : object) {
      const std::string_view key = field.unescaped_key();
      ondemand::value value = field.value();
      if (key == "hex") {
        hex = text_in(value, "hex", wrong);
      } else if (key == "flight") {
        flight = text_if_any(value);
      } else if (key == "type") {
        const auto type = text_if_any(value);
        if (type && !type->starts_with("adsb") && !type->starts_with("adsr")) is_from_aircraft = false;
      } else if (key == "category" || key == "t") {
        (key == "t" ? designator : category) = text_if_any(value);
      } else if (key == "mlat" || key == "tisb") {
        // Names of the fields of that source.
        ondemand::array names;
        if (value.get_array().get(names)) continue;
        for (auto name : names) {
          std::string_view text;
          if (!name.get_string().get(text) && text == "lat") is_from_aircraft = false;
        }
      } else if (key == "alt_baro" || key == "altitude") {
        // The text "ground" is no height.
        if (value.type() == ondemand::json_type::number) alt_baro = double(value.get_double());
        if (value.type() == ondemand::json_type::string)
          on_ground = std::string_view(value.get_string()) == "ground";
      } else {
        for (const auto& [name, place] : numbers)
          if (key == name) {
            this->*place = number_in(value, name, wrong);
            break;
          }
      }
    }
  }

  struct Number {
    const char* name;
    std::optional<double> AircraftEntry::*place;
  };
  static const std::array<Number, 16> numbers;
};

const std::array<AircraftEntry::Number, 16> AircraftEntry::numbers{{{"lat", &AircraftEntry::lat},
                                                                    {"lon", &AircraftEntry::lon},
                                                                    {"gs", &AircraftEntry::gs},
                                                                    {"track", &AircraftEntry::track},
                                                                    {"seen_pos", &AircraftEntry::seen_pos},
                                                                    {"rc", &AircraftEntry::rc},
                                                                    {"nac_p", &AircraftEntry::nac_p},
                                                                    {"nac_v", &AircraftEntry::nac_v},
                                                                    {"baro_rate", &AircraftEntry::baro_rate},
                                                                    {"alt_geom", &AircraftEntry::alt_geom},
                                                                    {"geom_rate", &AircraftEntry::geom_rate},
                                                                    {"gva", &AircraftEntry::gva},
                                                                    {"sil", &AircraftEntry::sil},
                                                                    {"speed", &AircraftEntry::gs},
                                                                    {"vert_rate", &AircraftEntry::baro_rate},
                                                                    {"nucp", &AircraftEntry::nuc_p}}};

class ReadsbFormat final : public ReportFormat {
 public:
  explicit ReadsbFormat(const FormatChoices& choices)
      : choices_(choices),
        nac_p_(fmt::format("{} times the 95 % of nac_p", choices.containment)),
        nac_v_(fmt::format("{} times the 95 % of nac_v", choices.containment)),
        gva_(fmt::format("{} times the 95 % of gva", choices.containment)) {}

  void read(const Record& record, ReportSink& sink) override try {
    if (!record.is_whole) throw MalformedRecord("expected a whole JSON document, but it is cut off");
    ondemand::document document = reader_.open(record.text);
    ondemand::object all = document.get_object();
    double now = 0.0;
    if (all["now"].get(now) || !is_time(now)) throw MalformedRecord("expected \"now\": seconds");
    // No second of our time is this large.
    constexpr double first_in_milliseconds = 1e11;
    const FileTime arrival = time_of(now > first_in_milliseconds ? now * 1e-3 : now);
    sink.time_is(arrival, TimeKind::number);
    ondemand::array list;
    auto error = all["aircraft"].get(list);
    // After another error the document must not be read on.
    if (error == simdjson::NO_SUCH_FIELD) {
      ondemand::value others;
      error = all["ac"].get(others);
      // Where no aircraft is near.
      if (!error && others.is_null()) return;
      if (!error) error = others.get(list);
      if (error == simdjson::NO_SUCH_FIELD && hand_over_one(all, arrival, record.line, sink)) return;
    }
    if (error) throw MalformedRecord("expected \"aircraft\": a list");
    for (ondemand::value element : list) {
      ondemand::object object;
      if (element.get_object().get(object)) throw MalformedRecord("expected objects in \"aircraft\"");
      AircraftEntry entry;
      entry.read(object);
      hand_over(entry, arrival, record.line, sink);
    }
  } catch (const simdjson::simdjson_error& error) {
    throw MalformedRecord(std::string("expected JSON: ") + error.what());
  }

 private:
  /// Reads an object that is one aircraft; returns false for another one.
  bool hand_over_one(ondemand::object& object, const FileTime& arrival, std::size_t line, ReportSink& sink) {
    object.reset();
    AircraftEntry entry;
    entry.read(object);
    if (!entry.hex) return false;
    hand_over(entry, arrival, line, sink);
    return true;
  }

  void hand_over(const AircraftEntry& entry, const FileTime& arrival, std::size_t line, ReportSink& sink) {
    if (entry.wrong != nullptr || !entry.hex || entry.hex->empty())
      return sink.refuse(
          line, entry.wrong == nullptr || !entry.hex
                    ? std::string("expected \"hex\" in each aircraft")
                    : fmt::format("expected a number as \"{}\" of aircraft {}", entry.wrong, *entry.hex));
    if (!entry.lat || !entry.lon || !entry.seen_pos) return sink.pass_over(Passed::no_position);
    if (!is_place(*entry.lon, *entry.lat) || !(*entry.seen_pos >= 0.0 && *entry.seen_pos < 1e9))
      return sink.refuse(
          line,
          fmt::format(
              "expected a latitude, a longitude and seen_pos >= 0 of aircraft {}, but got {}, {} and {}",
              *entry.hex, *entry.lat, *entry.lon, *entry.seen_pos));
    SourceReport report{.id = *entry.hex, .stamp = later_by(arrival, -*entry.seen_pos), .arrival = arrival};
    report.name = entry.flight.value_or("");
    report.geographic = true;
    report.position = {*entry.lon, *entry.lat, 0.0};
    // A repeated position appears up to a tenth of a second earlier or later.
    report.same_within = 0.25;
    if (entry.is_from_aircraft)
      add_errors(entry, report);
    else if (!choices_.position_error_is_said)
      return sink.pass_over(Passed::no_bound);
    if (report.position_error && std::isinf(report.position_error->bound))
      return sink.pass_over(Passed::no_bound);
    add_height(entry, report);
    sink.take(report);
  }

  void add_errors(const AircraftEntry& entry, SourceReport& report) const {
    // Without integrity the radius of containment guarantees nothing.
    const bool has_radius = entry.rc && *entry.rc > 0.0 && entry.sil.value_or(1.0) > 0.0;
    if (has_radius &&
        (choices_.position_bound == FormatChoices::PositionBound::containment_radius || !entry.nac_p))
      report.position_error = {*entry.rc, "rc"};
    else if (entry.nac_p)
      report.position_error = {choices_.containment * accuracy(position_accuracies, *entry.nac_p), nac_p_};
    else if (entry.nuc_p)
      report.position_error = {accuracy(containment_radii, *entry.nuc_p), "the radius of nucp"};
    else if (entry.rc)
      report.position_error = {unknown_accuracy, "rc"};
    if (entry.nac_v) {
      report.velocity_error = {choices_.containment * accuracy(velocity_accuracies, *entry.nac_v), nac_v_};
      report.climb_error = {choices_.containment * accuracy(climb_accuracies, *entry.nac_v), nac_v_};
    }
  }

  void add_height(const AircraftEntry& entry, SourceReport& report) const {
    const bool barometric = choices_.altitude == FormatChoices::Altitude::barometric;
    const auto& height = barometric ? entry.alt_baro : entry.alt_geom;
    if (height) {
      report.position.z = *height * foot;
      report.has_height = true;
      if (!barometric && entry.gva && *entry.gva > 0.0)
        report.height_error = {choices_.containment * accuracy(height_accuracies, *entry.gva), gva_};
    }
    auto climb = barometric ? entry.baro_rate : entry.geom_rate;
    if (!climb) climb = barometric ? entry.geom_rate : entry.baro_rate;
    if (climb) *climb *= foot / 60.0;
    report.on_ground = entry.on_ground;
    report.category = entry.category.value_or("");
    report.craft_type = entry.designator.value_or("");
    report.said_kind = preset_of_emitter(report.category);
    report.sayable = emitter_presets;
    set_velocity(report, entry.gs ? std::optional(*entry.gs * knot) : std::nullopt, entry.track, climb);
  }

  FormatChoices choices_;
  std::string nac_p_, nac_v_, gva_;
  JsonDocumentReader reader_;
};

}  // namespace

std::unique_ptr<ReportFormat> make_readsb_format(const FormatChoices& choices) {
  return std::make_unique<ReadsbFormat>(choices);
}

}  // namespace kinesphere::program
