// A grid of swept spheres of about one size and one window, sorted by cell so that a search reads whole rows
// of them at once.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "broadphase/grid.hpp"
#include "broadphase/swept_sphere_search.hpp"
#include "broadphase/swept_sphere_table.hpp"
#include "parallel/thread_pool.hpp"

namespace kinesphere {

/// Each swept sphere has a slot in the table, which stays the same until the next sort(), fill() or clear().
/// Sorted slots can have free ones among them, spare slots, one for every eight swept spheres. A swept sphere
/// that is added later takes one near its cell; without such a slot it comes behind the sorted ones, where
/// every search tests it.
class SweptSphereGrid {
 public:
  /// Greatest coarseness(). It is many times the width of the widest swept sphere, which may be far less wide
  /// than a unit.
  static constexpr float coarsest = 0x1p100f;

  SweptSphereGrid() = default;
  explicit SweptSphereGrid(const SweptSphereFrame& frame) : frame_(frame) {}

  const SweptSphereFrame& frame() const { return frame_; }
  const SweptSphereTable& table() const { return table_; }
  /// Number of bodies in the grid.
  std::size_t size() const { return table_.bodies(); }
  /// Number of slots that are sorted by cell; those added since are behind them.
  std::uint32_t sorted_slots() const { return sorted_; }
  /// Upper limit of the widths, on any axis, of all swept spheres from the times at which they start to hold
  /// (in units of the frame).
  float widest() const { return widest_; }
  /// Empties the grid, for swept spheres of another frame.
  void clear(const SweptSphereFrame& frame);
  /// Edge of the cells in widths of the widest swept sphere; a power of two. Sorting doubles it while cells
  /// hold few swept spheres, and halves it for the next sort where they hold many.
  float coarseness() const { return coarseness_; }
  void set_coarseness(float coarseness) { coarseness_ = coarseness; }
  /// Decides whether fill() and sort() make spare slots from now on. They pay if many swept spheres change.
  void set_spare_slots(bool on) { has_spare_slots_ = on; }

  /// Adds a swept sphere that holds from time `from` of the frame until 1, and returns its slot.
  std::uint32_t add(std::uint32_t number, const SweptSphere& sphere, float from);
  /// Returns the looseness (how far out of its cell) of another swept sphere for the body at a slot, which
  /// would hold from time `from` until 1. Returns nothing if it should get another slot, lest searches cost
  /// more: if the looseness exceeds the edge of a cell or, where there are spare slots, that of all others.
  /// Precondition: the slot is not free.
  std::optional<float> looseness_at(std::uint32_t slot, const SweptSphere& sphere, float from) const;
  /// Accumulates, over replaced swept spheres, the greatest looseness and width, and their number.
  struct Growth {
    float reach = 0.0f;
    float widest = 0.0f;
    std::uint64_t replaced = 0;
  };
  /// Replaces the swept sphere at a slot; `looseness` is what looseness_at() returned. Thread safety:
  /// concurrent calls for different slots, each with a `growth` of its own, are safe. Precondition of the
  /// next search: grow().
  void replace(std::uint32_t slot, const SweptSphere& sphere, float from, float looseness, Growth& growth);
  void grow(const Growth& growth) {
    reach_ = std::max(reach_, growth.reach);
    widest_ = std::max(widest_, growth.widest);
  }
  /// Makes the slot free.
  void remove(std::uint32_t slot) { table_.remove(slot); }

  /// True if searches would cost less after a sort, because many swept spheres are behind the sorted ones or
  /// many slots are free.
  bool is_untidy() const {
    return table_.slots() - sorted_ > most_behind_ || table_.free_slots() > 64 + table_.slots() / 2;
  }
  /// Replaces the contents by `all`, sorted by cell. The swept spheres hold from time 0 of the frame until 1.
  /// moved(number, slot) is called for each body, by several threads concurrently. Cost: linear.
  template <class Moved>
  void fill(const UnsortedSweptSpheres& all, PoolLease& lease, Moved moved) {
    std::vector<std::uint32_t> cells;
    choose_cells(all, spread_of(all, lease), cells, lease);
    fill(all, cells, lease, moved);
  }
  // The steps of fill().
  static SweptSphereSpread spread_of(const UnsortedSweptSpheres& all, PoolLease& lease);
  /// Chooses cells for `all`, of this spread, and writes the cell of each to `cells`. Precondition: the grid
  /// is empty.
  void choose_cells(const UnsortedSweptSpheres& all, const SweptSphereSpread& spread,
                    std::vector<std::uint32_t>& cells, PoolLease& lease);
  /// Precondition: choose_cells() came last.
  template <class Moved>
  void fill(const UnsortedSweptSpheres& all, const std::vector<std::uint32_t>& cells, PoolLease& lease,
            Moved moved) {
    arrange(all, cells, lease);
    lease.parallel_for(table_.slots(), many, [&](std::size_t begin, std::size_t end, std::size_t) {
      for (auto slot = static_cast<std::uint32_t>(begin); slot < end; ++slot)
        if (!is_free(slot)) moved(table_.number_at(slot), slot);
    });
  }
  /// Sorts all swept spheres by cell and removes free slots but for spare ones. Slots change: moved(number,
  /// slot) is called for each body. Cost: linear.
  template <class Moved>
  void sort(PoolLease& lease, Moved moved) {
    const UnsortedSweptSpheres all = table_.all();
    const float widest = widest_;
    std::vector<std::uint32_t> cells;
    choose_cells(all, spread_of(all, lease), cells, lease);
    widest_ = widest;
    arrange(all, cells, lease);
    for (std::uint32_t slot = 0; slot < table_.slots(); ++slot)
      if (!is_free(slot)) moved(table_.number_at(slot), slot);
  }

