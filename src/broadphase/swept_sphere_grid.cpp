#include "broadphase/swept_sphere_grid.hpp"

#include <atomic>
#include <cassert>
#include <cmath>

#include "number/infinity.hpp"

namespace kinesphere {
namespace {

/// Range of the mean number of swept spheres in a cube that holds any; outside this range, sorting changes
/// the coarseness.
constexpr std::size_t too_few_in_a_cell = 3;
constexpr std::size_t too_many_in_a_cell = 24;
/// Number of swept spheres for each spare slot. More spare slots make searches longer, fewer leave more swept
/// spheres behind the sorted ones.
constexpr std::uint32_t spheres_for_a_spare_slot = 8;

}  // namespace

void SweptSphereGrid::clear(const SweptSphereFrame& frame) {
  frame_ = frame;
  table_.clear();
  cells_.clear();
  starts_.clear();
  sorted_ = 0;
  reach_ = 0.0f;
  widest_ = 0.0f;
  most_behind_ = least_behind;
}

std::uint32_t SweptSphereGrid::add(std::uint32_t number, const SweptSphere& sphere, float from) {
  const FloatAabb aabb = float_aabb_of(sphere, from, 1.0f);
  widest_ = std::max(widest_, aabb.widest());
  const std::optional<std::uint32_t> spare = spare_slot_for(aabb);
  if (!spare) return table_.add(number, sphere);
  table_.occupy(*spare, number, sphere);
  return *spare;
}

/// Returns a free slot of the cell around a box, or of one near it along x, out of which the box reaches no
/// farther than others do out of theirs.
std::optional<std::uint32_t> SweptSphereGrid::spare_slot_for(const FloatAabb& aabb) const {
  if (!has_spare_slots_ || sorted_ == 0) return std::nullopt;
  const Grid::Cell middle = grid_.cell_around(aabb);
  for (const std::int32_t way : {0, 1, -1, 2, -2}) {
    Grid::Cell cell = middle;
    cell[0] += way;
    if (!(grid_.looseness(cell, aabb) <= reach_)) continue;
    const std::uint32_t index = grid_.index_of(cell);
    // Beyond the end of an axis that is not folded there is no such cell.
    if (grid_.nearest_image(index, cell) != cell) continue;
    for (std::uint32_t slot = starts_[index]; slot < starts_[index + 1]; ++slot)
      if (is_free(slot)) return slot;
  }
  return std::nullopt;
}

std::optional<float> SweptSphereGrid::looseness_at(std::uint32_t slot, const SweptSphere& sphere,
                                                   float from) const {
  assert(!is_free(slot));
  // Swept spheres added since the last sort have no cell.
  if (slot >= sorted_) return 0.0f;
  const FloatAabb aabb = float_aabb_of(sphere, from, 1.0f);
  const Grid::Cell here = grid_.nearest_image(cells_[slot], grid_.cell_around(aabb));
  const float out = grid_.looseness(here, aabb);
  return out <= (has_spare_slots_ ? reach_ : grid_.edge()) ? std::optional(out) : std::nullopt;
}

void SweptSphereGrid::replace(std::uint32_t slot, const SweptSphere& sphere, float from, float looseness,
                              Growth& growth) {
  growth.reach = std::max(growth.reach, looseness);
  growth.widest = std::max(growth.widest, float_aabb_of(sphere, from, 1.0f).widest());
  ++growth.replaced;
  table_.replace(slot, sphere);
}

SweptSphereSpread SweptSphereGrid::spread_of(const UnsortedSweptSpheres& all, PoolLease& lease) {
  std::vector<SweptSphereSpread> spreads(lease.count());
  lease.parallel_for(all.spheres.size(), many, [&](std::size_t begin, std::size_t end, std::size_t worker) {
    SweptSphereSpread spread;
    for (std::size_t k = begin; k < end; ++k) spread.add(float_aabb_of(all.spheres[k], 0.0f, 1.0f));
    spreads[worker].add(spread);
  });
  SweptSphereSpread spread;
  for (const SweptSphereSpread& one : spreads) spread.add(one);
  return spread;
}

/// Chooses a grid with cells coarse enough that each filled one holds several swept spheres, and counts by
/// its cells.
void SweptSphereGrid::choose_grid(const UnsortedSweptSpheres& all, const SweptSphereSpread& spread,
                                  std::vector<std::uint32_t>& cells, PoolLease& lease) {
  const std::size_t count = cells.size();
  // Cells wider than 4 times the extent of all swept spheres would separate nothing.
  const auto is_of_use = [&spread](float coarseness) {
    return coarseness == 1.0f || coarseness * spread.widest() <= 4.0f * spread.extent();
  };
  while (!is_of_use(coarseness_)) coarseness_ *= 0.5f;
  for (;;) {
    grid_ = Grid(spread, count, coarseness_);
    count_by_cells(all, cells, lease);
    filled_ = filled_cubes(lease);
    const bool few_in_cells = grid_.cells() > 1 && count < too_few_in_a_cell * filled_;
    if (!(few_in_cells && coarseness_ < coarsest && is_of_use(2.0f * coarseness_))) break;
    coarseness_ *= 2.0f;
  }
  if (count > too_many_in_a_cell * filled_ && coarseness_ > 1.0f) coarseness_ *= 0.5f;
}

/// Returns the number of cubes that hold any swept sphere. Precondition: count_by_cells().
std::uint32_t SweptSphereGrid::filled_cubes(PoolLease& lease) const {
  const std::size_t along = grid_.cells_in_a_row();
  const std::size_t rows = grid_.cells() / along;
  std::atomic<std::uint32_t> all = 0;
  lease.parallel_for(rows, many / along + 1, [&](std::size_t from, std::size_t to, std::size_t) {
    std::uint32_t filled = 0;
    for (std::size_t row = from * along; row < to * along; row += along) {
      for (std::size_t first = 0; first < along; first += Grid::slices) {
        const auto begin = starts_.begin() + static_cast<std::ptrdiff_t>(row + first);
        const auto end = begin + static_cast<std::ptrdiff_t>(std::min(Grid::slices, along - first));
        filled += std::any_of(begin, end, [](std::uint32_t count) { return count > 0; }) ? 1 : 0;
      }
    }
    all += filled;
  });
  return all;
}

double SweptSphereGrid::density(bool flat) const {
  if (filled_ == 0) return 0.0;
  const double edge = grid_.edge();
  return static_cast<double>(size()) / (filled_ * (flat ? edge * edge : edge * edge * edge));
}

/// Writes the cell of each swept sphere to `cells`, the number in each cell to starts_[cell], and the
/// greatest looseness to reach_.
void SweptSphereGrid::count_by_cells(const UnsortedSweptSpheres& all, std::vector<std::uint32_t>& cells,
                                     PoolLease& lease) {
  std::vector<float> reaches(lease.count());
  lease.parallel_for(all.spheres.size(), many, [&](std::size_t begin, std::size_t end, std::size_t worker) {
    float reach = 0.0f;
    for (std::size_t k = begin; k < end; ++k) {
      const FloatAabb aabb = float_aabb_of(all.spheres[k], 0.0f, 1.0f);
      const Grid::Cell cell = grid_.cell_around(aabb);
      cells[k] = grid_.index_of(cell);
      reach = std::max(reach, grid_.looseness(cell, aabb));
    }
    reaches[worker] = std::max(reaches[worker], reach);
  });
  reach_ = *std::max_element(reaches.begin(), reaches.end());
  // resize() alone may allocate twice the memory.
  starts_.reserve(grid_.cells() + 1);
  starts_.resize(grid_.cells() + 1);
  starts_.back() = 0;
  for_each_range(cells.size(), lease, [&](std::uint32_t from, std::uint32_t to) {
    std::fill(starts_.begin() + from, starts_.begin() + to, 0);
    for (const std::uint32_t cell : cells)
      if (cell - from < to - from) ++starts_[cell];
  });
}

/// Calls visit(from, to) for disjoint ranges that together are all cells. Many swept spheres get one range
/// per thread, but at most 8, because each call goes through all swept spheres; few get a single range.
template <class Visit>
void SweptSphereGrid::for_each_range(std::size_t spheres, PoolLease& lease, Visit visit) const {
  const std::size_t cells = grid_.cells();
  constexpr std::size_t most_ranges = 8;
  const std::size_t ranges = spheres < many ? 1 : std::min(lease.count(), most_ranges);
  lease.for_each(ranges, 1, [&](std::size_t k, std::size_t) {
    visit(static_cast<std::uint32_t>(cells * k / ranges),
          static_cast<std::uint32_t>(cells * (k + 1) / ranges));
  });
}

/// Assigns each swept sphere its slot: by cell and, within a cell, in the order given, with spare slots
/// behind. Precondition: count_by_cells().
void SweptSphereGrid::choose_slots(const std::vector<std::uint32_t>& cells, std::vector<std::uint32_t>& slots,
                                   std::vector<SpareSlot>& spare, PoolLease& lease) {
  // Each entry of starts_ is at first the end of its cell, and counts down to the cell's begin as slots are
  // taken from the back.
  std::uint32_t sum = 0;
  std::uint32_t without_spare = 0;
  for (std::uint32_t cell = 0; cell < starts_.size(); ++cell) {
    const std::uint32_t here = starts_[cell];
    starts_[cell] = sum += here;
    if (!has_spare_slots_) continue;
    for (without_spare += here; without_spare >= spheres_for_a_spare_slot;
         without_spare -= spheres_for_a_spare_slot)
      spare.push_back({sum++, cell});
  }
  for_each_range(cells.size(), lease, [&](std::uint32_t from, std::uint32_t to) {
    for (std::size_t k = cells.size(); k-- > 0;)
      if (cells[k] - from < to - from) slots[k] = --starts_[cells[k]];
  });
}

void SweptSphereGrid::choose_cells(const UnsortedSweptSpheres& all, const SweptSphereSpread& spread,
                                   std::vector<std::uint32_t>& cells, PoolLease& lease) {
  cells.resize(all.numbers.size());
  choose_grid(all, spread, cells, lease);
  widest_ = spread.largest();
}

/// Fills the table with `all`, sorted by cell.
void SweptSphereGrid::arrange(const UnsortedSweptSpheres& all, const std::vector<std::uint32_t>& cells,
                              PoolLease& lease) {
  const auto count = static_cast<std::uint32_t>(all.numbers.size());
  std::vector<std::uint32_t> slots(count);
  std::vector<SpareSlot> spare;
  choose_slots(cells, slots, spare, lease);
  most_behind_ = least_behind + static_cast<std::uint32_t>(4.0 * std::sqrt(static_cast<double>(count)));
  sorted_ = count + static_cast<std::uint32_t>(spare.size());
  table_.resize(sorted_, most_behind_ + 2);
  cells_.resize(sorted_);
  lease.for_each(count, many, [&](std::size_t k, std::size_t) {
    table_.fill(slots[k], all.numbers[k], all.spheres[k]);
    cells_[slots[k]] = cells[k];
  });
  for (const auto& [slot, cell] : spare) {
    table_.leave_free(slot);
    cells_[slot] = cell;
  }
}

/// Adds a query, and ranges of sorted slots from `first_slot` on that hold all swept spheres which may meet
/// the query's own.
void SweptSphereGrid::add_ranges(const SweptSphereQuery& query, std::uint32_t first_slot,
                                 SweptSphereSearches& searches) const {
  const auto number = static_cast<std::uint32_t>(searches.queries.size());
  searches.queries.push_back(query);
  const auto cells = grid_.cells_near(float_aabb_of(query.sphere, query.from, query.to), reach_);
  if (!cells) return;
  // Two ranges become one, with all slots between them, if that takes no more vectors than reading them
  // separately. Cells must come in ascending order, or the slots between may have been read already.
  const bool in_order = !grid_.wraps(*cells);
  const auto vectors = [](const SlotRange& range) {
    return (range.end - range.begin + search_lanes - 1) / search_lanes;
  };
  std::vector<SlotRange>& ranges = searches.ranges;
  grid_.for_each_row(*cells, [&](std::uint32_t first, std::uint32_t last) {
    const SlotRange range{std::max(starts_[first], first_slot), starts_[last], number};
    if (range.begin >= range.end) return;
    if (in_order && !ranges.empty() && ranges.back().query == number) {
      const SlotRange both{ranges.back().begin, range.end, number};
      if (vectors(both) <= vectors(ranges.back()) + vectors(range)) {
        ranges.back() = both;
        return;
      }
    }
    ranges.push_back(range);
  });
}

void SweptSphereGrid::add_search(const SweptSphereQuery& query, SweptSphereSearches& searches) const {
  if (sorted_ > 0) {
    add_ranges(query, 0, searches);
  } else {
    searches.queries.push_back(query);
  }
  if (table_.slots() > sorted_)
    searches.ranges.push_back(
        {sorted_, table_.slots(), static_cast<std::uint32_t>(searches.queries.size() - 1)});
}

void SweptSphereGrid::add_search_behind(std::uint32_t slot, SweptSphereSearches& searches, float from) const {
  const SweptSphereQuery query{table_.swept_sphere_at(slot), from, 1.0f};
  if (is_free(slot)) {
    searches.queries.push_back(query);
  } else {
    add_ranges(query, slot + 1, searches);
  }
}

bool SweptSphereGrid::can_fill(const std::vector<std::uint32_t>& cells) const {
  if (!grid_.is_valid() || starts_.size() != grid_.cells() + 1) return false;
  std::vector<std::uint32_t> counts(starts_.size());
  for (const std::uint32_t cell : cells) {
    if (cell >= grid_.cells()) return false;
    ++counts[cell];
  }
  return counts == starts_;
}

bool SweptSphereGrid::is_valid() const {
  const auto is_positive = [](double value) { return value > 0.0 && value < infinity; };
  if (!is_finite(frame_.base) || !std::isfinite(frame_.origin) || !is_positive(frame_.per_length) ||
      !is_positive(frame_.per_time))
    return false;
  if (!(reach_ >= 0.0f && widest_ >= 0.0f && coarseness_ >= 1.0f && coarseness_ <= coarsest)) return false;
  if (!table_.is_valid() || sorted_ > table_.slots()) return false;
  if (sorted_ == 0) return true;
  if (!grid_.is_valid() || starts_.size() != grid_.cells() + 1 || cells_.size() < sorted_) return false;
  for (std::uint32_t slot = 0; slot < sorted_; ++slot)
    if (cells_[slot] >= grid_.cells() || slot < starts_[cells_[slot]] || slot >= starts_[cells_[slot] + 1])
      return false;
  return starts_.front() == 0 && starts_.back() == sorted_ && std::is_sorted(starts_.begin(), starts_.end());
}

}  // namespace kinesphere
