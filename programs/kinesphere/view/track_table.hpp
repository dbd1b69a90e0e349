// Writes a recording of real motion as JSON for the viewer's page.
#pragma once

#include <cstddef>
#include <string>

#include "tracks/recording.hpp"

namespace kinesphere::program {

/// Bytes: the longest string of V8, Chromium's engine, which parses JSON from a string.
constexpr std::size_t longest_track_table = (std::size_t{1} << 29) - 24;

/// {"name": ..., "plane": true, "unit": "m", "tracks": [{"id": "12", "times": [...], "positions": [...]},
/// ...]}, with tracks in the order of the recording, which may have an id several times; positions are x, y,
/// z of one sample after the other. `plane`: z is 0 everywhere. `unit` is null where nobody has said it.
/// Times are seconds and positions lengths from the recording's origins, which need not be its first time:
/// both are as in the file where that lies near zero. Each number reads back as the same double. Throws
/// ProgramError naming the id whose curve overflows, or `name` when the text would be longer than `limit`.
std::string track_table(const Recording& recording, const std::string& name,
                        std::size_t limit = longest_track_table);

}  // namespace kinesphere::program
