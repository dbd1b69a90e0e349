// JSON lines with the library's own names: one TrackReport in each line.
#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "formats/fields/json_reading.hpp"
#include "formats/streams/report_format.hpp"

namespace kinesphere::program {
namespace {

/// One number, or two: horizontal and vertical.
struct ErrorPair {
  std::optional<double> flat, upright;
};

class JsonLinesFormat final : public ReportFormat {
 public:
  void read(const Record& record, ReportSink& sink) override try {
    if (!record.is_whole) throw MalformedRecord("expected a whole line, but it is too long or cut off");
    if (record.text.find_first_not_of(" \t\r") == std::string_view::npos) return;
    ondemand::document document = reader_.open(record.text);
    fields_ = {};
    for (auto field : document.get_object()) {
      const std::string_view key = field.unescaped_key();
      read_field(key, field.value());
    }
    require_end(document, "one JSON object in a line");
    hand_over(sink);
  } catch (const simdjson::simdjson_error& error) {
    throw MalformedRecord(std::string("expected a JSON object: ") + error.what());
  }

 private:
  struct Fields {
    std::string id, name;
    std::optional<TimeField> stamp, arrival;
    std::optional<double> lat, lon, alt, stamp_error;
    std::optional<Vec3> position, velocity;
    bool has_z = false, has_vz = false;
    ErrorPair position_error, velocity_error;
  };

  template <class Value>
  using Named = std::pair<std::string_view, std::optional<Value> Fields::*>;
  static constexpr Named<double> numbers[] = {{"lat", &Fields::lat},
                                              {"lon", &Fields::lon},
                                              {"alt", &Fields::alt},
                                              {"stamp_error", &Fields::stamp_error}};
  static constexpr Named<TimeField> times[] = {{"stamp", &Fields::stamp}, {"arrival", &Fields::arrival}};

  [[noreturn]] static void fail(std::string_view field, std::string_view what) {
    throw MalformedRecord(fmt::format("expected {} as \"{}\"", what, field));
  }

  void read_field(std::string_view key, ondemand::value value) {
    for (const auto& [name, place] : numbers)
      if (key == name) return void(fields_.*place = number_of(value, key));
    for (const auto& [name, place] : times)
      if (key == name) return void(fields_.*place = time_in(value, key));
    if (key == "id") {
      const ondemand::json_type type = value.type();
      if (type != ondemand::json_type::string && type != ondemand::json_type::number)
        fail("id", "a text or a number");
      fields_.id = text_of(value);
    } else if (key == "name") {
      const char* wrong = nullptr;
      fields_.name = text_in(value, "name", wrong).value_or("");
      if (wrong != nullptr) fail("name", "a text");
    } else if (key == "position") {
      fields_.position = vector_in(value, key, fields_.has_z);
    } else if (key == "velocity") {
      fields_.velocity = vector_in(value, key, fields_.has_vz);
    } else if (key == "position_error") {
      fields_.position_error = error_in(value, key);
    } else if (key == "velocity_error") {
      fields_.velocity_error = error_in(value, key);
    } else {
      throw MalformedRecord(
          fmt::format("expected id, name, stamp, arrival, position, velocity, position_error, "
                      "velocity_error, stamp_error, lat, lon or alt, but got \"{}\" (--format json takes any "
                      "names, as columns of a table)",
                      key.substr(0, 40)));
    }
  }

  static std::optional<double> number_of(ondemand::value value, std::string_view key) {
    const char* wrong = nullptr;
    const auto number = number_in(value, "", wrong);
    if (wrong != nullptr) fail(key, "a number");
    return number;
  }

  /// Returns a text, or a number as it is written. Precondition: no list or object.
  static std::string_view text_of(ondemand::value& value) {
    return value.type() == ondemand::json_type::string ? std::string_view(value.get_string())
                                                       : token_of(value);
  }

