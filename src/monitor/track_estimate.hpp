// What the reports of one track add up to.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "kinesphere/bound.hpp"
#include "kinesphere/monitor/report.hpp"
#include "monitor/plans_beyond_class.hpp"
#include "monitor/reachable_set.hpp"

namespace kinesphere {

/// A way in which the reports can be explained: all of its claims hold.
struct Hypothesis {
  double timestamp = 0.0;  ///< of its latest report
  std::uint32_t slot = 0;  ///< no other one of the track has the same, nor had one just before it came
  /// What the latest report says by itself, for comparing with others; both before and after it.
  ReachableSet motion{};
  State state{};
  PlansBeyondClass plans{};  ///< of all its reports
  /// Those of the latest report, and behind them perhaps one of another.
  std::vector<ReachableSet> sets;
  std::size_t latest_sets = 0;

  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    auto& [stamp, slot, motion, state, plans, claims, latest_claims] = self;
    archive(stamp, slot, motion, state, plans, claims, latest_claims);
  }
};

/// How far one report lies outside of what another leaves possible.
struct Excess {
  double position = 0.0;
  double velocity = 0.0;
  bool any() const { return position > 0.0 || velocity > 0.0; }
};

/// One of the hypotheses is true, as long as of any three successive reports at most one is wrong and that
/// one contradicts those before. There are several only while reports contradict each other.
class TrackEstimate {
 public:
  /// Slots of hypotheses are less than this: there always is a free one.
  static constexpr std::uint32_t slots = 4;

  enum class Outcome {
    repeated,     ///< it is the same report as before
    agrees,       ///< with all that was believed
    contradicts,  ///< all that was believed: now there is one hypothesis more
    resolves,     ///< it agrees with some, and the others are dropped
  };
  struct Learned {
    Outcome outcome = Outcome::agrees;
    Excess excess{};
    bool late = false;
    /// What was certain of the track may not be so any more: it may be elsewhere than was thought possible.
    bool ends_certainty = false;
  };

  /// A report that has come in at `now`, of a track of this class. `ahead`: for how long claims are to be
  /// good.
  Learned update(const TrackReport& report, const TrackClass& promise, double now, double ahead);

  std::span<const Hypothesis> hypotheses() const { return hypotheses_; }
  /// Of the latest report.
  double timestamp() const;
  /// Of the hypothesis, of the claims that hold all the time, the one that is tightest in the end.
  static const ReachableSet& tightest(const Hypothesis& hypothesis, double from, double until);
  static const ReachableSet& tightest(const Hypothesis& hypothesis, double time) {
    return tightest(hypothesis, time, time);
  }
  /// Contains the track from `now` until `end`, if the hypothesis is true.
  static Bound bound(const Hypothesis& hypothesis, double now, double end);
  /// A track is asked rather than another if this is larger. If two tracks with the acceleration limits A and
  /// B are to be certain to the same sum of radii, the fewest reports are needed where their ages are as
  /// A^(-1/3) : B^(-1/3). Then this, radius by age, is the same for both.
  double worth_asking(double time) const;
  /// For what was read: each hypothesis has a slot of its own, and at every time from `now` on a claim that
  /// holds.
  bool is_valid(double now) const;
  /// When the first claim that `bound` may rest upon ends.
  double first_end() const;

  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    auto& [hypotheses] = self;
    archive(hypotheses);
  }

 private:
  std::uint32_t free_slot() const;

  std::vector<Hypothesis> hypotheses_;
};

}  // namespace kinesphere
