// Three sweeps in step, one per axis, which find the meetings of space-time bounds with each other and with
// walls.
//
// Two bounds overlap if the intervals between their faces overlap on all three axes. That is read off the
// order of the faces alone, never off computed coordinates, so rounding cannot make the axes disagree. As
// orders change by exchanges of neighbours only, the set of overlapping pairs is kept up to date at O(1) an
// exchange: during the sweep, and from one set of space-time bounds to the next.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "kinesphere/vec3.hpp"
#include "research/rivals/hubbard/hypertrapezoid.hpp"
#include "research/rivals/hubbard/sweep.hpp"

namespace kinesphere {

/// The sweep over time through the space-time bounds of all bodies.
class SpaceTimeSweep {
 public:
  /// A meeting of two bodies' bounds; of a body and a wall if a == b.
  struct Meeting {
    double time;
    std::uint32_t a;
    std::uint32_t b;
  };

  /// Bounds meet a wall of the box, if there is one, at the distance `wall_clearance` (length) from it.
  SpaceTimeSweep(const std::optional<Box>& box, double wall_clearance);

  /// Adds the body to the sweep from the next begin() on. Cost: O(1).
  void insert(std::uint32_t body);
  /// Removes the body. Cost: O(n).
  void erase(std::uint32_t body);
  bool contains(std::uint32_t body) const { return planes_[0].contains(lower_face(body)); }

  /// Sets the bound of a body. It has to be called for every body in the sweep before each begin(). Cost:
  /// O(1).
  void set(std::uint32_t body, const Hypertrapezoid& bound);
  /// Orders the faces at time 0 and begins to sweep [0, duration]. Cost: O(n + exchanges) if the order is
  /// nearly that in which the last sweep ended.
  void begin(double duration);

  /// Calls visit(a, b) for the pairs with bounds that overlap at the present time of the sweep. Such a pair,
  /// once it has parted, does not meet again in this sweep: the times at which two hypertrapezoids overlap
  /// are one interval.
  template <class Visit>
  void for_each_overlap(Visit&& visit) const {
    for (std::uint32_t a = 0; a < partners_.size(); ++a)
      for (const std::uint32_t b : partners_[a]) visit(a, b);
  }
  bool overlap(std::uint32_t a, std::uint32_t b) const;
  bool reaches_wall(std::uint32_t body) const;

  /// Sweeps on to the next time at which two bounds, or a bound and a wall, meet that were apart; nothing if
  /// there is none left. Never late: bounds are widened by what rounding of times can hide. Cost: O(log n)
  /// for each crossing on the way.
  std::optional<Meeting> next_meeting();

 private:
  // Lines 0 and 1 of each plane are the walls, lines 2 k + 2 and 2 k + 3 the faces of body k.
  static constexpr std::uint32_t lower_wall = 0, upper_wall = 1;
  static constexpr std::uint32_t lower_face(std::uint32_t body) { return 2 * body + 2; }
  static constexpr std::uint32_t upper_face(std::uint32_t body) { return 2 * body + 3; }
  static constexpr std::uint32_t body_of(std::uint32_t line) { return line / 2 - 1; }
  static constexpr bool is_wall(std::uint32_t line) { return line < 2; }
  static constexpr bool is_lower(std::uint32_t line) { return line % 2 == 0; }

  void set_walls();
  void widen(double margin);
  bool overlaps_on(std::size_t axis, std::uint32_t a, std::uint32_t b) const;
  bool overlaps_now(std::uint32_t a, std::uint32_t b) const;
  bool exchanged(std::uint32_t below, std::uint32_t above);
  void remove_overlap(std::uint32_t a, std::uint32_t b);

  std::optional<Box> box_;
  double wall_clearance_;
  std::array<Sweep, 3> planes_;
  std::vector<std::vector<std::uint32_t>> partners_;  ///< by body: overlapping bodies of a larger number
  double reach_ = 0.0;  ///< largest coordinate that a recently set bound reaches
  double reach_speed_ = 0.0;
  double order_error_ = 0.0;
};

}  // namespace kinesphere
