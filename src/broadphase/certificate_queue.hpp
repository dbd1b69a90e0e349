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
struct PairCertificate {
  /// In place of the second body: the walls.
  static constexpr std::uint32_t walls = std::numeric_limits<std::uint32_t>::max();
  /// In place of the second body: the end of a window that the first one has for itself.
  static constexpr std::uint32_t window_end = walls - 1;
  bool has_second() const { return second < window_end; }

  double failure_time = 0.0;
  std::uint32_t first = 0;
  std::uint32_t second = walls;
  std::uint32_t first_revision = 0;
  std::uint32_t second_revision = 0;

  friend bool operator<(const PairCertificate& a, const PairCertificate& b) {
    if (a.failure_time != b.failure_time) return a.failure_time < b.failure_time;
    return a.first != b.first ? a.first < b.first : a.second < b.second;
  }
  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    auto& [when, one, other, stamp_of_one, stamp_of_other] = self;
    archive(when, one, other, stamp_of_one, stamp_of_other);
  }
};

/// The order of hot pairs that are due at the same time is that of their bodies: by their numbers or, where
/// bodies have names, by these.
class CertificateOrder {
 public:
  CertificateOrder() = default;
  /// Names by number, which must outlive this.
  explicit CertificateOrder(const std::vector<std::uint32_t>& names) : names_(&names) {}

  bool operator()(const PairCertificate& a, const PairCertificate& b) const {
    if (names_ == nullptr || a.failure_time != b.failure_time) return a < b;
    return a.first != b.first ? of(a.first) < of(b.first) : of(a.second) < of(b.second);
  }

 private:
  std::uint32_t of(std::uint32_t number) const {
    return number < PairCertificate::window_end ? (*names_)[number] : number;
  }

  const std::vector<std::uint32_t>* names_ = nullptr;
};

/// In the order of their times, then of their bodies. Most pairs become void before they are due, so those
/// that are not due soon are kept in slices of time, in no order; a slice is sorted when it begins, without
/// those that have become void. Cost: O(1) for each pair and, for those that come to be due, O(log of the
/// size of a slice).
class CertificateQueue {
 public:
  /// Of an agenda that is empty.
  void order_by(const CertificateOrder& order) { order_ = order; }
  const CertificateOrder& order() const { return order_; }
  std::size_t size() const { return (sorted_.size() - next_) + heap_.size() + waiting_; }
  /// Needed before next_time() and first(), after each change: goes on to the next slice that holds a pair,
  /// if nothing is left of this one.
  template <class IsVoid>
  void open(IsVoid is_void) {
    while (next_ == sorted_.size() && heap_.empty() && waiting_ > 0) begin_bucket(is_void);
  }
  /// +infinity when nothing is due.
  double next_time() const {
    const double of_sorted = next_ < sorted_.size() ? sorted_[next_].failure_time : infinity;
    return heap_.empty() ? of_sorted : std::min(of_sorted, heap_.front().failure_time);
  }
  /// Needs that there is one.
  const PairCertificate& first() const { return heap_comes_first() ? heap_.front() : sorted_[next_]; }
  void drop_first();
  void add(const PairCertificate& pair);
  /// All of them, in any order. Leaves `pairs` empty.
  void add_all(std::vector<PairCertificate>& pairs);

  void clear();
  /// Moves those that come before `end`, and no later than `last`, to `pairs`, but of different times no more
  /// than `most`. Returns when the next one comes, at `end` or before.
  template <class IsVoid>
  double take_until(double last, double end, std::size_t most, std::vector<PairCertificate>& pairs,
                    IsVoid is_void) {
    for (;;) {
      open(is_void);
      const double next = next_time();
      if (!(next <= last && next < end)) return end;
      if (pairs.size() >= most && pairs.back().failure_time < next) return next;
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
    return (sorted_.capacity() + heap_.capacity()) * sizeof(PairCertificate) +
           nodes_.capacity() * sizeof(Node) + heads_.capacity() * sizeof(std::uint32_t);
  }

 private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  struct Node {
    PairCertificate pair;
    std::uint32_t next;  ///< of its slice, or of those that are free
  };

  bool heap_comes_first() const {
    return !heap_.empty() && (next_ == sorted_.size() || order_(heap_.front(), sorted_[next_]));
  }
  std::size_t bucket_of(double time) const;
  void wait(const PairCertificate& pair);
  void divide(double first, double last, std::size_t pairs);

  template <class IsVoid>
  void begin_bucket(IsVoid is_void) {
    sorted_.clear();
    next_ = 0;
    while (heads_[++bucket_] == none) continue;
    for (std::uint32_t at = heads_[bucket_]; at != none;) {
      Node& node = nodes_[at];
      if (!is_void(node.pair)) sorted_.push_back(node.pair);
      const std::uint32_t next = node.next;
      node.next = free_;
      free_ = at;
      at = next;
      --waiting_;
    }
    heads_[bucket_] = none;
    std::sort(sorted_.begin(), sorted_.end(), order_);
  }

  CertificateOrder order_;
  std::vector<PairCertificate> sorted_;  ///< of the present slice
  std::size_t next_ = 0;
  std::vector<PairCertificate> heap_;  ///< that have been added to it since
  // Of the slices that come.
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> heads_;
  std::uint32_t free_ = none;
  std::size_t waiting_ = 0;
  std::size_t bucket_ = 0;  ///< the present one
  double begin_ = 0.0;      ///< of slice 0
  double per_time_ = 0.0;
};

/// The times of hot pairs, found by their bodies.
class CertificateTimes {
 public:
  explicit CertificateTimes(std::vector<PairCertificate> pairs);
  /// The first one of the pair; the second may be PairCertificate::walls. +infinity where there is none.
  double of(std::uint32_t a, std::uint32_t b) const;
  /// By their bodies.
  const std::vector<PairCertificate>& pairs() const { return pairs_; }

 private:
  std::vector<PairCertificate> pairs_;
};

}  // namespace kinesphere
