// The settings of a watch.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kinesphere/monitor/monitor.hpp"
#include "separations.hpp"
#include "watch/track_classes.hpp"

namespace kinesphere::program {

/// A bound for reports without one in the stream, and its source.
struct FallbackError {
  std::optional<double> bound{};
  std::string declaration{};
};

/// Kinds of alerts that a watch may write.
struct AlertKinds {
  bool within = true;     ///< verdicts that begin or end a certain `within`
  bool predicted = true;  ///< predictions and their ends
  bool undecided = true;  ///< verdicts between apart and undecided
  bool tracks = true;     ///< alerts of single tracks
};

struct WatchSettings {
  std::vector<NamedSeparation> separations;
  std::string own;  ///< id of the track whose pairs are watched; empty: all pairs are
  AlertKinds kinds;
  double hold = 0.0;              ///< MonitorDefinition::prediction_hold (seconds)
  Shard share{};                  ///< other watches have the other pairs
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
};

}  // namespace kinesphere::program
