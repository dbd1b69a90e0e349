// The settings of a watch.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "formats/fields/separations.hpp"
#include "formats/ids/identities.hpp"
#include "kinesphere/monitor/monitor.hpp"
#include "watch/tracks/track_classes.hpp"

namespace kinesphere::program {

/// A bound for reports without one in the stream, and its source.
struct FallbackError {
  std::optional<double> bound{};
  std::string declaration{};
};

/// Kinds of alerts that a watch may write.
struct AlertKinds {
  bool within = true;      ///< verdicts that begin or end a certain `within`
  bool predicted = true;   ///< predictions and their ends
  bool lost = true;        ///< tracks that became stale in an encounter (AlertPolicy)
  bool undecided = false;  ///< verdicts between apart and undecided, and each other one
  bool tracks = false;     ///< alerts of single tracks
};

/// A circle around a place: latitude and longitude, or x and y; and its radius.
struct WatchedArea {
  double first = 0.0, second = 0.0;
  double radius = 0.0;  ///< length, > 0
};

struct WatchSettings {
  std::vector<NamedSeparation> separations;
  std::string own;           ///< id of the track whose pairs are watched; empty: all pairs are
  std::string own_as_given;  ///< as --own says it, before --same
  Identities ids;
  AlertKinds kinds;
  bool has_distinct_ids = false;   ///< each id is a body of its own
  bool has_steady_rate = true;     ///< SameBodies::Limits
  double rest_speed = 0.0;         ///< RestRule::speed
  bool text = false;               ///< alerts are lines of text
  std::vector<WatchedArea> areas;  ///< alerts are about pairs with a track in one of them; empty: all are
  std::uint64_t most_alerts = std::numeric_limits<std::uint64_t>::max();  ///< alerts in a second
  double hold = 0.0;     ///< MonitorDefinition::prediction_hold (seconds)
  double confirm = 0.0;  ///< MonitorDefinition::prediction_confirmation (seconds)
  Shard share{};         ///< other watches have the other pairs
  /// An option that gives a unit of lengths or speeds, and what it says: "--separation", "sphere:50m"; both
  /// empty where none does. Then streams whose unit is not known are taken as they are.
  std::string measured_option, measured_text;
  std::optional<int> dimensions;  ///< empty: three if the first report has a height
  TrackClasses classes;           ///< with the limits of tracks
  std::vector<ClassRule> class_rules;
  bool has_automatic_classes = true;  ///< the stream may give classes
  FallbackError position_error, height_error, velocity_error, climb_error;
  double stamp_error = 0.0;
  double velocity_age = 0.0;
  double silence = 0.0, forget = 0.0;
  double window = 1.0;
  double leap = 60.0;  ///< a time that is ahead by more needs confirmation (seconds)
  enum class Clock {
    stream,  ///< arrival times in the stream, else timestamps
    stamps,
    machine,  ///< this machine's clock
  } clock = Clock::stream;
  struct Origin {
    double latitude = 0.0, longitude = 0.0;
  };
  std::optional<Origin> origin;  ///< empty: the first position
  double radius = 500e3;
  std::size_t most_malformed = std::numeric_limits<std::size_t>::max();
  // These limit memory and alerts against hostile senders.
  std::size_t most_tracks = 50'000;
  std::size_t most_pairs = 1'000'000;  ///< maximum pairs that are not certainly apart
  std::string source;                  ///< the stream's name, for messages
  std::string format;                  ///< of the stream, for its state

  /// Returns a length so small that two tracks which stay so near each other are within every separation in
  /// the plane, with room for errors.
  double small_length() const {
    constexpr double part = 0.25;
    double length = std::numeric_limits<double>::infinity();
    for (const NamedSeparation& named : separations)
      length = std::min(length, part * named.separation.horizontal);
    return length;
  }
  TrackId own_track() const { return own.empty() ? 0 : track_id_of(own); }
};

}  // namespace kinesphere::program
