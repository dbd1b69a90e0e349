// Events of a monitor.
#pragma once

#include <cstdint>
#include <string_view>

#include "kinesphere/monitor/separation.hpp"

namespace kinesphere {

/// Identifies a track; chosen by the caller, for example a transponder address or an MMSI.
using TrackId = std::uint64_t;

/// What a monitor reports.
enum class MonitorEventKind {
  /// The verdict about two tracks and a separation changes at this time.
  verdict,
  /// If both go straight on, the closest approach of two tracks is within a separation and comes in its
  /// look-ahead time, or they are within it now. For Separation::Shape::well_clear, it is the loss of well
  /// clear that comes in the look-ahead time. A prediction, without a guarantee: tracks may turn.
  predicted,
  /// The two no longer do so: they have passed each other, or a report shows that they will not.
  prediction_ended,
  /// A report contradicts the earlier ones: one of them has larger errors than stated, or the track moves in
  /// a way that its class rules out. The monitor keeps a hypothesis for each until later reports show which
  /// one is wrong.
  contradiction,
  /// A contradiction has ended: the hypothesis of the wrong report is dropped.
  resolved,
  /// The latest report of a track has reached the age MonitorDefinition::stale_after.
  stale,
  /// A stale track has reported again.
  resumed,
  /// A track was dropped: it was removed, or its latest report has reached the age
  /// MonitorDefinition::drop_after. Its open pairs remain undecided, and no more events about it follow. This
  /// event comes before all others of its time, so that the id may report again at once.
  dropped,
  /// A report has given the track another class. The track starts anew: its open pairs and predictions are
  /// over, without events of their own, and it is decided again, with the limits and separations of its new
  /// class. This event comes before all others of its time.
  reclassified,
};

/// True for kinds of events about a pair of tracks; the others are about one track.
constexpr bool is_of_pair(MonitorEventKind kind) { return kind <= MonitorEventKind::prediction_ended; }
/// Returns the name of an event kind in lower case, for example "verdict".
std::string_view name_of(MonitorEventKind kind);
/// Returns "apart", "undecided" or "within".
std::string_view name_of(Verdict verdict);

/// What became certain, is predicted or was noticed about one track or two, at its exact time.
struct MonitorEvent {
  double time = 0.0;
  MonitorEventKind kind = MonitorEventKind::verdict;
  /// The track that the event is about; for a pair, the one with the lower id.
  TrackId first = 0;
  TrackId second = 0;  ///< For a verdict or a prediction: the track with the higher id.

  std::uint32_t level = 0;  ///< For a verdict or a prediction: the separation level.
  // For a verdict: the new and the previous one.
  Verdict verdict = Verdict::apart;
  Verdict before = Verdict::apart;
  /// Time at which the previous verdict began, -infinity if the pair was apart at all levels; for a
  /// prediction, time at which it began.
  double since = 0.0;

  // For a prediction: what happens if both tracks go straight on from now.
  double likely_time =
      0.0;  ///< The two come within the separation; now if they are, +infinity if they never are.
  double closest_time = 0.0;      ///< Time of their closest approach.
  double closest_distance = 0.0;  ///< Distance then (length); for a cylinder, that in the plane.

  /// For a contradiction: the distance of the reported position and velocity outside of what was possible
  /// (length, length / time).
  double position_excess = 0.0;
  double velocity_excess = 0.0;

  friend bool operator==(const MonitorEvent&, const MonitorEvent&) = default;
};

}  // namespace kinesphere
