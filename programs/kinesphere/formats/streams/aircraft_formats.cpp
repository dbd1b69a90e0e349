// What receivers of ADS-B and their networks tell in JSON. aircraft.json of readsb, dump1090 and tar1090: all
// aircraft that a receiver knows at one time; also in the shapes of dump1090-mutability (keys altitude,
// speed, vert_rate, nucp), of ADSBexchange's API v2 (the list "ac", "now" in milliseconds), and of readsb's
// --net-json-port (an aircraft in each line). State vectors of the OpenSky Network: {"time": ..., "states":
// [[...], ...]}.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "formats/fields/json_reading.hpp"
#include "formats/fields/units.hpp"
#include "formats/streams/report_format.hpp"

namespace kinesphere::program {
namespace {

/// Reads documents that are one object each.
class JsonObjectFormat : public ReportFormat {
 public:
  void read(const Record& record, ReportSink& sink) final try {
    if (!record.is_whole) throw MalformedRecord("expected a whole JSON document, but it is cut off");
    ondemand::document document = reader_.open(record.text);
    ondemand::object all = document.get_object();
    read_object(all, record.line, sink);
  } catch (const simdjson::simdjson_error& error) {
    throw MalformedRecord(std::string("expected JSON: ") + error.what());
  }

 protected:
  virtual void read_object(ondemand::object& all, std::size_t line, ReportSink& sink) = 0;

 private:
  JsonDocumentReader reader_;
};

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
};

/// A number of an entry, and where it is kept.
struct AircraftNumber {
  std::string_view name;
  std::optional<double> AircraftEntry::*place;
};
constexpr AircraftNumber aircraft_numbers[] = {{"lat", &AircraftEntry::lat},
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
                                               {"nucp", &AircraftEntry::nuc_p}};

AircraftEntry entry_of(ondemand::object object) {
  AircraftEntry entry;
  for (auto field : object) {
    const std::string_view key = field.unescaped_key();
    ondemand::value value = field.value();
    if (key == "hex") {
      entry.hex = text_in(value, "hex", entry.wrong);
    } else if (key == "flight") {
      entry.flight = text_if_any(value);
    } else if (key == "type") {
      const auto type = text_if_any(value);
      if (type && !type->starts_with("adsb") && !type->starts_with("adsr")) entry.is_from_aircraft = false;
    } else if (key == "category" || key == "t") {
      (key == "t" ? entry.designator : entry.category) = text_if_any(value);
    } else if (key == "mlat" || key == "tisb") {
      // Names of the fields of that source.
      ondemand::array names;
      if (value.get_array().get(names)) continue;
      for (auto name : names) {
        std::string_view text;
        if (!name.get_string().get(text) && text == "lat") entry.is_from_aircraft = false;
      }
    } else if (key == "alt_baro" || key == "altitude") {
      // The text "ground" is no height.
      if (value.type() == ondemand::json_type::number) entry.alt_baro = double(value.get_double());
      if (value.type() == ondemand::json_type::string)
        entry.on_ground = std::string_view(value.get_string()) == "ground";
    } else {
      const auto* const number = std::ranges::find(aircraft_numbers, key, &AircraftNumber::name);
      if (number != std::end(aircraft_numbers))
        entry.*number->place = number_in(value, number->name.data(), entry.wrong);
    }
  }
  return entry;
}

class ReadsbFormat final : public JsonObjectFormat {
 public:
  explicit ReadsbFormat(const FormatChoices& choices)
      : choices_(choices),
        nac_p_(fmt::format("{} times the 95 % of nac_p", choices.containment)),
        nac_v_(fmt::format("{} times the 95 % of nac_v", choices.containment)),
        gva_(fmt::format("{} times the 95 % of gva", choices.containment)) {}

 private:
  void read_object(ondemand::object& all, std::size_t line, ReportSink& sink) override {
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
      if (error == simdjson::NO_SUCH_FIELD && hand_over_one(all, arrival, line, sink)) return;
    }
    if (error) throw MalformedRecord("expected \"aircraft\": a list");
    for (ondemand::value element : list) {
      ondemand::object object;
      if (element.get_object().get(object)) throw MalformedRecord("expected objects in \"aircraft\"");
      hand_over(entry_of(object), arrival, line, sink);
    }
  }

