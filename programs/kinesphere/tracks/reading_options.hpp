// The options that say how recordings are read.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "tracks/reading_policy.hpp"

namespace kinesphere::program {

/// `files` and `options` must live until the command line has been parsed. Returns the option of the files,
/// of which one must be given unless the caller says otherwise.
CLI::Option* add_reading_options(CLI::App& command, std::vector<std::string>& files, TrackOptions& options);
/// `options` must live until the command line has been parsed.
void add_interpolation_option(CLI::App& command, TrackOptions& options);
/// The name of an option of these that was given, of the files apart; empty when there was none. To be called
/// when the command line has been parsed.
std::string given_reading_option(const CLI::App& command);

}  // namespace kinesphere::program
