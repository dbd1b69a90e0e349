// From the command line to what a watch goes by.
#pragma once

#include "watch.hpp"
#include "watch/watch_settings.hpp"
#include "watch/watch_snapshot.hpp"

namespace kinesphere::program {

/// With what the format takes for granted, where the options leave it open. Throws ProgramError.
WatchSettings settings_of(const WatchOptions& options, StreamFormat format, const std::string& source);
/// Those that decide what is certain, as they were given.
GivenOptions given_options(const WatchOptions& options);
/// Between two snapshots: seconds. Throws ProgramError.
double snapshot_interval(const WatchOptions& options);

}  // namespace kinesphere::program
