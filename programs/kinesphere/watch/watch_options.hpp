// From the command line to what a watch goes by.
#pragma once

#include "watch.hpp"
#include "watch/watch_settings.hpp"

namespace kinesphere::program {

/// With what the format takes for granted, where the options leave it open. Throws ProgramError.
WatchSettings settings_of(const WatchOptions& options, StreamFormat format, const std::string& source);

}  // namespace kinesphere::program
