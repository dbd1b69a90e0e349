// The certificate queue: which pairs have to be rechecked before a window ends, and when.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "number/infinity.hpp"

namespace kinesphere {

/// A certificate that nothing changes between two bodies, or between a body and the walls or its window, or
/// that a track is not silent for too long, before failure_time. The certificate is stale once the revision
/// of one of its bodies differs.
struct PairCertificate {
  /// What a certificate is about besides its first body: a second body, the walls, the end of its window, or
  /// the silence of a track.
  enum class Kind { pair, with_walls, window_end, silence };
  /// Values of `second` that stand for the other kinds. No body has a number this large.
  static constexpr std::uint32_t walls = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::uint32_t window_end = walls - 1;
  static constexpr std::uint32_t silence = walls - 2;
  bool has_second() const { return second < silence; }
  Kind kind() const {
    if (has_second()) return Kind::pair;
    return second == walls ? Kind::with_walls : second == window_end ? Kind::window_end : Kind::silence;
  }

  double failure_time = 0.0;
  std::uint32_t first = 0;
  std::uint32_t second = walls;
  std::uint32_t first_revision = 0;
  std::uint32_t second_revision = 0;

  friend bool operator<(const PairCertificate& a, const PairCertificate& b) {
    if (a.failure_time != b.failure_time) return a.failure_time < b.failure_time;
    return a.first != b.first ? a.first < b.first : a.second < b.second;
  }
};

/// Order of certificates: by failure time, then by their bodies. Bodies compare by name if they have names,
/// otherwise by number.
class CertificateOrder {
 public:
  CertificateOrder() = default;
  /// Orders by names. `names` is indexed by body number and must outlive this object.
  explicit CertificateOrder(const std::vector<std::uint32_t>& names) : names_(&names) {}

  bool operator()(const PairCertificate& a, const PairCertificate& b) const {
    if (names_ == nullptr || a.failure_time != b.failure_time) return a < b;
    return a.first != b.first ? of(a.first) < of(b.first) : of(a.second) < of(b.second);
  }

 private:
  std::uint32_t of(std::uint32_t number) const {
    return number < PairCertificate::silence ? (*names_)[number] : number;
  }

  const std::vector<std::uint32_t>* names_ = nullptr;
};

/// A priority queue of certificates in CertificateOrder: a ladder queue (Tang, Goh and Thng 2005, ACM
/// Transactions on Modeling and Computer Simulation 15) with a single row of buckets. Most certificates
/// become stale before they are due, so later buckets are not sorted. A bucket is sorted, without its stale
/// certificates, when it becomes the current one; certificates that are added to the current bucket
/// afterwards are kept in a heap. A bucket that is over is used again for a later time, as in a calendar
/// queue, so certificates that come little by little are never divided all at once. Cost: O(1) for each
/// certificate, and O(log of the size of a bucket) for each that becomes due.
class CertificateQueue {
 public:
  /// Sets the order. Precondition: the queue is empty.
  void order_by(const CertificateOrder& order) {
    assert(size() == 0);
    order_ = order;
  }
  const CertificateOrder& order() const { return order_; }
  /// Number of certificates, stale ones included.
  std::size_t size() const { return (sorted_.size() - next_) + heap_.size() + waiting_; }
  /// Moves on to the next bucket that holds a certificate, if the current one is used up.
  /// is_stale(certificate) returns true for a stale one. Must be called after each change, before next_time()
  /// and first().
  template <class IsStale>
  void open(IsStale is_stale) {
    while (!is_open()) begin_bucket(is_stale);
  }
  /// Returns true if open() would do nothing.
  bool is_open() const { return next_ < sorted_.size() || !heap_.empty() || waiting_ == 0; }
  /// Returns the failure time of the first certificate, or +infinity if the queue is empty. Precondition:
  /// open().
  double next_time() const {
    const double of_sorted = next_ < sorted_.size() ? sorted_[next_].failure_time : infinity;
    return heap_.empty() ? of_sorted : std::min(of_sorted, heap_.front().failure_time);
  }
  /// Returns the first certificate, which may be stale. Preconditions: open(), and the queue is not empty.
  /// Invalidated by each change of the queue.
  const PairCertificate& first() const { return heap_comes_first() ? heap_.front() : sorted_[next_]; }
  /// Removes first(), under the preconditions of first().
  void drop_first();
  /// Removes and returns first(), under the preconditions of first().
  PairCertificate take_first() {
    if (heap_.empty()) return sorted_[next_++];
    const PairCertificate pair = first();
    drop_first();
    return pair;
  }
  /// Adds a certificate. Cost: O(1), or O(log of the heap) if it belongs to the current bucket.
  void add(const PairCertificate& pair);
  /// Adds all of `pairs`, which may be in any order, and clears `pairs`. If they are many, all buckets are
  /// divided anew.
  void add_all(std::vector<PairCertificate>& pairs);

