// When whom a monitor, or another tool, warned of, and how that compares with the truth.
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "kinesphere/monitor/monitor.hpp"
#include "research/monitoring/recorded_sky.hpp"

namespace kinesphere {

/// What was told of pairs, by time. Before the first change, and where there is none, they are apart.
struct VerdictChange {
  double time = 0.0;
  Verdict verdict = Verdict::apart;
};
using VerdictHistory = std::map<TrackPair, std::vector<VerdictChange>>;

/// Hands the deliveries to a monitor with one separation, lets each track leave at its end, and notes what
/// the monitor tells.
VerdictHistory watch(Monitor& monitor, const RecordedSky& sky, const std::vector<Delivery>& deliveries);

/// How right verdicts about `distance` were.
struct Correctness {
  double pair_time = 0.0;       ///< in which both of a pair were there
  double within_time = 0.0;     ///< of it, truly within the distance
  double undecided_time = 0.0;  ///< of it, undecided
  double wrong_time = 0.0;      ///< of it, told to be certain of what was not so
};
/// `clearly`: true spans within the distance less a rounding; `loosely`: within the distance and the
/// tolerance.
Correctness correctness_of(const VerdictHistory& history, const RecordedSky& sky,
                           const std::map<TrackPair, std::vector<Span>>& clearly,
                           const std::map<TrackPair, std::vector<Span>>& loosely);

/// Spans in which there was a warning about a pair.
using Alarms = std::map<TrackPair, std::vector<Span>>;
/// Where a pair was not certainly apart.
Alarms alarms_of(const VerdictHistory& history, const RecordedSky& sky);
/// As tools do that take everybody to go straight on from the latest report: at each multiple of `step` they
/// warn of all pairs whose closest approach comes within `look_ahead` and is nearer than the distance.
Alarms straight_on_alarms(const RecordedSky& sky, const std::vector<Delivery>& deliveries, double distance,
                          double look_ahead, double step);

struct AlarmScore {
  std::size_t approaches = 0;    ///< in truth
  std::size_t missed = 0;        ///< of them, no warning before their end
  std::size_t late = 0;          ///< of the others, none before their begin
  std::size_t alarms = 0;        ///< those no more than `look_ahead` apart count as one
  std::size_t false_alarms = 0;  ///< no approach in them, or within `look_ahead` after them
};
AlarmScore score_of(const Alarms& alarms, const std::map<TrackPair, std::vector<Span>>& truth,
                    double look_ahead);

}  // namespace kinesphere
