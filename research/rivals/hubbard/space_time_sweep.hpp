// Three sweeps in step, one per axis: when do space-time bounds meet each other or a wall?
//
// Two bounds overlap where the intervals between their faces overlap on all three axes. Which do is read off
// the order of the faces alone, never off computed coordinates, so rounding cannot make the axes disagree;
// and as orders change by exchanges of neighbours only, the set of overlapping pairs follows at O(1) an
// exchange: during the sweep, and from one set of space-time bounds to the next.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kinesphere/vec3.hpp"
#include "research/rivals/hubbard/hypertrapezoid.hpp"
#include "research/rivals/hubbard/sweep.hpp"

namespace kinesphere {

class SpaceTimeSweep {
 public:
  /// Two bodies whose bounds meet; a body and itself: it meets a wall.
  struct Meeting {
    double time;
    std::uint32_t a;
    std::uint32_t b;
  };

  /// Bounds meet a wall of the box, if there is one, at this distance from it.
  SpaceTimeSweep(const std::optional<Box>& box, double wall_clearance);

  /// The body takes part from the next begin() on. O(1)
  void insert(std::uint32_t body);
  /// O(n)
  void erase(std::uint32_t body);
  bool contains(std::uint32_t body) const { return planes_[0].contains(lower_face(body)); }

  /// To be called for every body that takes part before each begin(). O(1)
  void set(std::uint32_t body, const Hypertrapezoid& bound);
  /// Orders the faces at time 0 and begins to sweep [0, duration]. O(n + exchanges) when the order is nearly
  /// that in which the last sweep ended.
  void begin(double duration);

  /// Pairs whose bounds overlap at the present time of the sweep. Such a pair, once it has parted, does not
  /// meet again in this sweep: the times at which two hypertrapezoids overlap are one interval.
  template <class Visit>
  void for_each_overlap(Visit&& visit) const {
    for (std::uint32_t a = 0; a < partners_.size(); ++a)
      for (const std::uint32_t b : partners_[a]) visit(a, b);
  }
  bool overlap(std::uint32_t a, std::uint32_t b) const;
  bool reaches_wall(std::uint32_t body) const;
  /// The body's space-time bound at a time of the interval.
  Box cross_section(std::uint32_t body, double time) const;

  /// Sweeps on to the next time at which two bounds, or a bound and a wall, meet that were apart. O(log n)
  /// for each crossing on the way. Never late: bounds have been widened by what rounding of times can hide.
  std::optional<Meeting> next_meeting();

  /// What is wrong with the orders or the set of overlapping pairs, if anything is. For audits. O(n^2)
  std::optional<std::string> fault() const;

 private:
  // The walls are lines 0 and 1 of each plane, the faces of body k lines 2 k + 2 and 2 k + 3.
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
  std::vector<std::vector<std::uint32_t>> partners_;  ///< overlapping ones of a larger number, by body
  double reach_ = 0.0;                                ///< largest coordinate that a bound set lately comes to
  double reach_speed_ = 0.0;
  double order_error_ = 0.0;
};

}  // namespace kinesphere
