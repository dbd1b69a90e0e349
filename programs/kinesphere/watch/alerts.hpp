// Alerts as JSON lines, or as lines of text if WatchSettings::text says so.
#pragma once

#include <optional>
#include <string>

#include "formats/fields/time_scale.hpp"
#include "kinesphere/monitor/monitor.hpp"
#include "watch/alert_policy.hpp"
#include "watch/track_names.hpp"
#include "watch/watch_settings.hpp"

namespace kinesphere::program {

/// Returns a finite number; null for any other.
std::string json_number(double value);
/// Returns the time in the stream's form, a number or a text with a date; null for an infinite time.
std::string json_time(const TimeScale& times, double time);

/// Context for writing alerts.
struct AlertContext {
  const WatchSettings& settings;
  const TimeScale& times;
  const TrackNames& names;
  const Monitor& monitor;
  double stretch = 1.0;  ///< distances of the monitor are at most so many times too long
  bool is_geographic = false;
  double first_time = 0.0;  ///< at which the stream begins
};

/// Two tracks in the order of their ids as texts, as in alerts.
struct OrderedPair {
  TrackId first, second;
};
OrderedPair in_text_order(const TrackNames& names, TrackId a, TrackId b);
/// Returns the limits of the distance of two tracks and related fields, without the braces: `"distance": [1,
/// 2], ...`. Precondition: the monitor has both tracks.
std::string answer_fields(const AlertContext& context, const OrderedPair& pair, std::uint32_t level,
                          const PairAnswer& answer);
/// Returns the sources of the declared bounds of a track.
std::string declarations_of(const NamedTrack& track);
/// Why a track is no longer watched.
struct LeftFor {
  std::string_view reason{};  ///< "silence", "crowd", "group", "dissolved", "handover"
  std::string later{};        ///< of a handover: the id of the track that goes on as this one
};
/// A track that was lost in an encounter.
struct LostTrack {
  double time = 0.0;
  TrackId track = 0;
  AlertPolicy::Key key{};
  const Encounter& encounter;  ///< with a loss
  LeftFor left_for{};          ///< "stale", "dropped" or "handover"
};
/// Returns the line of an alert that a track was lost in an encounter.
std::string lost_line(const AlertContext& context, const LostTrack& lost);
/// Returns the line of an alert that two tracks are one body under two ids.
std::string one_body_line(const AlertContext& context, double time, TrackId a, TrackId b);
/// Returns the line of an alert about alerts that were not written.
std::string refused_line(const AlertContext& context, const AlertPolicy::Refused& refused);
/// Returns the line of an alert that tracks are watched as a group from now on.
std::string group_line(const AlertContext& context, double time, const std::string& name, std::size_t tracks);
/// Returns one line. Precondition: the monitor is at the time of the event. `left_for`: why a dropped track
/// was removed.
std::string alert_line(const AlertContext& context, const MonitorEvent& event, const LeftFor& left_for);

}  // namespace kinesphere::program
