// A layer: capsules of about one size and one window, sorted by the cells of a grid so that a search reads
// whole rows of them at once.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "parallel/crew.hpp"
#include "window/capsule.hpp"
#include "window/capsule_search.hpp"

namespace kinesphere {

/// Each capsule has a place, which stays the same until the layer is sorted anew or cleared, and belongs to a
/// body. Those that were added since the layer was sorted are behind the others, and every search looks at
/// them. Where a grid over all of them would have too many cells, it is folded: cells count modulo its size.
class Layer {
 public:
  /// In place of the number of a body: nobody's.
  static constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();

  /// Many times the widest capsule, which may be far less wide than a unit.
  static constexpr float coarsest = 0x1p100f;

  /// Searches of one layer that are made at once: a processor works on several at the same time.
  struct Searches {
    std::vector<CapsuleQuery> queries;
    std::vector<Run> runs;
    std::vector<std::uint64_t> words;  ///< what they have found

    void clear() {
      queries.clear();
      runs.clear();
    }
    /// Calls visit(query, place).
    template <class Visit>
    void for_each_found(Visit visit) const {
      for_each_near(runs, words.data(), visit);
    }
  };

  Layer() = default;
  explicit Layer(const CapsuleFrame& frame) : frame_(frame) {}

  const CapsuleFrame& frame() const { return frame_; }
  /// Empties the layer, for capsules of another frame.
  void clear(const CapsuleFrame& frame);
  /// Edge of the cells, in widths of the largest capsule, a power of two: sorting doubles it where cells have
  /// held few, and the next time it is halved where they have held many.
  float coarseness() const { return coarseness_; }
  void set_coarseness(float coarseness) { coarseness_ = coarseness; }
  /// Places are less than this.
  std::size_t places() const { return numbers_.size(); }
  /// Bodies that are there.
  std::size_t size() const { return numbers_.size() - holes_; }
  std::uint32_t number_at(std::uint32_t place) const { return numbers_[place]; }
  /// No capsule is wider, on any axis, from the time on that it holds (in units of the frame).
  float widest() const { return widest_; }
  Capsule capsule_at(std::uint32_t place) const;

  /// A capsule that holds from time `from` of the frame until 1. Returns its place.
  std::uint32_t add(std::uint32_t number, const Capsule& capsule, float from);
  /// How far another one for the same body, which holds from time `from` until 1, would stick out of its
  /// cell. Nothing if that is so far that searches would cost more.
  std::optional<float> overhang_at(std::uint32_t place, const Capsule& capsule, float from) const;
  /// How much more room capsules that have taken places need, and how many they are.
  struct Growth {
    float reach = 0.0f;
    float widest = 0.0f;
    std::uint64_t replaced = 0;
  };
  /// It takes the place. Several threads may do that at the same time, in different places; nothing may be
  /// searched before grow().
  void replace(std::uint32_t place, const Capsule& capsule, float from, float overhang, Growth& growth);
  void grow(const Growth& growth) {
    reach_ = std::max(reach_, growth.reach);
    widest_ = std::max(widest_, growth.widest);
  }
  /// Leaves a hole.
  void remove(std::uint32_t place);

  /// So many were added, or left holes, that searches will cost less once the layer is sorted.
  bool is_untidy() const {
    return numbers_.size() - sorted_ > most_behind_ || holes_ > 64 + numbers_.size() / 2;
  }
  /// Capsules in no order, each of a body.
  struct Unsorted {
    std::vector<std::uint32_t> numbers;
    std::vector<Capsule> capsules;

    explicit Unsorted(std::size_t size = 0) : numbers(size), capsules(size) {}
  };
  /// Makes these all that there are, sorted by cells. They hold from time 0 of the frame until 1.
  /// moved(number, place) is told of each, by several threads. Cost: linear.
  template <class Moved>
  void fill(const Unsorted& all, Shift& shift, Moved moved) {
    widest_ = arrange(all, shift);
    shift.for_each(numbers_.size(), many, [&](std::size_t begin, std::size_t end, std::size_t) {
      for (std::size_t place = begin; place < end; ++place)
        moved(numbers_[place], static_cast<std::uint32_t>(place));
    });
  }
  /// Sorts all by cells, and leaves no holes. Places change: moved(number, place) is told of each. Cost:
  /// linear.
  template <class Moved>
  void sort(Moved moved) {
    Shift alone;
    sort(alone, moved);
  }
  template <class Moved>
  void sort(Shift& shift, Moved moved) {
    arrange(without_holes(), shift);
    for (std::uint32_t place = 0; place < numbers_.size(); ++place) moved(numbers_[place], place);
  }

  /// Adds a search for all that a capsule may touch during the query's span; it may find holes too.
  void add_search(const CapsuleQuery& query, Searches& searches) const;
  /// The same among those behind the place of a capsule of this layer, which has to be sorted, from time 0 to
  /// 1: going through all places finds each pair once.
  void add_search_behind(std::uint32_t place, Searches& searches) const;
  /// Makes them.
  void make(Searches& searches) const;

