// Writes a track set of real motion as JSON for the viewer's page.
#pragma once

#include <cstddef>
#include <string>

#include "tracks/track_set.hpp"

namespace kinesphere::program {

/// Bytes: the longest string of V8, Chromium's engine, which parses JSON from a string.
constexpr std::size_t longest_track_table = (std::size_t{1} << 29) - 24;

/// Returns {"name": ..., "plane": true, "unit": "m", "tracks": [{"id": "12", "times": [...], "positions":
/// [...]}, ...]}. Tracks are in the order of the track set, which may have an id several times; positions are
/// x, y, z of one sample after the other. `plane`: z is 0 everywhere. `unit` is null if it is unknown. Times
/// are seconds and positions lengths from the track set's origins, which may differ from its first time; for
/// files near zero both equal the file's. Each number reads back as the same double. Throws ProgramError
/// naming the id of a curve that overflows, or `name` if the text would be longer than `limit`.
std::string track_table(const TrackSet& track_set, const std::string& name,
                        std::size_t limit = longest_track_table);

}  // namespace kinesphere::program
