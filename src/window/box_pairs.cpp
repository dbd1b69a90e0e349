#include "window/box_pairs.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace kinesphere {
namespace {

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// Cells that a box covers on one axis: count of them, from `first` on.
struct Cells {
  std::int64_t first = 0;
  std::int64_t count = 1;
};

/// A grid without borders; where space repeats, so does the grid.
class CellGrid {
 public:
  CellGrid(const Space& space, double size) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      per_edge_[k] = 1.0 / size;
      if (!space.repeats(axis)) continue;
      period_[k] = std::max<std::int64_t>(
          1, static_cast<std::int64_t>(std::min(space.period()[axis] / size, double(1 << 20))));
      per_edge_[k] = static_cast<double>(period_[k]) / space.period()[axis];
    }
  }

  /// False for a box that covers more than `most`.
  bool cover(const Box& box, double most, std::array<Cells, 3>& cells) const {
    double all = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      const double first = std::floor(box.lower[axis] * per_edge_[k]);
      const double count = std::floor(box.upper[axis] * per_edge_[k]) - first + 1.0;
      all *= count;
      // Nor one whose cells cannot be counted.
      if (!(all <= most) || !(std::abs(first) < 0x1p52)) return false;
      cells[k] = {static_cast<std::int64_t>(first), static_cast<std::int64_t>(count)};
      if (period_[k] > 0) cells[k].count = std::min(cells[k].count, period_[k]);
    }
    return true;
  }

  template <class Visit>
  void for_each_hash(const std::array<Cells, 3>& cells, Visit visit) const {
    for (std::int64_t z = 0; z < cells[2].count; ++z)
      for (std::int64_t y = 0; y < cells[1].count; ++y)
        for (std::int64_t x = 0; x < cells[0].count; ++x)
          visit(hash(wrapped(cells[0].first + x, 0), wrapped(cells[1].first + y, 1),
                     wrapped(cells[2].first + z, 2)));
  }

 private:
  std::int64_t wrapped(std::int64_t cell, std::size_t axis) const {
    const std::int64_t period = period_[axis];
    return period > 0 ? (cell % period + period) % period : cell;
  }
  static std::uint64_t hash(std::int64_t x, std::int64_t y, std::int64_t z) {
    const std::uint64_t mixed = static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15u ^
                                static_cast<std::uint64_t>(y) * 0xc2b2ae3d27d4eb4fu ^
                                static_cast<std::uint64_t>(z) * 0x165667b19e3779f9u;
    return mixed ^ (mixed >> 29);
  }

  std::array<double, 3> per_edge_{};
  std::array<std::int64_t, 3> period_{};  ///< in cells; 0 where space does not repeat
};

bool overlap(const Box& a, const Box& b, const Space& space) {
  if (space.repeats()) {
    bool found = false;
    space.for_each_shift(a, b, [&](const Vec3& shift) {
      bool all = true;
      for (int axis = 0; axis < 3; ++axis)
        all = all && a.lower[axis] + shift[axis] <= b.upper[axis] &&
              b.lower[axis] <= a.upper[axis] + shift[axis];
      found = found || all;
    });
    return found;
  }
  for (int axis = 0; axis < 3; ++axis)
    if (!(a.lower[axis] <= b.upper[axis] && b.lower[axis] <= a.upper[axis])) return false;
  return true;
}

constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint32_t several = nobody - 1;
constexpr std::uint32_t none = nobody;

/// A box in a place, and the one that came there before it.
struct Link {
  std::uint32_t box;
  std::uint32_t before;
};

}  // namespace

Pairs overlapping_pairs(std::span<const Box> boxes, std::span<const std::uint32_t> owners, const Space& space,
                        double size) {
  Pairs pairs;
  const auto hold = [&](std::uint32_t a, std::uint32_t b) {
    if (owners[a] != owners[b] && overlap(boxes[a], boxes[b], space))
      pairs.emplace_back(std::min(a, b), std::max(a, b));
  };
  const CellGrid grid(space, size);
  // Holding a box against all others is cheaper than going through more cells than that.
  const double most = std::max(64.0, 0.125 * static_cast<double>(boxes.size()));
  // A cell's place is its hash.
  const std::size_t places = std::bit_ceil(16 * boxes.size() + 1);
  std::vector<std::array<Cells, 3>> cells(boxes.size());
  std::vector<std::uint32_t> owner_of(places, nobody);
  std::vector<std::uint32_t> wide;
  const auto for_each_place = [&](std::uint32_t box, auto visit) {
    grid.for_each_hash(cells[box], [&](std::uint64_t hash) { visit(hash & (places - 1)); });
  };
  for (std::uint32_t k = 0; k < boxes.size(); ++k) {
    if (!grid.cover(boxes[k], most, cells[k])) {
      wide.push_back(k);
      cells[k][0].count = 0;
    }
    for_each_place(k, [&](std::size_t place) {
      std::uint32_t& owner = owner_of[place];
      owner = owner == nobody || owner == owners[k] ? owners[k] : several;
    });
  }
  // Only places of several owners matter.
  std::vector<std::uint32_t> last(places, none);
  std::vector<Link> links;
  for (std::uint32_t k = 0; k < boxes.size(); ++k) {
    for_each_place(k, [&](std::size_t place) {
      if (owner_of[place] != several) return;
      for (std::uint32_t at = last[place]; at != none; at = links[at].before) hold(links[at].box, k);
      links.push_back({k, last[place]});
      last[place] = static_cast<std::uint32_t>(links.size() - 1);
    });
  }
  for (const std::uint32_t a : wide)
    for (std::uint32_t b = 0; b < boxes.size(); ++b) hold(a, b);
  // They may share several cells.
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace kinesphere
