// A layer: capsules of about one size and one window, sorted by the cells of a grid so that a search reads
// whole rows of them at once.
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

/// Each capsule has a place in the table, which stays the same until the layer is sorted anew or cleared.
/// Those that were added since the layer was sorted are behind the others, and every search looks at them.
class SweptSphereGrid {
 public:
  /// Many times the widest capsule, which may be far less wide than a unit.
  static constexpr float coarsest = 0x1p100f;

  SweptSphereGrid() = default;
  explicit SweptSphereGrid(const SweptSphereFrame& frame) : frame_(frame) {}

  const SweptSphereFrame& frame() const { return frame_; }
  const SweptSphereTable& table() const { return table_; }
  /// Bodies that are there.
  std::size_t size() const { return table_.bodies(); }
  /// No capsule is wider, on any axis, from the time on that it holds (in units of the frame).
  float widest() const { return widest_; }
  /// Empties the layer, for capsules of another frame.
  void clear(const SweptSphereFrame& frame);
  /// Edge of the cells, in widths of the largest capsule, a power of two: sorting doubles it where cells have
  /// held few, and the next time it is halved where they have held many.
  float coarseness() const { return coarseness_; }
  void set_coarseness(float coarseness) { coarseness_ = coarseness; }

  /// A capsule that holds from time `from` of the frame until 1. Returns its place.
  std::uint32_t add(std::uint32_t number, const SweptSphere& sphere, float from);
  /// How far another one for the same body, which holds from time `from` until 1, would stick out of its
  /// cell. Nothing if that is so far that searches would cost more.
  std::optional<float> looseness_at(std::uint32_t place, const SweptSphere& sphere, float from) const;
  /// How much more room capsules that have taken places need, and how many they are.
  struct Growth {
    float reach = 0.0f;
    float widest = 0.0f;
    std::uint64_t replaced = 0;
  };
  /// It takes the place. Several threads may do that at the same time, in different places; nothing may be
  /// searched before grow().
  void replace(std::uint32_t place, const SweptSphere& sphere, float from, float looseness, Growth& growth);
  void grow(const Growth& growth) {
    reach_ = std::max(reach_, growth.reach);
    widest_ = std::max(widest_, growth.widest);
  }
  /// Leaves a hole.
  void remove(std::uint32_t place) { table_.remove(place); }

  /// So many were added, or left holes, that searches will cost less once the layer is sorted.
  bool is_untidy() const {
    return table_.slots() - sorted_ > most_behind_ || table_.free_slots() > 64 + table_.slots() / 2;
  }
  /// Makes these all that there are, sorted by cells. They hold from time 0 of the frame until 1.
  /// moved(number, place) is told of each, by several threads. Cost: linear.
  template <class Moved>
  void fill(const UnsortedSweptSpheres& all, PoolLease& shift, Moved moved) {
    widest_ = arrange(all, shift);
    shift.parallel_for(table_.slots(), many, [&](std::size_t begin, std::size_t end, std::size_t) {
      for (auto place = static_cast<std::uint32_t>(begin); place < end; ++place)
        moved(table_.number_at(place), place);
    });
  }
  /// Sorts all by cells, and leaves no holes. Places change: moved(number, place) is told of each. Cost:
  /// linear.
  template <class Moved>
  void sort(PoolLease& shift, Moved moved) {
    arrange(table_.all(), shift);
    for (std::uint32_t place = 0; place < table_.slots(); ++place) moved(table_.number_at(place), place);
  }

  /// Adds a search for all that a capsule may touch during the query's span; it may find holes too.
  void add_search(const SweptSphereQuery& query, SweptSphereSearches& searches) const;
  /// The same among those behind the place of a capsule of this layer, which has to be sorted, from time 0 to
  /// 1: going through all places finds each pair once.
  void add_search_behind(std::uint32_t place, SweptSphereSearches& searches) const;
  /// Makes them.
  void make(SweptSphereSearches& searches) const { searches.make(table_.columns()); }

  /// Calls visit(box, number of capsules), in units of the frame, for each cell in which the middle of a
  /// capsule lies.
  template <class Visit>
  void for_each_cell(Visit visit) const {
    std::map<Grid::Cell, std::size_t> filled;
    for (std::uint32_t place = 0; place < table_.slots(); ++place)
      if (table_.number_at(place) != SweptSphereTable::nobody)
        ++filled[grid_.cell_around(float_aabb_of(table_.swept_sphere_at(place), 0.0f, 1.0f))];
    for (const auto& [cell, count] : filled) visit(grid_.box_of(cell), count);
  }
  /// How many are in a unit of volume (or of area, if `flat`), where there are any. Of a layer that was
  /// sorted.
  double density(bool flat) const;
  /// For one that was read.
  bool is_valid() const;

  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    auto& [frame, table, cells, starts, sorted, grid, reach, widest, most_behind, filled, coarseness] = self;
    archive(frame, table, cells, starts, sorted, grid, reach, widest, most_behind, filled, coarseness);
  }

 private:
  static constexpr std::uint32_t least_behind = 64;
  /// So many are worth the while of a thread.
  static constexpr std::size_t many = 1024;

  static SweptSphereSpread spread_of(const UnsortedSweptSpheres& all, PoolLease& shift);
  void choose_grid(const UnsortedSweptSpheres& all, const SweptSphereSpread& error,
                   std::vector<std::uint32_t>& cells, PoolLease& shift);
  void count_by_cells(const UnsortedSweptSpheres& all, std::vector<std::uint32_t>& cells, PoolLease& shift);
  std::uint32_t filled_cubes(PoolLease& shift) const;
  template <class Visit>
  void for_each_range(std::size_t spheres, PoolLease& shift, Visit visit) const;
  void choose_places(const std::vector<std::uint32_t>& cells, std::vector<std::uint32_t>& places,
                     PoolLease& shift);
  float arrange(const UnsortedSweptSpheres& all, PoolLease& shift);
  void add_runs(const SweptSphereQuery& query, std::uint32_t first_place,
                SweptSphereSearches& searches) const;

  SweptSphereFrame frame_;
  SweptSphereTable table_;
  std::vector<std::uint32_t> cells_;   ///< of the sorted ones, by place
  std::vector<std::uint32_t> starts_;  ///< the first place of each cell, and the end of the last one
  std::uint32_t sorted_ = 0;           ///< the first so many places
  Grid grid_;
  float reach_ = 0.0f;  ///< how far a sorted one sticks out of its cell, at most
  float widest_ = 0.0f;
  std::uint32_t most_behind_ = least_behind;
  std::uint32_t filled_ = 0;  ///< cubes that hold any
  float coarseness_ = 1.0f;
};

}  // namespace kinesphere
