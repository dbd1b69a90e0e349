// Which bodies may come near each other, and when: from exact trajectories alone, so that the exact course of
// a gap (gap_course.hpp) need be followed only there.
//
// Time is cut into windows. In each window every trajectory lies in a box: that of the Bernstein coefficients
// of its pieces, rounded outward. Two bodies whose boxes have a distance are apart in that window.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "kinesphere/motion/trajectory.hpp"
#include "kinesphere/vec3.hpp"

namespace kinesphere {

/// A body that is there during [begin, end], which its trajectory covers.
struct PresentBody {
  const Trajectory* trajectory = nullptr;
  double begin = 0.0, end = 0.0;
  double radius = 0.0;
};

/// During [begin, end] the gap of two bodies, first < second, may be at most as large as was asked for.
struct NearSpan {
  std::uint32_t first = 0, second = 0;
  double begin = 0.0, end = 0.0;
};

/// Sorted by bodies and time, no two of the same bodies touching each other. Whenever two bodies that are
/// there have a gap of `gap` or less, one of their spans holds that time. Bodies without a trajectory are not
/// there. A span begins and ends where a piece of one of the two begins or ends, or where one of them comes
/// or goes: whoever follows the gap from a span's begin does the same as if he had followed it all the time.
/// `on_progress`, if there is one, is told the part that is done. Cost: O(pieces) boxes, a sort of them in
/// each window, and comparisons of those that overlap on the axis on which bodies are farthest apart. Memory:
/// 32 bytes for each span, and as much for each body.
std::vector<NearSpan> near_spans(const std::vector<PresentBody>& bodies, double gap,
                                 const std::function<void(double part)>& on_progress = {});

/// Contains the trajectory during [begin, end], which it covers.
Box box_of(const Trajectory& trajectory, double begin, double end);

}  // namespace kinesphere
