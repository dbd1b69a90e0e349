// Approaches as features of a map.
#include "tracks/approach_map.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/escaped_text.hpp"

namespace kinesphere::program {
namespace {

nlohmann::ordered_json json_value(const Cell& cell) {
  return std::visit(
      [](const auto& value) -> nlohmann::ordered_json {
        using Value = std::decay_t<decltype(value)>;
        if constexpr (std::is_same_v<Value, std::monostate>) {
          return nullptr;
        } else if constexpr (std::is_same_v<Value, DecimalText>) {
          return nlohmann::ordered_json::parse(value.digits);
        } else {
          return value;
        }
      },
      cell);
}

std::string plain_value(const Cell& cell) {
  const nlohmann::ordered_json value = json_value(cell);
  return value.is_string() ? value.get<std::string>() : value.dump();
}

/// Returns longitude, latitude and height.
Vec3 geographic_place(const TrackSet& track_set, const Vec3& local) {
  return track_set.coordinates.geographic(local).value();
}

/// Returns a point in the order of RFC 7946.
nlohmann::ordered_json geojson_point(const TrackSet& track_set, const Vec3& local) {
  const Vec3 place = geographic_place(track_set, local);
  nlohmann::ordered_json point{place.x, place.y};
  if (!track_set.is_plane) point.push_back(place.z);
  return point;
}

std::string geojson_feature(const Approach& approach, const MapProperties& properties,
                            const TrackSet& track_set, bool is_first) {
  nlohmann::ordered_json feature{{"type", "Feature"},
                                 {"geometry",
                                  {{"type", "MultiPoint"},
                                   {"coordinates",
                                    {geojson_point(track_set, approach.closest.first),
                                     geojson_point(track_set, approach.closest.second)}}}},
                                 {"properties", nlohmann::ordered_json::object()}};
  for (const auto& [name, value] : properties) feature["properties"][name] = json_value(value);
  return (is_first ? "\n" : ",\n") + feature.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// Nine decimals of a degree are a tenth of a millimetre. XML's decimal numbers have no exponent.
std::string degrees_text(double degrees) { return fmt::format("{:.9f}", degrees); }

std::string gpx_point(const Approach& approach, const TrackSet& track_set, bool is_second,
                      const std::string& description) {
  const std::string& first = track_set.tracks[approach.first].id;
  const std::string& second = track_set.tracks[approach.second].id;
  const Vec3 place =
      geographic_place(track_set, is_second ? approach.closest.second : approach.closest.first);
  std::string text = fmt::format("<wpt lat=\"{}\" lon=\"{}\">", degrees_text(place.y), degrees_text(place.x));
  if (!track_set.is_plane) text += fmt::format("<ele>{:.4f}</ele>", place.z);
  if (track_set.times.kind() == TimeKind::utc)
    text += fmt::format("<time>{}</time>", track_set.times.text(approach.closest.time));
  return text + fmt::format("<name>{}</name><desc>{}</desc></wpt>\n",
                            xml_text(is_second ? second + " by " + first : first + " by " + second),
                            description);
}

std::string gpx_feature(const Approach& approach, const MapProperties& properties,
                        const TrackSet& track_set) {
  std::string description;
  for (const auto& [name, value] : properties)
    description +=
        fmt::format("{}{}: {}", description.empty() ? "" : "; ", name, xml_text(plain_value(value)));
  return gpx_point(approach, track_set, false, description) +
         gpx_point(approach, track_set, true, description);
}

std::string kml_feature(const Approach& approach, const MapProperties& properties,
                        const TrackSet& track_set) {
  std::string text = fmt::format(
      "<Placemark><name>{}</name>",
      xml_text(track_set.tracks[approach.first].id + " by " + track_set.tracks[approach.second].id));
  if (track_set.times.kind() == TimeKind::utc)
    text += fmt::format("<TimeSpan><begin>{}</begin><end>{}</end></TimeSpan>",
                        track_set.times.text(approach.begin), track_set.times.text(approach.end));
  text += "<ExtendedData>";
  for (const auto& [name, value] : properties)
    text += fmt::format("<Data name=\"{}\"><value>{}</value></Data>", name, xml_text(plain_value(value)));
  text += "</ExtendedData><MultiGeometry>";
  const auto coordinates = [&](const Vec3& local) {
    const Vec3 place = geographic_place(track_set, local);
    return fmt::format("{},{}{}", degrees_text(place.x), degrees_text(place.y),
                       track_set.is_plane ? "" : fmt::format(",{:.4f}", place.z));
  };
  const std::string first = coordinates(approach.closest.first);
  const std::string second = coordinates(approach.closest.second);
  const std::string_view mode = track_set.is_plane ? "" : "<altitudeMode>absolute</altitudeMode>";
  text += fmt::format(
      "<Point>{0}<coordinates>{1}</coordinates></Point><Point>{0}<coordinates>{2}</coordinates></Point>"
      "<LineString>{0}<coordinates>{1} {2}</coordinates></LineString>",
      mode, first, second);
  return text + "</MultiGeometry></Placemark>\n";
}

struct MapText {
  std::string_view ending, begin, end;
};

/// In the order of MapFormat.
constexpr MapText map_texts[] = {{".geojson", R"({"type": "FeatureCollection", "features": [)", "\n]}\n"},
                                 {".gpx", R"(<?xml version="1.0" encoding="UTF-8"?>
<gpx version="1.1" creator="kinesphere" xmlns="http://www.topografix.com/GPX/1/1">
)",
                                  "</gpx>\n"},
                                 {".kml", R"(<?xml version="1.0" encoding="UTF-8"?>
<kml xmlns="http://www.opengis.net/kml/2.2"><Document>
)",
                                  "</Document></kml>\n"}};

}  // namespace

std::optional<MapFormat> map_format_of(const std::string& path) {
  for (const MapFormat format : {MapFormat::geojson, MapFormat::gpx, MapFormat::kml})
    if (std::filesystem::path(path).extension() == map_texts[static_cast<std::size_t>(format)].ending)
      return format;
  return std::nullopt;
}

std::string_view map_begin(MapFormat format) { return map_texts[static_cast<std::size_t>(format)].begin; }
std::string_view map_end(MapFormat format) { return map_texts[static_cast<std::size_t>(format)].end; }

std::string map_feature(MapFormat format, const Approach& approach, const MapProperties& properties,
                        const TrackSet& track_set, bool is_first) {
  if (format == MapFormat::geojson) return geojson_feature(approach, properties, track_set, is_first);
  return format == MapFormat::gpx ? gpx_feature(approach, properties, track_set)
                                  : kml_feature(approach, properties, track_set);
}

}  // namespace kinesphere::program
