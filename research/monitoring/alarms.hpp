// Alarms of a monitor and of another tool, their comparison with the truth, and the number of reports that
// keep every pair of a recording decided.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "kinesphere/monitor/monitor.hpp"
#include "research/monitoring/recorded_sky.hpp"

namespace kinesphere {

/// A change of the reported verdict of a pair. Changes of a pair are sorted by time; before the first one the
/// pair counts as apart.
struct VerdictChange {
  double time = 0.0;
  Verdict verdict = Verdict::apart;
};
using VerdictHistory = std::map<TrackPair, std::vector<VerdictChange>>;

/// Hands the deliveries to a monitor with one separation, lets each track leave at its end, and returns the
/// verdicts that the monitor reports.
VerdictHistory watch(Monitor& monitor, const RecordedSky& sky, const std::vector<Delivery>& deliveries);

/// How often verdicts about `distance` were right, as sums of time over pairs.
struct Correctness {
  double pair_time = 0.0;       ///< the two tracks of a pair were there
  double within_time = 0.0;     ///< part of pair_time in which a pair was truly within the distance
  double undecided_time = 0.0;  ///< part of pair_time in which a pair was undecided
  double wrong_time = 0.0;      ///< part of pair_time with a verdict that was certain and wrong
};
/// Compares verdicts with the truth. `clearly` has the true spans within the distance less a rounding,
/// `loosely` those within the distance and the tolerance.
Correctness correctness_of(const VerdictHistory& history, const RecordedSky& sky,
                           const std::map<TrackPair, std::vector<Span>>& clearly,
                           const std::map<TrackPair, std::vector<Span>>& loosely);

/// Spans of time with a warning, by pair.
using Alarms = std::map<TrackPair, std::vector<Span>>;
/// Returns the spans in which a pair was not certainly apart.
Alarms alarms_of(const VerdictHistory& history, const RecordedSky& sky);
/// Returns the alarms of a tool that extrapolates each track in a straight line from its latest report: at
/// each multiple of `step` it warns of all pairs with a closest approach nearer than the distance, within the
/// time `look_ahead`.
Alarms straight_on_alarms(const RecordedSky& sky, const std::vector<Delivery>& deliveries, double distance,
                          double look_ahead, double step);

/// Comparison of alarms with the true approaches.
struct AlarmScore {
  std::size_t approaches = 0;    ///< true approaches
  std::size_t missed = 0;        ///< approaches without a warning before their end
  std::size_t late = 0;          ///< other approaches without a warning before their begin
  std::size_t alarms = 0;        ///< warnings; those at most `look_ahead` apart count as one
  std::size_t false_alarms = 0;  ///< alarms without an approach in them, or within `look_ahead` after them
};
/// Compares alarms with the true spans in which pairs are within the distance.
AlarmScore score_of(const Alarms& alarms, const std::map<TrackPair, std::vector<Span>>& truth,
                    double look_ahead);

struct PollingSettings {
  double distance = 1.0;
  double tolerance = 0.5;
  double window = 1.0;
};

struct Polling {
  std::uint64_t reports = 0;    ///< includes the first report of each track
  double undecided_time = 0.0;  ///< sum over pairs
};

/// Polls the tracks that a monitor asks for.
Polling poll_when_needed(const RecordedSky& sky, const PollingSettings& settings);
/// Polls all tracks at the multiples of `interval`.
Polling poll_everybody(const RecordedSky& sky, const PollingSettings& settings, double interval);
/// Returns a lower bound on the reports of any method that relies on the same classes of tracks. Each track
/// is polled only when its own bound leaves a pair undecided, with the true places of all others known. Times
/// are multiples of `step`, so a poll may be late by up to `step`. Cost: some seconds for a thousand tracks.
std::uint64_t polling_floor(const RecordedSky& sky, const PollingSettings& settings, double step);

}  // namespace kinesphere
