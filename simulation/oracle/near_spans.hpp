// The spans of time in which bodies may be near each other, from exact trajectories alone. Only there the
// exact course of a gap (gap_course.hpp) has to be followed.
//
// Time is cut into windows. In each window every trajectory lies in a box around the Bernstein coefficients
// of its pieces, rounded outward. Two bodies with disjoint boxes are apart in that window.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "kinesphere/inspection.hpp"
#include "kinesphere/motion/trajectory.hpp"
#include "kinesphere/vec3.hpp"

namespace kinesphere {

/// A body that is there during [begin, end]. Its trajectory covers that time.
struct PresentBody {
  const Trajectory* trajectory = nullptr;
  double begin = 0.0, end = 0.0;
  double radius = 0.0;
};

/// A span of time in which the gap of two bodies, first < second, may be at most the gap asked for.
struct NearSpan {
  std::uint32_t first = 0, second = 0;
  double begin = 0.0, end = 0.0;
};

/// Returns spans sorted by bodies and time; two spans of one pair never touch each other. Whenever two bodies
/// that are there have a gap of `gap` or less, one of their spans holds that time. A body without a
/// trajectory is never there. A span begins and ends where a piece of one of the two begins or ends, or where
/// one of them comes or goes: so a search for roots from the begin of a span gives the bits of a search over
/// all time. `on_progress`, if not empty, is called with the part that is done, from 0 to 1. Cost: O(pieces)
/// boxes, a sort of them in each window, and comparisons of boxes that overlap on the axis on which bodies
/// are farthest apart. Memory: 32 bytes for each span, and as much for each body.
std::vector<NearSpan> near_spans(const std::vector<PresentBody>& bodies, double gap,
                                 const std::function<void(double part)>& on_progress = {});

/// Returns a box that contains the trajectory during [begin, end]. Precondition: the trajectory covers that
/// time.
Box box_of(const Trajectory& trajectory, double begin, double end);

}  // namespace kinesphere
