// The results of a watch, as text and as JSON; its state, and metrics.
#pragma once

#include <string>

#include "watch/watcher.hpp"

namespace kinesphere::program {

/// Returns the summary at the end, as text.
std::string watch_summary_text(const Watcher& watcher, std::string_view format, double real_seconds);
/// Returns the reports that were not taken, by reason, on one line: "3 of unknown accuracy, 7 malformed".
std::string reasons_text(const Watcher& watcher);
std::string watch_summary_json(const Watcher& watcher, std::string_view format, double real_seconds);
/// Returns settings, counts, tracks, pairs that are not certainly apart, and report requests.
std::string watch_state_json(const Watcher& watcher);
/// Returns the counts in Prometheus' text format.
std::string watch_metrics(const Watcher& watcher);

}  // namespace kinesphere::program
