// State vectors of the OpenSky Network: {"time": ..., "states": [[...], ...]}.
#include <fmt/format.h>

#include <array>
#include <utility>

#include "formats/fields/json_reading.hpp"
#include "formats/streams/report_format.hpp"

namespace kinesphere::program {
namespace {

/// Places in a state vector, as the documentation of OpenSky's REST API numbers them.
namespace state_vector {
constexpr std::size_t icao24 = 0, callsign = 1, time_position = 3, longitude = 5, latitude = 6,
                      baro_altitude = 7, on_ground = 8, velocity = 9, true_track = 10, vertical_rate = 11,
                      geo_altitude = 13, position_source = 16, category = 17, count = 18;
}

class OpenskyFormat final : public ReportFormat {
 public:
  explicit OpenskyFormat(FormatChoices choices) : choices_(std::move(choices)) {}

  void read(const Record& record, ReportSink& sink) override try {
    if (!record.is_whole) throw MalformedRecord("expected a whole JSON document, but it is cut off");
    ondemand::document document = reader_.open(record.text);
    ondemand::object all = document.get_object();
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
      read_state(vector, arrival, record.line, sink);
    }
  } catch (const simdjson::simdjson_error& error) {
    throw MalformedRecord(std::string("expected JSON: ") + error.what());
  }

 private:
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
  JsonDocumentReader reader_;
};

}  // namespace

std::unique_ptr<ReportFormat> make_opensky_format(const FormatChoices& choices) {
  return std::make_unique<OpenskyFormat>(choices);
}

}  // namespace kinesphere::program