  /// Adds a search for all swept spheres that the query's may touch during its span; it may find free slots
  /// too.
  void add_search(const SweptSphereQuery& query, SweptSphereSearches& searches) const;
  /// Adds a search, among the slots behind `slot`, for all that the swept sphere at `slot` may touch from
  /// time `from` to 1; it may find free slots too. Nothing is searched for a free slot. Searches from all
  /// sorted slots find each pair of them once. Slots that were added since the last sort are not searched.
  void add_search_behind(std::uint32_t slot, SweptSphereSearches& searches, float from = 0.0f) const;
  /// Runs the searches.
  void make(SweptSphereSearches& searches) const { searches.make(table_.columns()); }

  /// Calls visit(box, number of swept spheres), in units of the frame, for each cell that contains the centre
  /// of a swept sphere's box.
  template <class Visit>
  void for_each_cell(Visit visit) const {
    std::map<Grid::Cell, std::size_t> filled;
    for (std::uint32_t slot = 0; slot < table_.slots(); ++slot)
      if (!is_free(slot))
        ++filled[grid_.cell_around(float_aabb_of(table_.swept_sphere_at(slot), 0.0f, 1.0f))];
    for (const auto& [cell, count] : filled) visit(grid_.box_of(cell), count);
  }
  /// Returns the number of swept spheres per unit of volume (of area, if `flat`) in the cubes that hold any.
  /// Precondition: the grid has been sorted, and is unchanged since.
  double density(bool flat) const;
  /// True if the deserialized state is consistent.
  bool is_valid() const;
  /// True if `cells` may be a result of choose_cells() for this grid, which is to be filled.
  bool can_fill(const std::vector<std::uint32_t>& cells) const;

  static void serialize(auto& self, auto& archive) {
    auto& [frame, table, cells, starts, sorted, grid, reach, widest, most_behind, filled, coarseness, spare] =
        self;
    archive(frame, table, cells, starts, sorted, grid, reach, widest, most_behind, filled, coarseness, spare);
  }

 private:
  static constexpr std::uint32_t least_behind = 64;
  /// Minimum swept spheres per parallel chunk; below this, dispatch costs more than the work.
  static constexpr std::size_t many = 1024;

  struct SpareSlot {
    std::uint32_t slot;
    std::uint32_t cell;
  };

  void choose_grid(const UnsortedSweptSpheres& all, const SweptSphereSpread& spread,
                   std::vector<std::uint32_t>& cells, PoolLease& lease);
  void count_by_cells(const UnsortedSweptSpheres& all, std::vector<std::uint32_t>& cells, PoolLease& lease);
  std::uint32_t filled_cubes(PoolLease& lease) const;
  template <class Visit>
  void for_each_range(std::size_t spheres, PoolLease& lease, Visit visit) const;
  void choose_slots(const std::vector<std::uint32_t>& cells, std::vector<std::uint32_t>& slots,
                    std::vector<SpareSlot>& spare, PoolLease& lease);
  void arrange(const UnsortedSweptSpheres& all, const std::vector<std::uint32_t>& cells, PoolLease& lease);
  bool is_free(std::uint32_t slot) const { return table_.number_at(slot) == SweptSphereTable::free_slot; }
  std::optional<std::uint32_t> spare_slot_for(const FloatAabb& aabb) const;
  void add_ranges(const SweptSphereQuery& query, std::uint32_t first_slot,
                  SweptSphereSearches& searches) const;

  SweptSphereFrame frame_;
  SweptSphereTable table_;
  std::vector<std::uint32_t> cells_;   ///< cell of each sorted slot
  std::vector<std::uint32_t> starts_;  ///< first slot of each cell, and the end of the last cell
  std::uint32_t sorted_ = 0;           ///< slots below this are sorted
  Grid grid_;
  float reach_ = 0.0f;  ///< greatest looseness of a sorted swept sphere
  float widest_ = 0.0f;
  std::uint32_t most_behind_ = least_behind;
  std::uint32_t filled_ = 0;  ///< cubes that held any swept sphere at the last sort
  float coarseness_ = 1.0f;
  bool has_spare_slots_ = false;
};

}  // namespace kinesphere
