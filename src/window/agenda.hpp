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

/// Two bodies about which nothing changes before `time`, or a body and the walls. It is void once one of the
/// two has another stamp.
struct HotPair {
  /// In place of the second body: the walls.
  static constexpr std::uint32_t walls = std::numeric_limits<std::uint32_t>::max();

  double time = 0.0;
  std::uint32_t first = 0;
  std::uint32_t second = walls;
  std::uint32_t first_stamp = 0;
  std::uint32_t second_stamp = 0;

  friend bool operator<(const HotPair& a, const HotPair& b) {
    return std::tie(a.time, a.first, a.second) < std::tie(b.time, b.first, b.second);
  }
  template <class Self, class Archive>
  static void transfer(Self& self, Archive& archive) {
    auto& [when, one, other, stamp_of_one, stamp_of_other] = self;
    archive(when, one, other, stamp_of_one, stamp_of_other);
  }
};

/// In the order of their times, then of their numbers. Many that come at once are sorted once; single ones
/// wait in a heap.
class Agenda {
 public:
  bool empty() const { return next_ == sorted_.size() && heap_.empty(); }
  std::size_t size() const { return sorted_.size() - next_ + heap_.size(); }
  /// +infinity when nothing is due.
  double next_time() const { return empty() ? infinity : first().time; }
  /// Needs that there is one.
  const HotPair& first() const { return heap_comes_first() ? heap_.front() : sorted_[next_]; }
  void drop_first();
  void add(const HotPair& pair);
  /// All of them, in any order. Leaves `pairs` empty.
  void add_all(std::vector<HotPair>& pairs);

  template <class Visit>
  void for_each(Visit visit) const {
    std::for_each(sorted_.begin() + static_cast<std::ptrdiff_t>(next_), sorted_.end(), visit);
    std::for_each(heap_.begin(), heap_.end(), visit);
  }

  template <class Self, class Archive>
  static void transfer(Self& self, Archive& archive) {
    auto& [sorted, next, heap] = self;
    archive(sorted, next, heap);
  }
  /// For one that was read.
  bool is_sound() const;

 private:
  bool heap_comes_first() const {
    return !heap_.empty() && (next_ == sorted_.size() || heap_.front() < sorted_[next_]);
  }

  std::vector<HotPair> sorted_;
  std::size_t next_ = 0;
  std::vector<HotPair> heap_;
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
