// A watch as those see it who write of it: its stages, and words for what they know.
#pragma once

#include <string>

#include "watch/policy/alert_desk.hpp"

namespace kinesphere::program {

/// Two tracks in the order of their ids as texts, as in alerts.
struct OrderedPair {
  TrackId first, second;
};

/// The functions but for counters(), first_time() and last_time() need a monitor.
struct WatchView {
  const WatchSettings& settings;
  const WatchCounts& counts;
  const ReportClock& clock;
  const WatchedTracks& tracks;
  const PairMonitor& pairs;
  const AlertDesk& desk;

  const Monitor& monitor() const { return *pairs.monitor(); }
  /// Counts of reports and so on; zero before there is a monitor.
  MonitorCounters counters() const { return pairs.monitor() ? monitor().counters() : MonitorCounters{}; }
  const NamedTrack* track(TrackId id) const { return tracks.names().find(id); }
  const NamedSeparation& separation(std::uint32_t level) const { return settings.separations[level]; }
  OrderedPair in_text_order(TrackId a, TrackId b) const {
    const TrackNames& names = tracks.names();
    return names.text(b) < names.text(a) ? OrderedPair{b, a} : OrderedPair{a, b};
  }

  // As JSON.
  /// Returns the time in the stream's form, a number or a text with a date; null for an infinite time.
  std::string json_time(double time) const;
  std::string json_id(TrackId id) const;
  /// Return the first and the last time of the stream; null before there is one.
  std::string first_time() const { return clock.has_begun() ? json_time(clock.first()) : "null"; }
  std::string last_time() const { return clock.has_begun() ? json_time(clock.now()) : "null"; }
  /// Returns the time between these (seconds).
  double time_covered() const { return clock.has_begun() ? clock.now() - clock.first() : 0.0; }
};

}  // namespace kinesphere::program
