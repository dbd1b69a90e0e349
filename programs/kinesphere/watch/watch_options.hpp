// Turns the command line into the settings of a watch.
#pragma once

#include "watch/watch.hpp"
#include "watch/watch_settings.hpp"
#include "watch/watch_snapshot.hpp"

namespace kinesphere::program {

/// Returns the settings, with the defaults of the format for absent options. Throws ProgramError.
WatchSettings settings_of(const WatchOptions& options, StreamFormat format, const std::string& source);
/// Returns the given options that influence verdicts.
GivenOptions given_options(const WatchOptions& options);
/// Returns seconds between two snapshots. Throws ProgramError.
double snapshot_interval(const WatchOptions& options);

}  // namespace kinesphere::program
