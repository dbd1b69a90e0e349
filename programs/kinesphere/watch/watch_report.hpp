// What came of a watch, for a person and as JSON; its state, and metrics.
#pragma once

#include <string>

#include "watch/watcher.hpp"

namespace kinesphere::program {

/// For a person, at the end.
std::string watch_summary_text(const Watcher& watcher, std::string_view format, double real_seconds);
std::string watch_summary_json(const Watcher& watcher, std::string_view format, double real_seconds);
/// What the watch goes by and has counted, tracks, pairs that are not certainly apart, and whose reports are
/// needed.
std::string watch_state_json(const Watcher& watcher);
/// In Prometheus' text format.
std::string watch_metrics(const Watcher& watcher);

}  // namespace kinesphere::program
