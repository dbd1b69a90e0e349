// The options that say how recordings are read.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "tracks/reading_policy.hpp"

namespace kinesphere::program {

/// Both must live until the command line has been parsed.
void add_reading_options(CLI::App& command, std::vector<std::string>& files, TrackOptions& options);

}  // namespace kinesphere::program