  /// Calls visit(lower corner, upper corner, number of capsules), in units of the frame, for each cell in
  /// which the middle of a capsule lies.
  template <class Visit>
  void for_each_cell(Visit visit) const {
    std::map<Cell, std::size_t> filled;
    for (std::uint32_t place = 0; place < numbers_.size(); ++place)
      if (numbers_[place] != nobody) ++filled[grid_.cell_around(corners_at(place))];
    for (const auto& [cell, count] : filled) {
      Vec3 lower, upper;
      for (int axis = 0; axis < 3; ++axis) {
        const auto k = static_cast<std::size_t>(axis);
        lower[axis] = double(cell[k]) * double(grid_.edge[k]);
        upper[axis] = (double(cell[k]) + 1.0) * double(grid_.edge[k]);
      }
      visit(lower, upper, count);
    }
  }
  /// How many are in a unit of volume (or of area, if `flat`), where there are any. Of a layer that was
  /// sorted.
  double density(bool flat) const;
  std::size_t bytes() const;
  /// For one that was read.
  bool is_sound() const;

  template <class Self, class Archive>
  static void transfer(Self& self, Archive& archive) {
    auto& [frame, columns, numbers, cells, starts, sorted, holes, grid, reach, widest, most_behind, filled,
           coarseness] = self;
    archive(frame, columns, numbers, cells, starts, sorted, holes, grid, reach, widest, most_behind, filled,
            coarseness);
  }

 private:
  static constexpr std::uint32_t least_behind = 64;
  /// So many are worth the while of a thread.
  static constexpr std::size_t many = 1024;
  using Point = std::array<float, 3>;
  struct Corners {
    Point lower;
    Point upper;
  };
  using Cell = std::array<std::int32_t, 3>;
  /// Those with coordinates in [i, i + 1) times the edge are cell i of an axis. Where the axis is folded, it
  /// shares its capsules with all cells i + k count; else all are in `count` cells from the first on. Cells
  /// are cubes cut into slices along x: rows of cells are read as a whole, so that thin slices cost nothing,
  /// and less is read of rows that are not needed as a whole.
  struct Grid {
    static constexpr int slices = 4;
    Point edge{1.0f, 1.0f, 1.0f};
    Point per_edge{1.0f, 1.0f, 1.0f};
    Cell first{};
    Cell count{1, 1, 1};
    std::array<bool, 3> folded{};

    std::int32_t cell_of(float coordinate, std::size_t axis) const;
    std::int32_t wrapped(std::int32_t cell, std::size_t axis) const;
    Cell cell_around(const Corners& corners) const;
    std::uint32_t index_of(const Cell& cell) const;
    Cell cell_at(std::uint32_t index) const;
    bool is_sound() const;
    template <class Self, class Archive>
    static void transfer(Self& self, Archive& archive) {
      auto& [edge, per_edge, first, count, folded] = self;
      archive(edge, per_edge, first, count, folded);
    }
  };

  static Corners corners_of(const Capsule& capsule, float from, float to);
  static float width_of(const Corners& corners);
  Corners corners_at(std::uint32_t place) const;
  CapsuleColumns columns() const;
  void store(std::uint32_t place, const Capsule& capsule);
  struct Spread;
  static Spread spread_of(const Unsorted& all, Shift& shift);
  void choose_grid(const Spread& spread, std::size_t size);
  std::size_t cell_count() const {
    return std::size_t(grid_.count[0]) * std::size_t(grid_.count[1]) * std::size_t(grid_.count[2]);
  }
  void count_by_cells(const Unsorted& all, std::vector<std::uint32_t>& cells, Shift& shift);
  std::uint32_t filled_cubes(Shift& shift) const;
  template <class Visit>
  void for_each_range(std::size_t capsules, Shift& shift, Visit visit) const;
  void choose_places(const std::vector<std::uint32_t>& cells, std::vector<std::uint32_t>& places,
                     Shift& shift);
  Unsorted without_holes() const;
  float arrange(const Unsorted& all, Shift& shift);
  float overhang(const Cell& cell, const Corners& corners) const;
  Cell nearest_image(std::uint32_t cell, const Cell& of) const;
  void add_runs(const CapsuleQuery& query, std::uint32_t first_cell, std::uint32_t first_place,
                Searches& searches) const;

  CapsuleFrame frame_;
  std::array<std::vector<float>, 7> columns_;  ///< with room behind the last one for a search to read
  std::vector<std::uint32_t> numbers_;
  std::vector<std::uint32_t> cells_;   ///< of the sorted ones
  std::vector<std::uint32_t> starts_;  ///< by cell, and the end of the last one
  std::uint32_t sorted_ = 0;
  std::uint32_t holes_ = 0;
  Grid grid_;
  float reach_ = 0.0f;  ///< how far a sorted one sticks out of its cell, at most
  float widest_ = 0.0f;
  std::uint32_t most_behind_ = least_behind;
  std::uint32_t filled_ = 0;  ///< cubes that hold any
  float coarseness_ = 1.0f;
};

}  // namespace kinesphere
