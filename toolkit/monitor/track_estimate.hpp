// Estimate of one track from its reports.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kinesphere/bound.hpp"
#include "kinesphere/monitor/report.hpp"
#include "monitor/plans_beyond_class.hpp"
#include "monitor/reachable_set.hpp"

namespace kinesphere {

/// A report at an exact time: the errors of the state count what the error of the timestamp adds.
struct ExactReport {
  double timestamp = 0.0;
  State state{};
  ErrorBound position_error{};
  ErrorBound velocity_error{};
};

/// One explanation of the reports of a track. If it is true, all of its reachable sets contain the track.
struct Hypothesis {
  ExactReport latest{};           ///< For comparison with other reports, both before and after it.
  PlansBeyondClass plans{};       ///< Plans of all its reports.
  std::uint32_t latest_sets = 0;  ///< Number of the sets of the latest report.
  /// The sets of the latest report first, then at most one set of an earlier report.
  std::vector<ReachableSet> sets;

  static void serialize(auto& self, auto& archive) {
    auto& [latest, plans, latest_sets, sets] = self;
    archive(latest, plans, latest_sets, sets);
  }
};

/// Distance of one report outside of what another one leaves possible: position (length) and velocity (length
/// / time).
struct Excess {
  double position = 0.0;
  double velocity = 0.0;
  bool any() const { return position > 0.0 || velocity > 0.0; }
};

/// Hypotheses about a track. One of them is true, as long as among any three successive reports at most one
/// is wrong and that one contradicts those before it. There are several only while reports contradict each
/// other.
class TrackEstimate {
 public:
  enum class Outcome {
    repeated,     ///< The report repeats an earlier one.
    agrees,       ///< The report agrees with the only hypothesis.
    contradicts,  ///< The report contradicts all hypotheses and adds a new one.
    resolves,     ///< The report agrees with some of several hypotheses; the others are dropped.
  };
  struct Learned {
    Outcome outcome = Outcome::agrees;
    Excess excess{};
    bool late = false;
    /// True if earlier certificates of the track may fail: it may be outside of its earlier bounds.
    bool ends_certainty = false;
  };

  /// Applies a report that arrives at time `now`, of a track with the limits `track_class`. `ahead` is the
  /// duration for which the reachable sets should be tight (time).
  Learned update(const TrackReport& report, const TrackClass& track_class, double now, double ahead);

  std::span<const Hypothesis> hypotheses() const { return hypotheses_; }
  /// Returns the timestamp of the latest report.
  double timestamp() const;
  /// Returns the set with the smallest radius at `until` among the sets of the hypothesis that hold from
  /// `from` until `until`. Precondition: there is one.
  static const ReachableSet& tightest(const Hypothesis& hypothesis, double from, double until);
  static const ReachableSet& tightest(const Hypothesis& hypothesis, double time) {
    return tightest(hypothesis, time, time);
  }
  /// Returns a bound that contains the track from `now` until `end` if the hypothesis is true.
  static Bound bound(const Hypothesis& hypothesis, double now, double end);
  /// Returns an upper limit of the horizontal speed of the track from `now` until `end` if the hypothesis is
  /// true.
  static double largest_speed(const Hypothesis& hypothesis, double now, double end);
  /// Returns the priority of the track for polling: its radius times the age of its latest report. Of two
  /// tracks, the one with the larger value is polled. If two tracks with the acceleration limits A and B have
  /// to keep a given sum of radii, the fewest reports are needed where their ages are as A^(-1/3) : B^(-1/3).
  /// The priorities are equal then.
  double worth_asking(double time) const;
  /// Checks a restored estimate: each hypothesis has a reachable set that holds at every time from `now` on.
  bool is_valid(double now) const;
  /// Returns the earliest end of all reachable sets.
  double first_end() const;

  static void serialize(auto& self, auto& archive) {
    auto& [hypotheses] = self;
    archive(hypotheses);
  }

 private:
  std::vector<Hypothesis> hypotheses_;
};

}  // namespace kinesphere
