// Events of a monitor.
#pragma once

#include <cstdint>
#include <string_view>

#include "kinesphere/monitor/separation.hpp"

namespace kinesphere {

/// Identifies a track; chosen by the caller, for example a transponder address or an MMSI.
using TrackId = std::uint64_t;

enum class MonitorEventKind {
  /// The verdict about two tracks and a separation changes at this time.
  verdict,
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
  /// MonitorDefinition::drop_after. Its open pairs remain undecided, and no more events about it follow.
  dropped,
};

/// Returns the name of an event kind in lower case, for example "verdict".
std::string_view name_of(MonitorEventKind kind);
/// Returns "apart", "undecided" or "within".
std::string_view name_of(Verdict verdict);

struct MonitorEvent {
  double time = 0.0;
  MonitorEventKind kind = MonitorEventKind::verdict;
  /// The track that the event is about; for a verdict, the one with the lower id.
  TrackId first = 0;
  TrackId second = 0;  ///< For a verdict: the track with the higher id.

  // For a verdict: the separation level, the new and the previous verdict.
  std::uint32_t level = 0;
  Verdict verdict = Verdict::apart;
  Verdict before = Verdict::apart;
  double since =
      0.0;  ///< Time at which the previous verdict began; -infinity if the pair was apart at all levels.

  /// For a contradiction: the distance of the reported position and velocity outside of what was possible
  /// (length, length / time).
  double position_excess = 0.0;
  double velocity_excess = 0.0;

  friend bool operator==(const MonitorEvent&, const MonitorEvent&) = default;

  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    auto& [time, kind, first, second, level, verdict, before, since, position_excess, velocity_excess] = self;
    archive(time, kind, first, second, level, verdict, before, since, position_excess, velocity_excess);
  }
};

}  // namespace kinesphere
