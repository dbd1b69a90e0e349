#include "distributed/halo_region.hpp"

#include <algorithm>
#include <cmath>

#include "number/infinity.hpp"

namespace kinesphere {
namespace {

/// Returns the multiple of the period that, added to `side`, moves it to or above `lower`; 0 if `lower` is
/// infinite.
double shift_above(double side, double lower, double period) {
  return lower > -infinity ? std::ceil((lower - side) / period) * period : 0.0;
}

bool covers(const Box& outer, const Box& inner, const Space& space) {
  for (int axis = 0; axis < 3; ++axis) {
    double shift = 0.0;
    if (space.repeats(axis)) {
      const double period = space.period()[axis];
      if (outer.upper[axis] - outer.lower[axis] >= period) continue;
      shift = shift_above(inner.lower[axis], outer.lower[axis], period);
    }
    if (!(outer.lower[axis] <= inner.lower[axis] + shift && inner.upper[axis] + shift <= outer.upper[axis]))
      return false;
  }
  return true;
}

}  // namespace

bool meet(const Box& a, const Box& b, const Space& space) {
  for (int axis = 0; axis < 3; ++axis) {
    double shift = 0.0;
    if (space.repeats(axis)) shift = shift_above(b.upper[axis], a.lower[axis], space.period()[axis]);
    if (!(b.lower[axis] + shift <= a.upper[axis] && a.lower[axis] <= b.upper[axis] + shift)) return false;
  }
  return true;
}

bool HaloRegion::covers(const Box& box, const Space& space) const {
  return std::any_of(boxes_.begin(), boxes_.end(),
                     [&](const Box& outer) { return kinesphere::covers(outer, box, space); });
}

bool HaloRegion::meets(const Box& box, const Space& space) const {
  return std::any_of(boxes_.begin(), boxes_.end(), [&](const Box& known) { return meet(known, box, space); });
}

bool HaloRegions::cover(const Box& box) {
  if (covers(box)) return false;
  (*this)[here_].add(box);
  return true;
}

std::vector<int> HaloRegions::ranks_that_meet(const Box& box) const {
  std::vector<int> ranks;
  for (int rank = 0; rank < static_cast<int>(by_rank_.size()); ++rank)
    if (rank != here_ && by_rank_[static_cast<std::size_t>(rank)].meets(box, space_)) ranks.push_back(rank);
  return ranks;
}

}  // namespace kinesphere
