// Searches for the neighbours of bodies in all grid levels and, where space repeats, in all images.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "broadphase/broad_phase.hpp"

namespace kinesphere {

/// Numbers of two different bodies.
struct BodyPair {
  std::uint32_t first;
  std::uint32_t second;
};

/// A search for neighbours, with its buffers. Results stay valid until the object's next search. Thread
/// safety: use one object per thread; several objects may search one BroadPhase concurrently.
class NeighbourSearch {
 public:
  /// Returns the bodies other than `number` whose registered swept sphere may touch, before the window of
  /// either ends, the swept sphere that `number` would have from `now` until `end`. The caller may change the
  /// list.
  std::vector<std::uint32_t>& near(const BroadPhase& windows, std::uint32_t number,
                                   const InflatedBound& bound, double now, double end);

  /// Returns near() for a body that has just entered its window with this bound (BroadPhase::enter), until
  /// that window ends. Cost: its swept sphere in its own grid level is not computed again.
  std::vector<std::uint32_t>& near_entered(const BroadPhase& windows, std::uint32_t number,
                                           const InflatedBound& bound, double now);

  /// Returns the pairs of a started body, in a slot k <= slot < last below BroadPhase::started_slots(), and a
  /// body that near() finds for it. Calls for all slots together yield each pair of two started bodies
  /// once. bound_of(number) is called only if there are several grid levels or space repeats. `now` may be
  /// later than the start; then pairs are found that may touch from `now` on. Of bodies that have entered
  /// since the start, some are found.
  template <class BoundOf>
  std::span<const BodyPair> near_started(const BroadPhase& windows, std::size_t k, std::size_t last,
                                         double now, BoundOf bound_of) {
    constexpr std::size_t bodies_at_once = 16;
    pairs_.clear();
    const bool beyond_their_level = has_several_images(windows);
    while (k < last) {
      const Started some = started_at(windows.levels(), k, std::min(last - k, bodies_at_once));
      search_behind(some, now);
      if (beyond_their_level) {
        bounds_.clear();
        for (std::uint32_t one = 0; one < some.count; ++one)
          bounds_.push_back(some.is_free(one) ? std::nullopt : std::optional(bound_of(some.number_at(one))));
        search_other_levels(windows, some, now);
      }
      k += some.count;
    }
    return pairs_;
  }

  /// Returns the bodies whose swept spheres may reach into a box at `now`, perhaps with some near the box.
  /// Where space repeats, a body may occur several times.
  std::span<const std::uint32_t> in_box(const BroadPhase& windows, const Box& box, double now);

 private:
  /// Started bodies at successive slots of a grid level.
  struct Started {
    const GridLevel& own;
    std::uint32_t slot;
    std::uint32_t count;

    std::uint32_t number_at(std::uint32_t k) const { return own.spheres.table().number_at(slot + k); }
    bool is_free(std::uint32_t k) const { return number_at(k) == SweptSphereTable::free_slot; }
  };

  static bool has_several_images(const BroadPhase& windows);
  static Started started_at(std::span<const GridLevel> levels, std::size_t k, std::size_t most);
  void search_behind(const Started& some, double now);
  void search_other_levels(const BroadPhase& windows, const Started& some, double now);
  void search_level(const Space& space, const GridLevel& level, std::uint32_t number,
                    const InflatedBound& bound, double now, double end, const SweptSphere* entered);

  SweptSphereSearches searches_;                      ///< queries for one grid level
  std::vector<std::uint32_t> searching_;              ///< index in its batch of the body of each query
  std::vector<std::optional<InflatedBound>> bounds_;  ///< of each body of a batch; none for a free slot
  std::vector<std::uint32_t> numbers_;
  std::vector<BodyPair> pairs_;
};

}  // namespace kinesphere
