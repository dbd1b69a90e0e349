#include "distributed/bisection.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

namespace kinesphere {
namespace {

/// The search for a cut ends when the cost on its lower side is as near to its share as this part of all.
constexpr double near_enough = 1e-3;
/// As many halvings reach from the extent of points to doubles beside each other.
constexpr int most_halvings = 1100;

/// Ranks that share a box, and are to divide it.
struct Branch {
  int first;  ///< rank
  int ranks;
  Box box;

  double share() const { return static_cast<double>(ranks / 2) / ranks; }
};

/// Points, and to which branch of the present level each belongs.
struct Points {
  std::span<const Vec3> positions;
  std::span<const double> costs;
  std::vector<std::ptrdiff_t> branch;  ///< -1 for none

  void for_each(auto function) const {
    for (std::size_t k = 0; k < positions.size(); ++k)
      if (branch[k] >= 0) function(positions[k], costs[k], static_cast<std::size_t>(branch[k]));
  }
};

/// The search for the cut of one branch: `share` of its cost is to be below it.
struct Search {
  int axis = 0;
  double lower = infinity;  ///< too little is below a cut here
  double upper = -infinity;
  double total = 0.0;
  double wanted = 0.0;  ///< cost below the cut
  double at = 0.0;      ///< the best cut so far
  double off = infinity;
  double next = 0.0;  ///< the cut to try
  bool is_done = false;

  /// Returns true if the points are not all at one place. The best cut then has some on both sides.
  bool can_divide() const { return off < infinity; }
  /// Takes note of the cost below `next`.
  void note(double below) {
    if (std::abs(below - wanted) < off) {
      off = std::abs(below - wanted);
      at = next;
    }
    (below < wanted ? lower : upper) = next;
    next = std::midpoint(lower, upper);
    is_done = off <= near_enough * total || !(lower < next && next < upper);
  }
};

/// Returns where the points of each branch reach farthest, and what they cost.
std::vector<Search> begin_searches(Communicator& communicator, std::span<const Branch> branches,
                                   const Points& points) {
  std::vector<Box> extents(branches.size(), nowhere);
  std::vector<double> totals(branches.size());
  points.for_each([&](const Vec3& position, double cost, std::size_t branch) {
    totals[branch] += cost;
    for (int axis = 0; axis < 3; ++axis) {
      extents[branch].lower[axis] = std::min(extents[branch].lower[axis], position[axis]);
      extents[branch].upper[axis] = std::max(extents[branch].upper[axis], position[axis]);
    }
  });
  std::vector<double> sides;
  for (const Box& extent : extents)
    for (int axis = 0; axis < 3; ++axis) sides.insert(sides.end(), {extent.lower[axis], -extent.upper[axis]});
  communicator.least(sides);
  communicator.sum(totals);
  std::vector<Search> searches(branches.size());
  for (std::size_t k = 0; k < branches.size(); ++k) {
    Search& search = searches[k];
    for (int axis = 0; axis < 3; ++axis) {
      const double lower = sides[6 * k + 2 * static_cast<std::size_t>(axis)];
      const double upper = -sides[6 * k + 2 * static_cast<std::size_t>(axis) + 1];
      // Halves, since the widest differences overflow.
      if (axis > 0 && !(0.5 * upper - 0.5 * lower > 0.5 * search.upper - 0.5 * search.lower)) continue;
      search.axis = axis;
      search.lower = lower;
      search.upper = upper;
    }
    search.total = totals[k];
    search.wanted = branches[k].share() * totals[k];
    // A cut at the upper end has points on both sides, unless all are at one place.
    search.next = search.upper;
    search.is_done = !(search.lower < search.upper);
  }
  return searches;
}

void find_cuts(Communicator& communicator, std::span<Search> searches, const Points& points) {
  const auto is_done = [](const Search& search) { return search.is_done; };
  for (int step = 0; step < most_halvings; ++step) {
    if (std::all_of(searches.begin(), searches.end(), is_done)) return;
    std::vector<double> below(searches.size());
    points.for_each([&](const Vec3& position, double cost, std::size_t branch) {
      if (position[searches[branch].axis] < searches[branch].next) below[branch] += cost;
    });
    communicator.sum(below);
    for (std::size_t k = 0; k < searches.size(); ++k)
      if (!searches[k].is_done) searches[k].note(below[k]);
  }
}

}  // namespace

std::vector<Box> bisect(Communicator& communicator, std::span<const Vec3> positions,
                        std::span<const double> costs) {
  std::vector<Box> boxes(static_cast<std::size_t>(communicator.ranks()), nowhere);
  std::vector<Branch> branches;
  /// Gives the box to the only rank of a branch, or lets the next level divide it. Returns where it is there.
  const auto add = [&](std::vector<Branch>& level, const Branch& branch) -> std::ptrdiff_t {
    boxes[static_cast<std::size_t>(branch.first)] = branch.box;
    if (branch.ranks == 1) return -1;
    level.push_back(branch);
    return static_cast<std::ptrdiff_t>(level.size()) - 1;
  };
  Points points{positions, costs, {}};
  points.branch.assign(positions.size(), add(branches, {0, communicator.ranks(), everywhere}));
  while (!branches.empty()) {
    std::vector<Search> searches = begin_searches(communicator, branches, points);
    find_cuts(communicator, searches, points);
    std::vector<Branch> next;
    std::vector<std::array<std::ptrdiff_t, 2>> parts;  // by branch: those below and above its cut
    for (std::size_t k = 0; k < branches.size(); ++k) {
      const auto& [first, ranks, box] = branches[k];
      parts.push_back({-1, -1});
      if (!searches[k].can_divide()) continue;
      Branch below{first, ranks / 2, box}, above{first + ranks / 2, ranks - ranks / 2, box};
      below.box.upper[searches[k].axis] = above.box.lower[searches[k].axis] = searches[k].at;
      parts.back() = {add(next, below), add(next, above)};
    }
    for (std::size_t k = 0; k < positions.size(); ++k) {
      if (points.branch[k] < 0) continue;
      const auto branch = static_cast<std::size_t>(points.branch[k]);
      const bool is_above = positions[k][searches[branch].axis] >= searches[branch].at;
      points.branch[k] = parts[branch][is_above ? 1 : 0];
    }
    branches = std::move(next);
  }
  return boxes;
}

}  // namespace kinesphere
