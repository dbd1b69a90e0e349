// What a monitor tells.
#pragma once

#include <cstdint>
#include <string_view>

#include "kinesphere/monitor/separation.hpp"

namespace kinesphere {

/// The caller's number for what it watches: a transponder's address, an MMSI.
using TrackId = std::uint64_t;

enum class MonitorEventKind {
  /// What is certain of two tracks and a separation is another thing from this time on.
  verdict,
  /// A report contradicts those before: one of them was farther off than it said, or the track moves in a way
  /// that its class rules out. Both are believed possible, until others show which one was wrong.
  contradiction,
  /// A contradiction is over: the report that was wrong is not believed any more.
  resolved,
  /// Nothing has been heard of a track for MonitorDefinition::stale_after.
  stale,
  /// A track that was silent has reported.
  resumed,
  /// A track has left: it was removed, or nothing was heard of it for MonitorDefinition::drop_after. What
  /// was open about it stays undecided for ever, and nothing more is told of it.
  dropped,
};

/// "verdict" and so on.
std::string_view name_of(MonitorEventKind kind);
/// "apart", "undecided", "within".
std::string_view name_of(Verdict verdict);

struct MonitorEvent {
  double time = 0.0;
  MonitorEventKind kind = MonitorEventKind::verdict;
  /// The track that it is about; of two, that with the lesser number.
  TrackId first = 0;
  TrackId second = 0;  ///< of a verdict

  // Of a verdict: about which separation, and what it is and was.
  std::uint32_t level = 0;
  Verdict verdict = Verdict::apart;
  Verdict before = Verdict::apart;
  double since = 0.0;  ///< when the one before began; -infinity if they were apart at all levels

  /// Of a contradiction: how far the position, and the velocity, lie outside of what was possible (length,
  /// length / time).
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
