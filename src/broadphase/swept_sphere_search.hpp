// The inner loop of every search: which swept spheres of a table may come near a given one.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "broadphase/swept_sphere.hpp"

namespace kinesphere {

/// The slots begin <= k < end of a table, and the index of the query for which they are searched.
struct SlotRange {
  std::uint32_t begin;
  std::uint32_t end;
  std::uint32_t query = 0;
};

/// Seven columns of one length: the centres, velocities and radii of swept spheres of one frame. Precondition
/// of a search: `search_lanes` numbers behind the last slot can be read, since that many are tested at a
/// time.
using SweptSphereColumns = std::array<const float*, 7>;
inline constexpr std::size_t search_lanes = 16;

/// The result of a search in a slot range has a bit for each slot, 64 to a word, from the range's begin on.
inline constexpr std::uint32_t slots_in_a_word = 64;
inline std::size_t words_for(const SlotRange& range) {
  return (std::size_t{range.end} - range.begin + slots_in_a_word - 1) / slots_in_a_word;
}

namespace swept_sphere_search {
/// Added to squares, because the squares of small numbers underflow.
inline constexpr float least_square = 0x1p-100f;
}  // namespace swept_sphere_search

/// A swept sphere and the span of time, from <= to, in which it is compared; each in the frame of the table.
struct SweptSphereQuery {
  SweptSphere sphere;
  float from;
  float to;
};

/// Writes the words of all ranges, one range after the other. A bit is set if the swept sphere at that slot
/// may touch the swept sphere of the range's query during its span. Every swept sphere that touches it is
/// found, if speeds are within the limits of swept_sphere_of(). Results are equal to the bit on all
/// processors. near_swept_spheres() uses the best vectors of the processor (Google Highway);
/// near_swept_spheres_plain() uses none.
void near_swept_spheres(const SweptSphereColumns& table, std::span<const SweptSphereQuery> queries,
                        std::span<const SlotRange> ranges, std::uint64_t* words);
void near_swept_spheres_plain(const SweptSphereColumns& table, std::span<const SweptSphereQuery> queries,
                              std::span<const SlotRange> ranges, std::uint64_t* words);

/// Calls visit(query, slot) for each bit that is set.
template <class Visit>
void for_each_near(std::span<const SlotRange> ranges, const std::uint64_t* words, Visit visit) {
  for (const SlotRange& range : ranges)
    for (std::uint32_t first = range.begin; first < range.end; first += slots_in_a_word)
      for (std::uint64_t bits = *words++; bits != 0; bits &= bits - 1)
        visit(range.query, first + static_cast<std::uint32_t>(std::countr_zero(bits)));
}

/// Searches of one table that run together, so that the processor works on several at a time.
struct SweptSphereSearches {
  std::vector<SweptSphereQuery> queries;
  std::vector<SlotRange> ranges;
  std::vector<std::uint64_t> words;  ///< results, one bit per slot of `ranges`

  void clear() {
    queries.clear();
    ranges.clear();
  }
  void make(const SweptSphereColumns& table) {
    std::size_t all = 0;
    for (const SlotRange& range : ranges) all += words_for(range);
    if (words.size() < all) words.resize(all);
    near_swept_spheres(table, queries, ranges, words.data());
  }
  /// Calls visit(query, slot) for each swept sphere found.
  template <class Visit>
  void for_each_found(Visit visit) const {
    for_each_near(ranges, words.data(), visit);
  }
};

}  // namespace kinesphere