  /// Reads an object that is one aircraft; returns false for another one.
  bool hand_over_one(ondemand::object& object, const FileTime& arrival, std::size_t line, ReportSink& sink) {
    object.reset();
    const AircraftEntry entry = entry_of(object);
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
};

/// Places in a state vector, as the documentation of OpenSky's REST API numbers them.
namespace state_vector {
constexpr std::size_t icao24 = 0, callsign = 1, time_position = 3, longitude = 5, latitude = 6,
                      baro_altitude = 7, on_ground = 8, velocity = 9, true_track = 10, vertical_rate = 11,
                      geo_altitude = 13, position_source = 16, category = 17, count = 18;
}

class OpenskyFormat final : public JsonObjectFormat {
 public:
  explicit OpenskyFormat(FormatChoices choices) : choices_(std::move(choices)) {}

 private:
  void read_object(ondemand::object& all, std::size_t line, ReportSink& sink) override {
    double now = 0.0;
    if (all["time"].get(now) || !is_time(now)) throw MalformedRecord("expected \"time\": seconds");
    const FileTime arrival = time_of(now);
    sink.time_is(arrival, TimeKind::number);
    ondemand::value states;
    if (all["states"].get(states)) throw MalformedRecord("expected \"states\": a list");
    if (states.is_null()) return;
    ondemand::array list;
    if (states.get_array().get(list)) throw MalformedRecord("expected \"states\": a list");
    for (ondemand::value element : list) {
      ondemand::array vector;
      if (element.get_array().get(vector)) throw MalformedRecord("expected lists in \"states\"");
      read_state(vector, arrival, line, sink);
    }
  }

  void read_state(ondemand::array vector, const FileTime& arrival, std::size_t line, ReportSink& sink) {
    namespace at = state_vector;
    std::optional<std::string_view> id, callsign;
    std::array<std::optional<double>, at::count> numbers;
    std::size_t place = 0;
    bool on_ground = false;
    const char* ignored = nullptr;
    for (ondemand::value value : vector) {
      if (place == at::icao24) id = text_in(value, "icao24", ignored);
      if (place == at::callsign) callsign = text_in(value, "callsign", ignored);
      if (place == at::on_ground && value.type() == ondemand::json_type::boolean)
        on_ground = value.get_bool();
      if (place > at::callsign && place < at::count) numbers[place] = number_in(value, "", ignored);
      ++place;
    }
    if (!id || id->empty() || place <= at::geo_altitude)
      return sink.refuse(line, "expected state vectors of 14 values or more, icao24 first");
    const auto& time = numbers[at::time_position];
    const auto &longitude = numbers[at::longitude], &latitude = numbers[at::latitude];
    if (!time || !longitude || !latitude) return sink.pass_over(Passed::no_position);
    if (!is_time(*time) || !is_place(*longitude, *latitude))
      return sink.refuse(
          line, fmt::format("expected a time, a longitude and a latitude of {}, but got {}, {} and {}", *id,
                            *time, *longitude, *latitude));
    // 0 is ADS-B; others are radar, and receivers on the ground.
    if (numbers[at::position_source].value_or(0.0) != 0.0 && !choices_.position_error_is_said)
      return sink.pass_over(Passed::no_bound);
    SourceReport report{.id = *id, .stamp = time_of(*time), .arrival = arrival};
    report.name = callsign.value_or("");
    report.geographic = true;
    report.position = {*longitude, *latitude, 0.0};
    const auto& height = numbers[choices_.altitude == FormatChoices::Altitude::barometric ? at::baro_altitude
                                                                                          : at::geo_altitude];
    report.has_height = height.has_value();
    report.position.z = height.value_or(0.0);
    report.on_ground = on_ground;
    report.category = emitter_of_opensky(static_cast<int>(numbers[at::category].value_or(0.0)));
    report.said_kind = preset_of_emitter(report.category);
    report.sayable = emitter_presets;
    set_velocity(report, numbers[at::velocity], numbers[at::true_track], numbers[at::vertical_rate]);
    sink.take(report);
  }

  FormatChoices choices_;
};

}  // namespace

std::unique_ptr<ReportFormat> make_readsb_format(const FormatChoices& choices) {
  return std::make_unique<ReadsbFormat>(choices);
}

std::unique_ptr<ReportFormat> make_opensky_format(const FormatChoices& choices) {
  return std::make_unique<OpenskyFormat>(choices);
}

}  // namespace kinesphere::program