  void clear();
  /// Moves certificates that fail before `end`, and no later than `last`, to `pairs`, without stale ones.
  /// Once `pairs` holds `most`, only certificates with the failure time of its last one follow. Returns the
  /// failure time of the next certificate if it stopped at `most`, otherwise `end`.
  template <class IsStale>
  double take_until(double last, double end, std::size_t most, std::vector<PairCertificate>& pairs,
                    IsStale is_stale) {
    for (;;) {
      open(is_stale);
      const double next = next_time();
      if (!(next <= last && next < end)) return end;
      if (pairs.size() >= most && pairs.back().failure_time < next) return next;
      if (!is_stale(first())) pairs.push_back(first());
      drop_first();
    }
  }

  /// Visits all certificates, stale ones included, in no particular order.
  template <class Visit>
  void for_each(Visit visit) const {
    std::for_each(sorted_.begin() + static_cast<std::ptrdiff_t>(next_), sorted_.end(), visit);
    std::for_each(heap_.begin(), heap_.end(), visit);
    const auto visit_list = [&](std::uint32_t head) {
      for (std::uint32_t at = head; at != none; at = nodes_[at].next) visit(nodes_[at].pair);
    };
    std::for_each(heads_.begin(), heads_.end(), visit_list);
    visit_list(beyond_);
  }

  /// Memory reserved for certificates, in bytes.
  std::size_t bytes() const {
    return (sorted_.capacity() + heap_.capacity()) * sizeof(PairCertificate) +
           nodes_.capacity() * sizeof(Node) + heads_.capacity() * sizeof(std::uint32_t);
  }

 private:
  static constexpr std::size_t many = 64;
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  struct Node {
    PairCertificate pair;
    std::uint32_t next;  ///< next node of the bucket or of the free list
  };

  bool heap_comes_first() const {
    return !heap_.empty() && (next_ == sorted_.size() || order_(heap_.front(), sorted_[next_]));
  }
  std::uint64_t bucket_of(double time) const;
  std::uint32_t& head_of(std::uint64_t bucket) {
    return bucket == last_ ? beyond_ : heads_[bucket & (heads_.size() - 1)];
  }
  void wait(const PairCertificate& pair);
  void link(std::uint32_t node);
  void move_last();
  void divide(double first, double last, std::size_t pairs);
  void divide_all(std::vector<PairCertificate>& pairs);

  template <class IsStale>
  void begin_bucket(IsStale is_stale) {
    sorted_.clear();
    next_ = 0;
    const bool is_last = waiting_ == waiting_beyond_;
    if (is_last) {
      bucket_ = last_;
    } else {
      while (heads_[++bucket_ & (heads_.size() - 1)] == none) continue;
    }
    std::uint32_t& head = head_of(bucket_);
    for (std::uint32_t at = std::exchange(head, none); at != none; --waiting_) {
      Node& node = nodes_[at];
      if (!is_stale(node.pair)) sorted_.push_back(node.pair);
      const std::uint32_t next = node.next;
      node.next = free_;
      free_ = at;
      at = next;
    }
    if (is_last) waiting_beyond_ = 0;
    // Times that never come cannot be divided.
    const auto never = [](const PairCertificate& pair) { return pair.failure_time == infinity; };
    const bool is_crowded = is_last ? sorted_.size() > many : waiting_ > many * heads_.size();
    if (is_crowded && std::none_of(sorted_.begin(), sorted_.end(), never)) {
      std::vector<PairCertificate> pairs = std::exchange(sorted_, {});
      return divide_all(pairs);
    }
    if (!is_last && last_ - bucket_ <= heads_.size() / 2) move_last();
    std::sort(sorted_.begin(), sorted_.end(), order_);
  }

  CertificateOrder order_;
  std::vector<PairCertificate> sorted_;  ///< the current bucket, in order from next_ on
  std::size_t next_ = 0;
  std::vector<PairCertificate> heap_;  ///< certificates added to the current bucket since it was sorted
  std::vector<Node> nodes_;            ///< of linked lists, one for each later bucket
  /// Heads of these lists; a power of two. Buckets are numbered by time: bucket b has the head b modulo their
  /// number, and all buckets too late for that together are the last bucket.
  std::vector<std::uint32_t> heads_;
  std::uint32_t beyond_ = none;  ///< head of the last bucket
  std::uint32_t free_ = none;
  std::size_t waiting_ = 0;
  std::size_t waiting_beyond_ = 0;  ///< of these, in the last bucket
  std::uint64_t bucket_ = 0;        ///< the current bucket
  std::uint64_t last_ = 0;          ///< the last bucket
  double begin_ = 0.0;              ///< time at which bucket 0 begins
  double per_time_ = 0.0;           ///< buckets per unit of time; 0 if all are due at once
};

/// Failure times of certificates, looked up by their bodies.
class CertificateTimes {
 public:
  explicit CertificateTimes(std::vector<PairCertificate> pairs);
  /// Returns the earliest failure time of the pair's certificates, or +infinity if it has none. One of the
  /// numbers may be PairCertificate::walls. Cost: O(log n).
  double of(std::uint32_t a, std::uint32_t b) const;
  /// Certificates sorted by their bodies, then by failure time.
  const std::vector<PairCertificate>& pairs() const { return pairs_; }

 private:
  std::vector<PairCertificate> pairs_;
};

}  // namespace kinesphere
