// Satellites from a table of their states.
#pragma once

#include <string>
#include <vector>

#include "kinesphere/body.hpp"

namespace kinesphere::program {

/// Reads columns x, y, z (km) and vx, vy, vz (km/s) at one time, one line for each satellite. Other columns
/// are skipped. The file may be gzipped. Throws ProgramError with file and line.
std::vector<State> read_satellites(const std::string& path);

}  // namespace kinesphere::program
