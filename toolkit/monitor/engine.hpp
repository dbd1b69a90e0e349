// Engine of a monitor. docs/monitoring.md lists the invariants that it keeps and proves that they suffice.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "kinesphere/monitor/monitor.hpp"
#include "monitor/due_times.hpp"
#include "monitor/near_tracks.hpp"
#include "monitor/pair_records.hpp"
#include "monitor/predictions.hpp"
#include "monitor/separation_forecast.hpp"
#include "monitor/separation_table.hpp"
#include "monitor/track_table.hpp"
#include "number/powers.hpp"

namespace kinesphere {

/// Two invariants hold whenever time advances:
///   H  A track is in its regions, with the space around it in which others matter, until KnownTrack::own.
///   P  Two tracks whose regions touch are near each other. If they are watched, they are apart until the own
///      time of one of them, or they have a PairRecord. Its verdicts hold until PairRecord::due or, those
///      that are undecided, until one of the two reports.
/// So all others are apart. Both are about the true tracks, which obey all correct reports: a report that
/// contradicts none of the earlier ones breaks neither.
class Monitor::Engine {
 public:
  explicit Engine(const MonitorDefinition& definition);

  const MonitorDefinition& definition() const { return definition_; }
  const MonitorCounters& counters() const { return counters_; }
  double time() const { return time_; }
  bool has_started() const { return has_started_; }
  const TrackTable& tracks() const { return tracks_; }
  /// Returns true while a Poll is being called.
  bool is_asking() const { return asking_; }

  Result<void> check(TrackId id, const TrackReport& report, const char* call) const;
  Result<void> report(TrackId id, const TrackReport& report);
  Result<void> remove(TrackId id);
  Result<std::optional<MonitorEvent>> advance(double until, const Poll* poll);

  Result<PairAnswer> answer(TrackId first, TrackId second, std::uint32_t level) const;
  std::vector<OpenPair> open_pairs() const;
  std::vector<PredictedPair> predicted_pairs() const { return predictions_.predicted_pairs(time_); }
  std::size_t open_pair_count() const { return open_pairs_; }
  std::vector<TrackId> crowd(std::size_t pairs) const;
  std::vector<ReportRequest> needed(double until) const;

  std::vector<std::byte> save() const;
  static Result<std::unique_ptr<Engine>> restore(std::span<const std::byte> snapshot);

 private:
  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive);
  /// Completes a state that was read. Returns the name of the first part of it that violates an invariant, or
  /// nullptr.
  const char* first_invalid_part();
  const char* first_invalid_track();
  bool is_valid_pair(std::uint32_t a, std::uint32_t b, const PairRecord& pair) const;
  bool rebuild();

  // engine.cpp: the clock.
  void start_clock(double time);
  Result<void> handle_next(const Poll* poll);
  void add_due(const DueTime& due);
  void index_due();
  void queue(MonitorEvent event);
  void queue_all(const std::vector<MonitorEvent>& events);
  /// Returns the shortest duration for which a verdict counts as certain: MonitorDefinition::time_resolution
  /// or, where doubles of the size of time() are coarser, 2^-50 of time().
  double resolution() const { return std::max(definition_.time_resolution, std::abs(time_) * 0x1p-50); }

  // reports.cpp: reports that come in, tracks that come and go.
  std::uint32_t take(TrackId id, const TrackReport& report);
  TrackReport as_seen(const TrackReport& report) const;
  void note_learned(std::uint32_t number, const TrackEstimate::Learned& learned);
  void drop(std::uint32_t number, MonitorEventKind kind);
  void predict(std::uint32_t number);
  void expect_to_hear(std::uint32_t number);
  void look_at_silence(std::uint32_t number);

  // regions.cpp: where tracks are, and which ones are near each other.
  void leave_regions(std::uint32_t number);
  void move_regions(std::uint32_t number);
  void set_own(std::uint32_t number, double time);
  Bound zone_of(std::uint32_t number, const Hypothesis& hypothesis, double end) const;
  double stays(std::uint32_t number, double end);

  // pairs.cpp: verdicts.
  /// Returns the separation levels of a pair; empty if the pair is not watched.
  std::span<const Components> levels_of(std::uint32_t a, std::uint32_t b) const {
    if (!definition_.shard.contains(std::min(tracks_[a].id, tracks_[b].id))) return {};
    return separations_.between(tracks_[a].track_class, tracks_[b].track_class);
  }
  SeparationForecast forecast(std::uint32_t a, std::uint32_t b, const Components& level) const {
    return forecast_of(tracks_[a].estimate, tracks_[b].estimate, level, time_, infinity, resolution());
  }
  std::optional<double> apart_until(std::uint32_t a, std::uint32_t b);
  void certify(std::uint32_t a, std::uint32_t b, PairRecord& pair);
  void decide(std::uint32_t a, std::uint32_t b);
  void decide_level(std::uint32_t a, std::uint32_t b, std::uint32_t level, LevelState& state);
  void decide_open_pairs(std::uint32_t number);
  void decide_pairs_not_due(std::uint32_t number);
  void open(std::uint32_t a, std::uint32_t b, PairRecord& pair);
  void close(std::uint32_t a, std::uint32_t b, PairRecord& pair, double until);
  void set_due(std::uint32_t a, std::uint32_t b, PairRecord& pair, double time);

  // asking.cpp: pairs that are due, and requests for reports.
  Result<void> recheck(const DueTime& due, const Poll* poll);
  Result<void> ask_about(const DueTime& due, const Poll& poll);
  Result<void> ask_round(const Poll& poll);
  Result<void> ask(std::span<const std::uint32_t> numbers, const Poll& poll);
  double next_round() const;
  void hasten_round();
  bool is_due(const DueTime& due) const;
  bool is_decided(std::uint32_t a, std::uint32_t b);
  bool has_undecided_pair(std::uint32_t number) const;
  bool is_less_certain(std::uint32_t a, std::uint32_t b) const;

  // answers.cpp
  std::optional<double> certified_until(std::uint32_t a, std::uint32_t b) const;
  State straight_on(const KnownTrack& track) const;
  ErrorBound acceleration_limit(const KnownTrack& track) const;

  MonitorDefinition definition_;
  std::vector<TrackClass> classes_;  ///< Limits of the classes; without z in two dimensions.
  SeparationTable separations_;
  int rung_;  ///< MonitorDefinition::window is 2^rung, rounded down.
  double time_;
  bool has_started_;    ///< False until start_clock() if the definition gives no start time.
  double round_ = 0.0;  ///< time of the next ask_round(), if there is a poll then
  /// Number of rounds since the last report in which nothing was requested.
  std::uint32_t quiet_rounds_ = 0;
  MonitorCounters counters_;
  TrackTable tracks_;
  NearTracks near_;
  PairMap<PairRecord> pairs_;   ///< of watched tracks that are near each other
  std::size_t open_pairs_ = 0;  ///< number of those that are open
  Predictions predictions_;
  DueTimes due_;
  std::deque<MonitorEvent> events_;  ///< Events at time() that advance() has not returned yet, in order.
  bool asking_ = false;
  std::vector<Region> regions_;  ///< a member only to reuse its memory
};

}  // namespace kinesphere
