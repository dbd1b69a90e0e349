// Sensor overlaps of each body.
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

/// Orders distances from large to small. NaN, which a damaged snapshot may contain, comes last.
inline bool is_farther(double a, double b) { return a > b || (std::isnan(b) && !std::isnan(a)); }

/// A partner that is within one sensor distance (length).
struct OverlapRecord {
  std::uint32_t partner;
  double distance;
  /// Direction of sensing as in the sensor_enter event; "first" is the body with the smaller index.
  Senses senses = Senses::neither;
  friend bool operator==(const OverlapRecord&, const OverlapRecord&) = default;
  /// Orders by partner, then by falling distance: the last record of a partner is the next one to be left.
  friend bool operator<(const OverlapRecord& a, const OverlapRecord& b) {
    return a.partner != b.partner ? a.partner < b.partner : is_farther(a.distance, b.distance);
  }
};

/// One sorted list of overlaps per body. A body that never had an overlap costs no memory, or 24 bytes if a
/// body with a larger number had one. A pair crosses its distances in order, so most changes are at the end
/// of a list; any other change costs O(list).
class OverlapRecords {
 public:
  using List = std::span<const OverlapRecord>;

  /// Returns the overlaps of a body. Invalidated when a list changes.
  List of(std::uint32_t body) const { return body < lists_.size() ? List(lists_[body]) : List(); }
  /// Returns the overlaps with one partner. Cost: O(log n) for a list of n, as for contains(), and the number
  /// of these.
  List of(std::uint32_t body, std::uint32_t partner) const {
    const List all = of(body);
    const auto begin = std::partition_point(all.begin(), all.end(),
                                            [=](const OverlapRecord& one) { return one.partner < partner; });
    auto end = begin;
    while (end != all.end() && end->partner == partner) ++end;
    return {begin, end};
  }
  bool contains(std::uint32_t body, const OverlapRecord& overlap) const {
    const List all = of(body);
    return std::binary_search(all.begin(), all.end(), overlap);
  }
  /// Number of lists; bodies with this number or a larger one have no overlaps.
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
  /// Allocates lists for this many bodies, so that adding an overlap does not reallocate the outer vector.
  void make_lists(std::size_t bodies) {
    if (lists_.size() < bodies) lists_.resize(bodies);
  }
  void clear(std::uint32_t body) {
    if (body < lists_.size()) lists_[body].clear();
  }

  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    archive(self.lists_);
    // Bytes that were read may hold records in any order.
    if constexpr (!std::is_const_v<Self> && !std::same_as<Archive, HeapCounter>)
      for (std::vector<OverlapRecord>& list : self.lists_) std::sort(list.begin(), list.end());
  }

 private:
  std::vector<std::vector<OverlapRecord>> lists_;
};

}  // namespace kinesphere
