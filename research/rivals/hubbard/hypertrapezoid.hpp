// Hubbard's space-time bound: a hypertrapezoid around the parabolic horn that a time-varying bound draws in
// space-time.
#pragma once

#include <array>

#include "kinesphere/bound.hpp"
#include "research/rivals/hubbard/sweep.hpp"

namespace kinesphere {

/// Two faces per axis, straight lines in the plane of that axis and time. At any instant of its interval the
/// cross-section is a box that contains the body.
struct Hypertrapezoid {
  std::array<Line, 3> lower;
  std::array<Line, 3> upper;
};

/// Encloses the bound from its report on, for `duration` > 0 (time), and leaves at least `clearance` >= 0
/// (length) around it. Along an axis the upper edge of the bound is x + r + (v + e1) s + 1/2 (g + A) s^2 with
/// r = Bound::radius. Where that is convex its chord lies above it; where it is concave (a planned
/// acceleration stronger than the limit) the parallel tangent does. The faces are rounded outward.
Hypertrapezoid enclose(const Bound& bound, double duration, double clearance);

}  // namespace kinesphere
