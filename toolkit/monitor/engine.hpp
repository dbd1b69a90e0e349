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

#include "broadphase/certificate_queue.hpp"
#include "broadphase/neighbour_search.hpp"
#include "kinesphere/monitor/monitor.hpp"
#include "monitor/pair_records.hpp"
#include "monitor/predictions.hpp"
#include "monitor/separation_forecast.hpp"
#include "monitor/separation_table.hpp"
#include "monitor/track_table.hpp"

namespace kinesphere {

/// Invariant: at least one of these statements holds for each watched pair of tracks.
///   - Their swept spheres do not touch before the window ends, so the tracks are apart.
///   - The tracks certainly are apart until the window ends.
///   - The tracks certainly are apart until the failure time of a PairCertificate.
///   - The pair has a PairRecord. Its verdicts hold until the failure time of the pair's certificate. If it
///     has no certificate, they hold until one of the two tracks reports or, if all verdicts are apart, until
///     the window ends.
/// All statements are about the true tracks, which obey all correct reports. A report that contradicts none
/// of the earlier ones therefore ends none of them.
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
  std::size_t open_pair_count() const { return pair_records_.size(); }
  std::vector<TrackId> crowd(std::size_t pairs) const;
  std::vector<ReportRequest> needed(double until) const;

  std::vector<std::byte> save() const;
  static Result<std::unique_ptr<Engine>> restore(std::span<const std::byte> snapshot);

 private:
  /// Value of PairCertificate::second_revision that marks the certificate of a PairRecord.
  static constexpr std::uint32_t of_open_record = std::numeric_limits<std::uint32_t>::max();

  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive);
  /// Returns the name of the first part of a restored state that violates an invariant, or nullptr.
  const char* first_invalid_part() const;
  bool window_is_valid() const;

  /// Selects when new hypotheses enter the broad phase: immediately, or at the next start of windows.
  enum class Placing { now, later };
  std::uint32_t take(TrackId id, const TrackReport& report, Placing placing);
  void place(std::uint32_t number);
  void drop(std::uint32_t number, MonitorEventKind kind);
  void predict(std::uint32_t number);
  void expect_to_hear(std::uint32_t number);
  void look_at_silence(std::uint32_t number);

  bool is_stale(const PairCertificate& pair) const;
  void start_clock(double time) {
    time_ = time;
    has_started_ = true;
  }
  Window next_window() const;
  Result<void> start_windows(const Poll* poll);
  void weigh_reports(std::size_t tracks);
  Result<void> recheck(const Poll* poll);
  Result<void> ask_about(const PairCertificate& pair, const Poll& poll);
  Result<void> ask(std::span<const std::uint32_t> numbers, const Poll& poll, Placing placing);
  /// Returns the separation levels of a pair; empty if the pair is not watched.
  std::span<const Components> levels_of(std::uint32_t a, std::uint32_t b) const {
    if (!definition_.shard.contains(std::min(tracks_[a].id, tracks_[b].id))) return {};
    return separations_.between(tracks_[a].track_class, tracks_[b].track_class);
  }
  SeparationForecast forecast(std::uint32_t a, std::uint32_t b, const Components& level,
                              double horizon) const {
    return forecast_of(tracks_[a].estimate, tracks_[b].estimate, level, time_, horizon, resolution());
  }
  std::optional<double> apart_until(std::uint32_t a, std::uint32_t b, double horizon);
  std::optional<double> certified_until(std::uint32_t a, std::uint32_t b) const;
  bool is_decided(std::uint32_t a, std::uint32_t b);
  bool is_less_certain(std::uint32_t a, std::uint32_t b) const;
  State straight_on(const KnownTrack& track) const;
  ErrorBound acceleration_limit(const KnownTrack& track) const;
  void find_pair(std::uint32_t a, std::uint32_t b);
  void decide(std::uint32_t a, std::uint32_t b);
  void close_records();
  void decide_level(std::uint32_t a, std::uint32_t b, std::uint32_t level, LevelState& state);
  void decide_open_pairs(std::uint32_t number);
  void decide_pairs_not_due(std::uint32_t number);
  void add_certificate(std::uint32_t a, std::uint32_t b, double time);
  void queue(MonitorEvent event);
  void queue_all(const std::vector<MonitorEvent>& events);
  /// Broad-phase slot of a hypothesis; track_at() is its inverse with respect to the track.
  static std::uint32_t place_of(std::uint32_t number, const Hypothesis& hypothesis) {
    return number * TrackEstimate::slots + hypothesis.slot;
  }
  static std::uint32_t track_at(std::uint32_t place) { return place / TrackEstimate::slots; }
  InflatedBound inflated_bound(std::uint32_t number, const Hypothesis& hypothesis, double end) const;
  /// Returns the window in which new hypotheses are registered: the current one or, if it has ended, its
  /// successor.
  Window window() const { return time_ < window_.end ? window_ : Window::at(time_, rung_); }
  /// Returns the shortest duration for which a verdict counts as certain: MonitorDefinition::time_resolution
  /// or, where doubles of the size of time() are coarser, 2^-50 of time().
  double resolution() const { return std::max(definition_.time_resolution, std::abs(time_) * 0x1p-50); }

  MonitorDefinition definition_;
  std::vector<TrackClass> classes_;  ///< Limits of the classes; without z in two dimensions.
  SeparationTable separations_;
  int rung_;  ///< Rung of windows while reports arrive.
  double time_;
  bool has_started_;  ///< False until start_clock() if the definition gives no start time.
  Window window_{.rung = 0, .end = -infinity};
  /// Number of windows started since the last report or request; windows that find many pairs count an
  /// eighth.
  std::uint32_t quiet_windows_ = 0;
  /// So many of them count although reports arrive: it grows while a window has few reports for the tracks
  /// that it starts, most of which are silent, and shrinks faster.
  std::uint32_t sparse_windows_ = 0;
  std::uint64_t reports_before_window_ = 0;  ///< Counter of reports at the start of the window.
  MonitorCounters counters_;
  TrackTable tracks_;
  PairRecords pair_records_;
  Predictions predictions_;
  BroadPhase broad_phase_;
  CertificateQueue queue_;
  std::deque<MonitorEvent> events_;  ///< Events at time() that advance() has not returned yet, in order.
  bool asking_ = false;
  std::vector<PairCertificate>
      read_pairs_;  ///< Certificates read from a snapshot, before restore() adds them to queue_.
  NeighbourSearch search_;
  std::vector<std::optional<InflatedBound>>
      bounds_;  ///< Bounds of the hypotheses that start a window, by broad-phase slot.
};

}  // namespace kinesphere
