// Alerts as JSON lines.
#pragma once

#include <optional>
#include <string>

#include "kinesphere/monitor/monitor.hpp"
#include "tracks/time_scale.hpp"
#include "watch/track_names.hpp"
#include "watch/watch_settings.hpp"

namespace kinesphere::program {

/// A finite number; null for any other.
std::string json_number(double value);
/// As in the stream: a number or a text with a date. null for a time that never comes, or never was.
std::string json_time(const TimeScale& times, double time);

/// What alerts are written with.
struct AlertContext {
  const WatchSettings& settings;
  const TimeScale& times;
  const TrackNames& names;
  const Monitor& monitor;
  double stretch = 1.0;  ///< distances of the monitor are at most so many times too long
};

/// Two tracks, in the order of their ids as texts: so alerts name them.
struct OrderedPair {
  TrackId first, second;
};
OrderedPair in_text_order(const TrackNames& names, TrackId a, TrackId b);
/// Limits of the distance of two tracks, and so on, without the braces: `"distance": [1, 2], ...`.
std::string answer_fields(const AlertContext& context, const PairAnswer& answer);
/// What the bounds of a track rest upon.
std::string declarations_of(const NamedTrack& track);
/// One line. The monitor stands at the time of the event. `is_dropped` says of a track that left that it was
/// dropped from a crowd.
std::string alert_line(const AlertContext& context, const MonitorEvent& event, bool is_dropped);

}  // namespace kinesphere::program
