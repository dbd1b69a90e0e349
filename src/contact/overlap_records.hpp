// Which sensor distances each body is within.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "kinesphere/event.hpp"

namespace kinesphere {

class HeapCounter;

/// The order of distances from the outermost inward. A damaged snapshot may hold some that are no numbers:
/// these are the last.
inline bool is_farther(double a, double b) { return a > b || (std::isnan(b) && !std::isnan(a)); }

/// A sensor distance within which a partner is.
struct OverlapRecord {
  std::uint32_t partner;
  double distance;
  /// As the sensor_enter told; "first" is the body with the smaller index.
  Senses senses = Senses::neither;

  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    auto& [whom, how_far, who_senses] = self;
    archive(whom, how_far, who_senses);
  }
  friend bool operator==(const OverlapRecord&, const OverlapRecord&) = default;
  /// By partner, and of each from the outermost distance inward: the last one is the next to be left.
  friend bool operator<(const OverlapRecord& a, const OverlapRecord& b) {
    return a.partner != b.partner ? a.partner < b.partner : is_farther(a.distance, b.distance);
  }
};

/// A sorted list for each body. A body that never had any costs nothing, or 24 bytes if one with a larger
/// number had. A pair crosses its distances one after the other, so most changes are made at the end of a
/// list; others move what comes after.
class OverlapRecords {
 public:
  using List = std::span<const OverlapRecord>;

  /// Good until a list changes.
  List of(std::uint32_t body) const { return body < lists_.size() ? List(lists_[body]) : List(); }
  /// Those with one partner. Cost: O(log of the list), as of contains().
  List of(std::uint32_t body, std::uint32_t partner) const {
    const List all = of(body);
    const auto begin = std::partition_point(all.begin(), all.end(),
                                            [=](const OverlapRecord& one) { return one.partner < partner; });
    const auto end = std::partition_point(begin, all.end(),
                                          [=](const OverlapRecord& one) { return one.partner == partner; });
    return {begin, end};
  }
  bool contains(std::uint32_t body, const OverlapRecord& overlap) const {
    const List all = of(body);
    return std::binary_search(all.begin(), all.end(), overlap);
  }
  /// All lists from this number on are empty.
  std::size_t size() const { return lists_.size(); }

  void add(std::uint32_t body, const OverlapRecord& overlap) {
    if (body >= lists_.size()) lists_.resize(body + std::size_t{1});
    std::vector<OverlapRecord>& list = lists_[body];
    list.insert(std::lower_bound(list.begin(), list.end(), overlap), overlap);
  }
  void erase(std::uint32_t body, const OverlapRecord& overlap) {
    if (!contains(body, overlap)) return;
    std::vector<OverlapRecord>& list = lists_[body];
    list.erase(std::lower_bound(list.begin(), list.end(), overlap));
  }
  void set(std::uint32_t body, const std::vector<OverlapRecord>& sorted) {
    if (body < lists_.size()) lists_[body] = sorted;
  }
  /// Of at least so many bodies, so that none has to be made later.
  void make_lists(std::size_t bodies) {
    if (lists_.size() < bodies) lists_.resize(bodies);
  }
  void clear(std::uint32_t body) {
    if (body < lists_.size()) lists_[body].clear();
  }

  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    archive(self.lists_);
    // Bytes that were read may have them in any order.
    if constexpr (!std::is_const_v<Self> && !std::same_as<Archive, HeapCounter>)
      for (std::vector<OverlapRecord>& list : self.lists_) std::sort(list.begin(), list.end());
  }

 private:
  std::vector<std::vector<OverlapRecord>> lists_;
};

}  // namespace kinesphere