  static TimeField time_in(ondemand::value value, std::string_view key) {
    const ondemand::json_type type = value.type();
    const bool may_be = type == ondemand::json_type::string || type == ondemand::json_type::number;
    const auto time = may_be ? time_field(text_of(value)) : std::nullopt;
    if (!time) fail(key, "a time");
    return *time;
  }

  /// Returns a vector of two or three numbers.
  static std::optional<Vec3> vector_in(ondemand::value value, std::string_view key, bool& has_third) {
    if (value.is_null()) return std::nullopt;
    Vec3 vector{};
    std::size_t count = 0;
    ondemand::array array;
    if (value.get_array().get(array)) fail(key, "[x, y] or [x, y, z]");
    for (ondemand::value element : array) {
      const auto number = number_of(element, key);
      if (!number || count == 3) fail(key, "[x, y] or [x, y, z]");
      (count == 0 ? vector.x : count == 1 ? vector.y : vector.z) = *number;
      ++count;
    }
    if (count < 2) fail(key, "[x, y] or [x, y, z]");
    has_third = count == 3;
    return vector;
  }

  static ErrorPair error_in(ondemand::value value, std::string_view key) {
    ErrorPair pair;
    const auto take = [&](ondemand::value each, std::optional<double>& into) {
      into = number_of(each, key);
      if (into && *into < 0.0) fail(key, "a number >= 0");
    };
    if (value.type() != ondemand::json_type::array) {
      take(value, pair.flat);
      return pair;
    }
    std::size_t count = 0;
    for (ondemand::value element : value.get_array()) {
      if (count == 2) fail(key, "a number or [horizontal, vertical]");
      take(element, count == 0 ? pair.flat : pair.upright);
      ++count;
    }
    if (count != 2) fail(key, "a number or [horizontal, vertical]");
    return pair;
  }

  void hand_over(ReportSink& sink) const {
    if (fields_.id.empty()) fail("id", "a text or a number");
    if (!fields_.stamp) fail("stamp", "a time");
    SourceReport report{.id = fields_.id,
                        .name = fields_.name,
                        .stamp = fields_.stamp->time,
                        .time_kind = fields_.stamp->kind};
    if (fields_.arrival) report.arrival = fields_.arrival->time;
    report.geographic = fields_.lat && fields_.lon;
    if (report.geographic == fields_.position.has_value()) {
      if (report.geographic)
        throw MalformedRecord(R"(expected either "position" or "lat" and "lon", but got both)");
      return sink.pass_over(Passed::no_position);
    }
    if (report.geographic) {
      if (!is_place(*fields_.lon, *fields_.lat))
        throw MalformedRecord(fmt::format("expected a latitude and a longitude, but got {} and {}",
                                          *fields_.lat, *fields_.lon));
      report.position = {*fields_.lon, *fields_.lat, fields_.alt.value_or(0.0)};
      report.has_height = fields_.alt.has_value();
    } else {
      report.position = *fields_.position;
      report.has_height = fields_.has_z;
    }
    report.velocity = fields_.velocity;
    if (report.velocity) report.ground_speed = std::hypot(report.velocity->x, report.velocity->y);
    report.has_climb = fields_.velocity && fields_.has_vz;
    constexpr std::string_view said = "said by the stream";
    const auto declare = [&](const std::optional<double>& error, std::optional<DeclaredError>& into) {
      if (error) into = {*error, said};
    };
    declare(fields_.position_error.flat, report.position_error);
    declare(fields_.position_error.upright, report.height_error);
    declare(fields_.velocity_error.flat, report.velocity_error);
    declare(fields_.velocity_error.upright, report.climb_error);
    report.stamp_error = fields_.stamp_error;
    sink.take(report);
  }

  JsonDocumentReader reader_;
  Fields fields_;
};

}  // namespace

std::unique_ptr<ReportFormat> make_json_lines_format(const FormatChoices&) {
  return std::make_unique<JsonLinesFormat>();
}

}  // namespace kinesphere::program
