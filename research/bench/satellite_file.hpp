// Satellites from a table of their states.
#pragma once

#include <string>
#include <vector>

#include "kinesphere/body.hpp"

namespace kinesphere::program {

/// Columns x, y, z (km) and vx, vy, vz (km/s) at one time, one line for each satellite; others are passed
/// over. The file may be gzipped. Throws ProgramError naming file and line.
std::vector<State> read_satellites(const std::string& path);

}  // namespace kinesphere::program
