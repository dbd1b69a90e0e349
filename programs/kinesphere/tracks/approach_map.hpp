// Approaches as features of a map: GeoJSON (RFC 7946), GPX 1.1, KML 2.2 (OGC 07-147r2).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/table_file.hpp"
#include "simulation/tracks/approaches.hpp"
#include "tracks/track_set.hpp"

namespace kinesphere::program {

enum class MapFormat { geojson, gpx, kml };
/// Returns the format by the ending of a file's name; nothing for other endings.
std::optional<MapFormat> map_format_of(const std::string& path);

/// What a feature tells of an approach besides its two places, by name.
using MapProperties = std::vector<std::pair<std::string, Cell>>;

std::string_view map_begin(MapFormat format);
std::string_view map_end(MapFormat format);
/// Returns the text of one approach: the two places where the bodies were closest, and the properties.
/// Precondition: the track set's positions are on the earth. Times are those of GPX and KML where the file
/// has dates with a zone; all times are in the properties.
std::string map_feature(MapFormat format, const Approach& approach, const MapProperties& properties,
                        const TrackSet& track_set, bool is_first);

}  // namespace kinesphere::program
