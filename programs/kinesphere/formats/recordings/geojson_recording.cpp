// GeoJSON: points with times in their properties, and lines with a list of times.
#include <array>
#include <cstddef>

#include "base/ascii_text.hpp"
#include "formats/fields/field_text.hpp"
#include "formats/fields/line_text.hpp"
#include "formats/recordings/recording_kinds.hpp"
#include "formats/tables/column_names.hpp"
#include "formats/tables/json_rows.hpp"

namespace kinesphere::program {
namespace {

class GeoJsonReader {
 public:
  /// Sets `line` to that of the feature that is being read.
  GeoJsonReader(const std::string& file, std::size_t& line) : file_(file), line_(line) {}

  RowTable read(std::string_view text) {
    // Reading on demand goes beyond the end of some damaged documents, so the whole is checked first.
    simdjson::dom::parser whole;
    if (const auto error = whole.parse(text.data(), text.size()).error())
      throw MalformedRecord(std::string("expected JSON: ") + simdjson::error_message(error));
    JsonDocumentReader reader;
    ondemand::document document = reader.open(text);
    JsonLine line(document);
    for (auto field : document.get_object()) {
      const std::string_view key = field.unescaped_key();
      if (key == "crs") check_system(field.value());
      if (key != "features") continue;
      for (ondemand::value feature : field.value().get_array()) {
        ++features_;
        line_ = line.now();
        add(feature.get_object());
      }
    }
    require_end(document, "one FeatureCollection");
    RowTable& table = rows_.table;
    if (table.names().empty())
      throw ProgramError(
          fmt::format("{}: expected points with properties such as id and time, or lines with a list of as "
                      "many times in a property coordTimes, but there are none",
                      file_));
    table.format = "GeoJSON";
    if (left_out_ > 0)
      table.warnings.push_back(fmt::format(
          "{}: {} features that are no points, and no lines with times, are left out", file_, left_out_));
    return std::move(table);
  }

 private:
  /// Refuses coordinates of another system than longitudes and latitudes, as GeoJSON of 2008 could have them.
  void check_system(ondemand::value value) const {
    ondemand::object system;
    std::string_view name;
    if (value.get_object().get(system) || system["properties"]["name"].get_string().get(name)) return;
    for (const std::string_view degrees : {"CRS84", "4326", "4979", "4258", "4269"})
      if (name.ends_with(degrees)) return;
    throw ProgramError(
        fmt::format("{}: expected longitudes and latitudes, but its coordinates are of {}: convert them with "
                    "ogr2ogr -t_srs EPSG:4326 degrees.geojson {}",
                    file_, name, shell_word(file_)));
  }

  void add(ondemand::object feature) {
    std::string kind;
    if (ondemand::object geometry; !feature["geometry"].get_object().get(geometry))
      kind = std::string_view(geometry["type"].get_string());
    feature.reset();
    if (kind == "Point") return add_point(feature);
    if (kind != "LineString" || !add_line(feature)) ++left_out_;
  }

  void add_point(ondemand::object feature) {
    rows_.table.begin_row(line_);
    if (ondemand::object properties; !feature["properties"].get_object().get(properties)) {
      for (auto field : properties) {
        const std::string name(std::string_view(field.unescaped_key()));
        const auto meaning = meaning_of(name);
        // The point itself says where it is.
        const bool is_place =
            meaning && (meaning->quantity == Quantity::longitude || meaning->quantity == Quantity::latitude);
        if (!is_place) rows_.add_value(name, field.value());
      }
    }
    feature.reset();
    set_place(numbers_of(feature["geometry"]["coordinates"].get_array()));
  }

  /// Returns false for a line without times.
  bool add_line(ondemand::object feature) {
    std::string id = fmt::format("feature {}", features_);
    std::vector<std::string> times;
    if (ondemand::object properties; !feature["properties"].get_object().get(properties))
      if (!read_properties(properties, id, times)) id = rows_.table.label(id);
    feature.reset();
    std::vector<std::vector<std::string>> places;
    for (ondemand::value place : feature["geometry"]["coordinates"].get_array())
      places.push_back(numbers_of(place.get_array()));
    if (times.empty()) return false;
    if (times.size() != places.size())
      throw MalformedRecord(fmt::format("expected as many times as places of '{}', but got {} and {}", id,
                                        times.size(), places.size()));
    for (std::size_t k = 0; k < places.size(); ++k) {
      rows_.table.begin_row(line_);
      rows_.set("id", id);
      rows_.set("time", times[k]);
      set_place(places[k]);
    }
    return true;
  }

  /// Returns true if there is an id, which may be that of several lines.
  static bool read_properties(ondemand::object properties, std::string& id, std::vector<std::string>& times) {
    bool has_id = false;
    for (auto field : properties) {
      const std::string name(std::string_view(field.unescaped_key()));
      ondemand::value value = field.value();
      const auto meaning = meaning_of(name);
      const bool is_id = meaning && meaning->quantity == Quantity::id;
      if (value.type() == ondemand::json_type::array) {
        const std::string plain = plain_name(name);
        if (plain == "coordtimes" || plain == "times" || plain == "timestamps")
          times = fields_of(value.get_array());
      } else if (value.type() == ondemand::json_type::object) {
        if (ondemand::array list; !value.get_object()["times"].get_array().get(list)) times = fields_of(list);
      } else if (is_id || (!has_id && plain_name(name) == "name")) {
        has_id = is_id;
        id = value.type() == ondemand::json_type::string ? std::string(std::string_view(value.get_string()))
                                                         : std::string(token_of(value));
      }
    }
    return has_id;
  }

  /// Returns texts and numbers as fields of a table.
  static std::vector<std::string> fields_of(ondemand::array list) {
    std::vector<std::string> fields;
    for (ondemand::value value : list)
      fields.push_back(value.type() == ondemand::json_type::string
                           ? std::string(std::string_view(value.get_string()))
                           : std::string(token_of(value)));
    return fields;
  }
  static std::vector<std::string> numbers_of(ondemand::array list) {
    std::vector<std::string> numbers;
    for (ondemand::value value : list) {
      if (value.type() != ondemand::json_type::number)
        throw MalformedRecord("expected numbers as coordinates");
      numbers.emplace_back(token_of(value));
    }
    if (numbers.size() < 2) throw MalformedRecord("expected a longitude and a latitude as coordinates");
    return numbers;
  }
  void set_place(const std::vector<std::string>& numbers) {
    rows_.set("lon", numbers[0]);
    rows_.set("lat", numbers[1]);
    if (numbers.size() > 2) rows_.set("alt", numbers[2]);
  }

  const std::string& file_;
  std::size_t& line_;
  JsonRows rows_;
  std::size_t features_ = 0, left_out_ = 0;
};

}  // namespace

bool is_geojson(std::string_view text) {
  const std::string_view begin = text.substr(0, 4096);
  return trimmed(begin).starts_with('{') && begin.find("\"FeatureCollection\"") != std::string_view::npos;
}

RowTable read_geojson(const RecordingText& recording) {
  RowTable table;
  std::size_t line = 1;
  read_json(recording.file, line, [&] { table = GeoJsonReader(recording.file, line).read(recording.text); });
  return table;
}

}  // namespace kinesphere::program
