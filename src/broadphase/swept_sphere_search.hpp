// Which capsules of a table may come near a given one? The inner loop of every search.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "broadphase/swept_sphere.hpp"

namespace kinesphere {

/// A piece of a table, places begin <= k < end, and which query it is searched for.
struct SlotRange {
  std::uint32_t begin;
  std::uint32_t end;
  std::uint32_t query = 0;
};

/// Seven columns of one length: the centres, velocities and radii of capsules of one frame. Behind the last
/// one there must be room to read `capsule_lanes` numbers, as many as are looked at at a time.
using SweptSphereColumns = std::array<const float*, 7>;
inline constexpr std::size_t search_lanes = 16;

/// What a search finds in a run: a bit for each place, 64 to a word, from the run's begin on.
inline constexpr std::uint32_t slots_in_a_word = 64;
inline std::size_t words_for(const SlotRange& run) {
  return (std::size_t{run.end} - run.begin + slots_in_a_word - 1) / slots_in_a_word;
}

namespace swept_sphere_search {
/// What is added to squares, as those of small numbers are lost.
inline constexpr float least_square = 0x1p-100f;
}  // namespace swept_sphere_search

/// A capsule, and a span of time in which to look at it, from <= to, both in the frame of the table.
struct SweptSphereQuery {
  SweptSphere sphere;
  float from;
  float to;
};

/// Writes the words of all runs, one run after the other: a bit is set if the capsule at that place may touch
/// the capsule of the run's query during its span. Every capsule that does touch it is among them, if speeds
/// are as capsule_of() lets them be. The same on all processors, to the bit: the best vectors of this one are
/// used (Google Highway), and near_swept_spheres_plain() is the same without.
void near_swept_spheres(const SweptSphereColumns& table, std::span<const SweptSphereQuery> queries,
                        std::span<const SlotRange> runs, std::uint64_t* words);
void near_swept_spheres_plain(const SweptSphereColumns& table, std::span<const SweptSphereQuery> queries,
                              std::span<const SlotRange> runs, std::uint64_t* words);

/// Calls visit(query, place) for each bit that is set.
template <class Visit>
void for_each_near(std::span<const SlotRange> runs, const std::uint64_t* words, Visit visit) {
  for (const SlotRange& run : runs)
    for (std::uint32_t first = run.begin; first < run.end; first += slots_in_a_word)
      for (std::uint64_t bits = *words++; bits != 0; bits &= bits - 1)
        visit(run.query, first + static_cast<std::uint32_t>(std::countr_zero(bits)));
}

/// Searches of one table that are made at once: a processor works on several at the same time.
struct SweptSphereSearches {
  std::vector<SweptSphereQuery> queries;
  std::vector<SlotRange> runs;
  std::vector<std::uint64_t> words;  ///< what they have found

  void clear() {
    queries.clear();
    runs.clear();
  }
  void make(const SweptSphereColumns& table) {
    std::size_t all = 0;
    for (const SlotRange& run : runs) all += words_for(run);
    if (words.size() < all) words.resize(all);
    near_swept_spheres(table, queries, runs, words.data());
  }
  /// Calls visit(query, place).
  template <class Visit>
  void for_each_found(Visit visit) const {
    for_each_near(runs, words.data(), visit);
  }
};

}  // namespace kinesphere
