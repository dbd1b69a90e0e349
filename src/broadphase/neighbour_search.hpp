// Searches for the neighbours of bodies in all layers, and in all images where space repeats.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "broadphase/broad_phase.hpp"

namespace kinesphere {

/// Two bodies.
struct BodyPair {
  std::uint32_t first;
  std::uint32_t second;
};

/// What a search finds is kept here, good until the next one. One for each thread: several may search the
/// same windows at the same time.
class NeighbourSearch {
 public:
  /// The bodies other than `number` whose registered capsule may touch, before their windows end, that which
  /// `number` would have from now until `end`. The list may be changed.
  std::vector<std::uint32_t>& near(const BroadPhase& windows, std::uint32_t number,
                                   const InflatedBound& bound, double now, double end);

  /// Pairs of one that has started, from the k-th of Windows::started() to before the last, and one that
  /// near() finds for it: going through all of them finds each pair of two of them once. bound_of(number) is
  /// asked where there are several layers, or space repeats.
  template <class BoundOf>
  std::span<const BodyPair> near_started(const BroadPhase& windows, std::size_t k, std::size_t last,
                                         double now, BoundOf bound_of) {
    constexpr std::size_t bodies_at_once = 16;
    pairs_.clear();
    const bool beyond_their_layer = has_several_images(windows);
    while (k < last) {
      const Started some = started_at(windows.levels(), k, std::min(last - k, bodies_at_once));
      search_behind(some);
      if (beyond_their_layer) {
        bounds_.clear();
        for (std::uint32_t place = some.slot; place < some.slot + some.count; ++place)
          bounds_.push_back(bound_of(some.own.spheres.table().number_at(place)));
        search_other_levels(windows, some, now);
      }
      k += some.count;
    }
    return pairs_;
  }

  /// The bodies whose capsules may reach into a box now, and perhaps some near it; where space repeats
  /// perhaps several times.
  std::span<const std::uint32_t> in_box(const BroadPhase& windows, const Box& box, double now);

 private:
  /// Some that have started, at successive places of a layer.
  struct Started {
    const GridLevel& own;
    std::uint32_t slot;
    std::uint32_t count;
  };
  /// A search for the k-th of some bodies, where it is or in another image.
  struct ImageSearch {
    std::uint32_t k;
    bool shifted;
  };

  static bool has_several_images(const BroadPhase& windows);
  static Started started_at(std::span<const GridLevel> layers, std::size_t k, std::size_t most);
  void search_behind(const Started& some);
  void search_other_levels(const BroadPhase& windows, const Started& some, double now);
  bool add_searches(const Space& space, const GridLevel& layer, std::uint32_t k, const InflatedBound& bound,
                    double now, double end);
  void clear_searches();

  SweptSphereSearches searches_;     ///< of one layer
  std::vector<ImageSearch> images_;  ///< for whom each of them is
  std::vector<InflatedBound> bounds_;
  std::vector<std::uint32_t> numbers_;
  std::vector<BodyPair> pairs_;
};

}  // namespace kinesphere
