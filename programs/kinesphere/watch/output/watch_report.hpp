// The results of a watch, as text and as JSON; its state, and metrics.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "watch/output/warnings.hpp"
#include "watch/output/watch_view.hpp"

namespace kinesphere::program {

/// What a summary at the end says beside what the watch knows.
struct WatchEnd {
  std::string_view format;
  std::span<const Warning> warnings;
  double real_seconds = 0.0;
};
/// Return the summary at the end, as text and as JSON.
std::string watch_summary_text(const WatchView& watch, const WatchEnd& end);
std::string watch_summary_json(const WatchView& watch, const WatchEnd& end);
/// Returns the reports that were not taken, by reason, on one line: "3 of unknown accuracy, 7 malformed".
std::string reasons_text(const WatchView& watch);
/// Returns settings, counts, tracks, pairs that are not certainly apart, and report requests.
std::string watch_state_json(const WatchView& watch);
/// Returns the counts in Prometheus' text format.
std::string watch_metrics(const WatchView& watch);

}  // namespace kinesphere::program
