// The exact course of a gap along exact trajectories: the truth that detectors are held against.
//
// Within a piece on which both motions are one cubic, the squared distance of two bodies is a polynomial of
// degree 6 in time (4 without jerk), and the distance to a wall a cubic. Its Bernstein coefficients enclose
// it: where they have one sign it has no root, where those of its derivative do it is monotone. Subdivision
// leaves nothing out.
#pragma once

#include <functional>
#include <optional>

#include "kinesphere/bound.hpp"
#include "kinesphere/motion/trajectory.hpp"

namespace kinesphere {

/// Which way the gap goes through a level.
enum class LevelCrossing { falls_to, rises_to };

/// The gap of two bodies or of a body and a wall, over the time that both trajectories cover. Refers to the
/// trajectories, which must outlive it.
class GapCourse {
 public:
  GapCourse(const Trajectory& a, const Trajectory& b, double radii) : a_(&a), b_(&b), radius_(radii) {}
  GapCourse(const Trajectory& a, const HalfSpace& inside, double radius)
      : a_(&a), wall_(inside), radius_(radius) {}

  double gap_at(double t) const;
  /// The first time in [from, to] at which the gap is at most (falls_to) or at least (rises_to) `level`.
  std::optional<double> first_time(LevelCrossing crossing, double level, double from, double to) const;

  struct Least {
    double time;
    double gap;
  };
  /// Where the gap of two bodies is least in [from, to]: the least value to within rounding, and the earliest
  /// found of the times that have it.
  Least least(double from, double to) const;

 private:
  template <class Visit>
  void for_each_piece(double from, double to, const Visit& visit) const;

  const Trajectory* a_;
  const Trajectory* b_ = nullptr;
  HalfSpace wall_;
  double radius_;
};

/// The segment of a trajectory that holds at time t.
const Segment& segment_at(const Trajectory& trajectory, double t);

}  // namespace kinesphere
