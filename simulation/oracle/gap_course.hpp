// The exact course of a gap along exact trajectories: the truth that detectors are compared with.
//
// Within a piece in which each motion is one cubic, the squared distance of two bodies is a polynomial of
// degree 6 in time (4 without jerk), and the distance to a wall is a cubic. The Bernstein coefficients
// enclose the polynomial: where all have one sign it has no root, and where all those of its derivative have
// one sign it is monotone. Subdivision leaves nothing out.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "kinesphere/bound.hpp"
#include "kinesphere/motion/trajectory.hpp"

namespace kinesphere {

struct CoursePiece;

/// The direction in which the gap passes a level.
enum class LevelCrossing { falls_to, rises_to };

/// The gap of two bodies, or of a body and a wall, over the time that the trajectories cover. It refers to
/// the trajectories, which must outlive it.
class GapCourse {
 public:
  GapCourse(const Trajectory& a, const Trajectory& b, double radii) : a_(&a), b_(&b), radius_(radii) {}
  GapCourse(const Trajectory& a, const HalfSpace& inside, double radius)
      : a_(&a), wall_(inside), radius_(radius) {}

  double gap_at(double t) const;
  /// Returns the first time in [from, to] at which the gap is at most (falls_to) or at least (rises_to)
  /// `level`; nothing if there is none.
  std::optional<double> first_time(LevelCrossing crossing, double level, double from, double to) const;

  struct Least {
    double time;
    double gap;
  };
  /// Returns the least gap of two bodies in [from, to], to within rounding, and the earliest time found that
  /// has it. Precondition: the course is that of two bodies.
  Least least(double from, double to) const;

  struct Minimum {
    double time;
    double gap;
    bool is_at_end;  ///< at `from` or `to`, with the gap still falling toward it
  };
  /// Returns the local minima of the gap of two bodies in [from, to], by time: where it stops falling and
  /// then rises, at once or after it has stayed the same. The first time is one if the gap rises from there
  /// on, and the last if it falls until there; so there is at least one. None is left out whose depth below
  /// the gap around it exceeds rounding, and rounding invents none. Precondition: as for least(). Cost: a few
  /// polynomials for each piece and each turning point.
  std::vector<Minimum> minima(double from, double to) const;

 private:
  using PieceVisitor = std::function<bool(const CoursePiece&)>;
  void for_each_piece(double from, double to, const PieceVisitor& visit) const;

  const Trajectory* a_;
  const Trajectory* b_ = nullptr;
  HalfSpace wall_;
  double radius_;
};

/// Returns the segment of a trajectory that holds at time t; the first one if t is before it.
const Segment& segment_at(const Trajectory& trajectory, double t);

}  // namespace kinesphere
