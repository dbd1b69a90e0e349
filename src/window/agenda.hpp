// The agenda: which pairs are to be looked at before a window ends, and when.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <tuple>
#include <vector>

#include "number/infinity.hpp"

namespace kinesphere {

/// Two bodies about which nothing changes before `time`, or a body and the walls or its window. It is void
/// once one of the two has another stamp.
struct HotPair {
  /// In place of the second body: the walls.
  static constexpr std::uint32_t walls = std::numeric_limits<std::uint32_t>::max();
  /// In place of the second body: the end of a window that the first one has for itself.
  static constexpr std::uint32_t renewal = walls - 1;
  bool has_second() const { return second < renewal; }

  double time = 0.0;
  std::uint32_t first = 0;
  std::uint32_t second = walls;
  std::uint32_t first_stamp = 0;
  std::uint32_t second_stamp = 0;

  friend bool operator<(const HotPair& a, const HotPair& b) {
    if (a.time != b.time) return a.time < b.time;
    return a.first != b.first ? a.first < b.first : a.second < b.second;
  }
  template <class Self, class Archive>
  static void transfer(Self& self, Archive& archive) {
    auto& [when, one, other, stamp_of_one, stamp_of_other] = self;
    archive(when, one, other, stamp_of_one, stamp_of_other);
  }
};

/// The order of hot pairs that are due at the same time is that of their bodies: by their numbers or, where
/// bodies have names, by these.
class HotPairOrder {
 public:
  HotPairOrder() = default;
  /// Names by number, which must outlive this.
  explicit HotPairOrder(const std::vector<std::uint32_t>& names) : names_(&names) {}

  bool operator()(const HotPair& a, const HotPair& b) const {
    if (names_ == nullptr || a.time != b.time) return a < b;
    return a.first != b.first ? of(a.first) < of(b.first) : of(a.second) < of(b.second);
  }

 private:
  std::uint32_t of(std::uint32_t number) const {
    return number < HotPair::renewal ? (*names_)[number] : number;
  }

  const std::vector<std::uint32_t>* names_ = nullptr;
};

/// In the order of their times, then of their bodies. Most pairs become void before they are due, so those
/// that are not due soon are kept in slices of time, in no order; a slice is sorted when it begins, without
/// those that have become void. Cost: O(1) for each pair and, for those that come to be due, O(log of the
/// size of a slice).
class Agenda {
 public:
  /// Of an agenda that is empty.
  void order_by(const HotPairOrder& order) { order_ = order; }
  const HotPairOrder& order() const { return order_; }
  std::size_t size() const { return (sorted_.size() - next_) + heap_.size() + waiting_; }
  /// Needed before next_time() and first(), after each change: goes on to the next slice that holds a pair,
  /// if nothing is left of this one.
  template <class IsVoid>
  void open(IsVoid is_void) {
    while (next_ == sorted_.size() && heap_.empty() && waiting_ > 0) begin_slice(is_void);
  }
  /// +infinity when nothing is due.
  double next_time() const {
    const double of_sorted = next_ < sorted_.size() ? sorted_[next_].time : infinity;
    return heap_.empty() ? of_sorted : std::min(of_sorted, heap_.front().time);
  }
  /// Needs that there is one.
  const HotPair& first() const { return heap_comes_first() ? heap_.front() : sorted_[next_]; }
  void drop_first();
  void add(const HotPair& pair);
  /// All of them, in any order. Leaves `pairs` empty.
  void add_all(std::vector<HotPair>& pairs);

  void clear();
  /// Moves those that come before `end`, and no later than `last`, to `pairs`, but of different times no more
  /// than `most`. Returns when the next one comes, at `end` or before.
  template <class IsVoid>
  double take_until(double last, double end, std::size_t most, std::vector<HotPair>& pairs, IsVoid is_void) {
    for (;;) {
      open(is_void);
      const double next = next_time();
      if (!(next <= last && next < end)) return end;
      if (pairs.size() >= most && pairs.back().time < next) return next;
      if (!is_void(first())) pairs.push_back(first());
      drop_first();
    }
  }

  /// Void ones too.
  template <class Visit>
  void for_each(Visit visit) const {
    std::for_each(sorted_.begin() + static_cast<std::ptrdiff_t>(next_), sorted_.end(), visit);
    std::for_each(heap_.begin(), heap_.end(), visit);
    for (const std::uint32_t head : heads_)
      for (std::uint32_t at = head; at != none; at = nodes_[at].next) visit(nodes_[at].pair);
  }

  std::size_t bytes() const {
    return (sorted_.capacity() + heap_.capacity()) * sizeof(HotPair) + nodes_.capacity() * sizeof(Node) +
           heads_.capacity() * sizeof(std::uint32_t);
  }

 private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  struct Node {
    HotPair pair;
    std::uint32_t next;  ///< of its slice, or of those that are free
  };

  bool heap_comes_first() const {
    return !heap_.empty() && (next_ == sorted_.size() || order_(heap_.front(), sorted_[next_]));
  }
  std::size_t slice_of(double time) const;
  void wait(const HotPair& pair);
  void divide(double first, double last, std::size_t pairs);

  template <class IsVoid>
  void begin_slice(IsVoid is_void) {
    sorted_.clear();
    next_ = 0;
    while (heads_[++slice_] == none) continue;
    for (std::uint32_t at = heads_[slice_]; at != none;) {
      Node& node = nodes_[at];
      if (!is_void(node.pair)) sorted_.push_back(node.pair);
      const std::uint32_t next = node.next;
      node.next = free_;
      free_ = at;
      at = next;
      --waiting_;
    }
    heads_[slice_] = none;
    std::sort(sorted_.begin(), sorted_.end(), order_);
  }

  HotPairOrder order_;
  std::vector<HotPair> sorted_;  ///< of the present slice
  std::size_t next_ = 0;
  std::vector<HotPair> heap_;  ///< that have been added to it since
  // Of the slices that come.
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> heads_;
  std::uint32_t free_ = none;
  std::size_t waiting_ = 0;
  std::size_t slice_ = 0;  ///< the present one
  double begin_ = 0.0;     ///< of slice 0
  double per_time_ = 0.0;
};

/// The times of hot pairs, found by their bodies.
class PairTimes {
 public:
  explicit PairTimes(std::vector<HotPair> pairs);
  /// The first one of the pair; the second may be HotPair::walls. +infinity where there is none.
  double of(std::uint32_t a, std::uint32_t b) const;
  /// By their bodies.
  const std::vector<HotPair>& pairs() const { return pairs_; }

 private:
  std::vector<HotPair> pairs_;
};

}  // namespace kinesphere
