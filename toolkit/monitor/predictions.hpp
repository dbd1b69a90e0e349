// Predictions: pairs of tracks whose closest approach comes in the look-ahead time of a separation, and
// within it, if both go straight on.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "kinesphere/monitor/monitor.hpp"
#include "monitor/due_times.hpp"
#include "monitor/near_tracks.hpp"
#include "monitor/pair_records.hpp"
#include "monitor/separation_table.hpp"
#include "monitor/straight_pass.hpp"

namespace kinesphere {

/// The path of a track that goes straight on from its state at `time`.
struct StraightPath {
  double time = 0.0;
  State state{};
  ErrorBound error{};  ///< the part of the position error that counts

  State state_at(double t) const { return {state.position + state.velocity * (t - time), state.velocity}; }
};

/// The prediction of a pair at one level.
struct LevelPrediction {
  bool predicted = false;   ///< reported as predicted, and not yet as ended
  bool holds = false;       ///< the condition of MonitorEventKind::predicted was met when last decided
  double since = 0.0;       ///< time of the event `predicted`
  double held_since = 0.0;  ///< if `holds`: time since which it has held without a break
  double held_until = 0.0;  ///< if `predicted` and not `holds`: time until which it held
};

struct PairPrediction {
  double due = infinity;  ///< time at which time alone may change a prediction
  std::vector<LevelPrediction> levels;

  bool is_predicted() const {
    return std::any_of(levels.begin(), levels.end(),
                       [](const LevelPrediction& level) { return level.predicted; });
  }
};

/// Each track of a class with a look-ahead time has a home: a ball that contains its straight path from now
/// until that time (and the modified tau) after `until`, with a margin of half of the widest separation, and
/// of the height that it may gain in the modified tau. A pair whose homes do not
/// touch comes within no separation in its look-ahead time, until one of the two homes ends. All other pairs
/// are near. Of these, pairs that meet if both go straight on, or that are predicted, have a PairPrediction.
class Predictions {
 public:
  /// The arguments must outlive this object.
  Predictions(const MonitorDefinition& definition, const SeparationTable& separations)
      : definition_(&definition),
        separations_(&separations),
        homes_(definition.tolerance, definition.dimensions) {}

  /// Sets the straight path of a track, new or known, with the position error of its report, and adds the
  /// events of predictions that change. Cost: O(near tracks); where the path leaves the track's home, a
  /// search. Precondition: the class has a look-ahead time.
  void set_path(std::uint32_t number, TrackId id, std::size_t track_class, const State& state,
                const ErrorBound& error, double now, std::vector<MonitorEvent>& events);
  /// Forgets a track. Its predictions end without events.
  void remove(std::uint32_t number);
  /// Returns a lower bound on the time at which time alone changes anything; +infinity if nothing does.
  double next_time() const { return due_.next_time(); }
  /// Handles all that is due at `now`.
  void advance(double now, std::vector<MonitorEvent>& events);

  bool is_predicted(std::uint32_t a, std::uint32_t b, std::uint32_t level) const {
    const PairPrediction* pair = pairs_.find(a, b);
    return pair != nullptr && pair->levels[level].predicted;
  }
  std::vector<PredictedPair> predicted_pairs(double now) const;

  struct TrackKey {
    TrackId id = 0;
    std::size_t track_class = 0;
  };
  /// Completes what serialize() has read with what it leaves out: the tracks by number (nothing stands for
  /// none), and what follows from the rest. Returns false if the state is not one of these tracks.
  bool restore(std::span<const std::optional<TrackKey>> tracks, double now);
  static void serialize(auto& self, auto& archive) {
    std::vector<SavedPair<PairPrediction>> pairs;
    constexpr bool writes = std::is_const_v<std::remove_reference_t<decltype(self)>>;
    if constexpr (writes) pairs = self.pairs_.sorted();
    archive(self.tracks_, self.homes_, pairs);
    if constexpr (!writes)
      for (const auto& [first, second, pair] : pairs) self.pairs_.add(first, second) = pair;
  }

 private:
  struct Track {
    bool present = false;
    TrackId id = 0;
    std::size_t track_class = 0;
    StraightPath path{};
    double until = 0.0;       ///< end of its home
    std::uint32_t pairs = 0;  ///< number of its PairPredictions

    static void serialize(auto& self, auto& archive) {
      auto& [present, id, track_class, path, until, pairs] = self;
      archive(present, path, until);
    }
  };
  bool is_valid(const Track& track, double now) const;
  bool restore_pairs();
  bool is_due(const DueTime& due) const;
  void add_due(const DueTime& due);
  void index_due();
  std::span<const Components> levels_of(const Track& a, const Track& b) const;
  Components with_errors(const Components& level, const Track& a, const Track& b) const;
  double margin(const Track& track) const;
  bool stays_home(std::uint32_t number, double now) const;
  void find_home(std::uint32_t number, double now);
  PairPrediction* find_pair(std::uint32_t a, std::uint32_t b);
  PairPrediction& add_pair(std::uint32_t a, std::uint32_t b, std::size_t levels);
  void remove_pair(std::uint32_t a, std::uint32_t b);
  void decide_all(std::uint32_t number, double now, std::vector<MonitorEvent>& events);
  StraightPass judge(const State& first, const State& second, const Components& level,
                     const StraightPass& pass, bool is_predicted, double now) const;
  void decide(std::uint32_t a, std::uint32_t b, double now, std::vector<MonitorEvent>& events);

  const MonitorDefinition* definition_;
  const SeparationTable* separations_;
  std::vector<Track> tracks_;
  PairMap<PairPrediction> pairs_;
  NearTracks homes_;
  DueTimes due_;
};

}  // namespace kinesphere
