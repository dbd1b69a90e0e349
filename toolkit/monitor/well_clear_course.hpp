// Well clear with modified tau of two tracks in the course of time.
#pragma once

#include "monitor/reachable_set.hpp"
#include "monitor/well_clear.hpp"

namespace kinesphere {

/// How modified tau changes between two reachable sets, from a time at which both hold. As long as both hold,
/// the results are true of the tracks (docs/monitoring.md, Lemma 6). Times are absolute. Cost of a call: up
/// to 16 steps of 50 ns.
class WellClearCourse {
 public:
  /// `component` is that of the plane; `least` is the resolution of the results (time, > 0).
  WellClearCourse(const ReachableSet& a, const ReachableSet& b, const Component& component, double now,
                  double least);

  /// True if the two certainly have not lost well clear, as far as modified tau counts.
  bool is_clear() const { return clear_by_tau_for(now_discs_, limits_) > 0.0; }
  /// True if the two certainly have lost well clear, or would if the limit were larger by the tolerance.
  bool is_lost() const { return lost_for(now_discs_, outer_limits_) > 0.0; }

  /// Return a time before which is_clear() or is_lost() stays true, or +infinity if it does up to the
  /// horizon.
  double clear_until(double horizon) const;
  double lost_until(double horizon) const;
  /// Return a time before which time alone does not make is_clear() or is_lost() true, but perhaps in the
  /// next `least`: errors are taken not to grow from now on. +infinity if that time is after the horizon.
  double may_be_clear(double horizon) const;
  double may_be_lost(double horizon) const;

 private:
  /// A reachable set in the plane.
  struct Part {
    Part(const ReachableSet& set, const Component& component);

    double time;
    Vec3 position, velocity, acceleration;
    double radius, speed, growth;
    double position_size, velocity_size, acceleration_size;  ///< sums of magnitudes, for roundings
  };

  RelativeDiscs discs_at(double time) const;
  /// Returns the discs of a time, with the errors of now.
  RelativeDiscs least_discs_at(double time) const;

  Part a_, b_;
  WellClearLimits limits_, outer_limits_;
  double now_, least_;
  RelativeDiscs now_discs_;
};

}  // namespace kinesphere
