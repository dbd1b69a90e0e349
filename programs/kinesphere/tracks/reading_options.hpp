// The command-line options for reading track sets.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "formats/streams/input_options.hpp"
#include "tracks/reading_policy.hpp"

namespace kinesphere::program {

/// Adds the options. `files` and `options` must live until the command line has been parsed. Returns the
/// option of the files; at least one file is required unless the caller changes that.
CLI::Option* add_reading_options(CLI::App& command, std::vector<std::string>& files, TrackOptions& options);
/// `options` must live until the command line has been parsed.
void add_motion_options(CLI::App& command, TrackOptions& options);
/// Returns the name of a reading option that was given, other than the files; empty if there was none.
/// Precondition: the command line has been parsed.
std::string given_reading_option(const CLI::App& command);

}  // namespace kinesphere::program
