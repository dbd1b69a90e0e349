// DueQueue holds when each ball is due: one time for each, in a ring of buckets of equal width, of which only
// the present one is sorted (a calendar queue).
//
// A bucket holds numbers of balls only, since a ball knows when it is due. When its bucket is opened, a ball
// that is due later by now goes on to the bucket in which it is due, so a ball that is put off again and
// again costs nothing until then. The width of the buckets follows how many entries one has. Neither the
// width nor the order of insertion influences the order in which balls are due: by time, and by number at one
// time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/ball.hpp"

namespace kinesphere::core {

class DueQueue {
 public:
  struct Entry {
    double time;
    std::uint32_t ball;
    friend bool operator<(const Entry& a, const Entry& b) {
      return a.time < b.time || (a.time == b.time && a.ball < b.ball);
    }
  };

  /// Enters a ball, which is due at Ball::due.
  void push(std::span<const Ball> balls, std::uint32_t ball);
  /// Returns true if push() would change something. Threads may ask at the same time.
  bool lacks(std::span<const Ball> balls, std::uint32_t ball) const {
    const double time = balls[ball].due;
    if (heads_.empty() || !(time < std::numeric_limits<double>::infinity())) return false;
    const std::uint64_t bucket = bucket_of(time);
    return bucket <= bucket_ || ball >= entry_of_.size() || !suffices(entry_of_[ball], bucket);
  }
  /// Enters many balls.
  void push(std::span<const Ball> balls, std::span<const std::uint32_t> many);
  /// Returns the first entry, without taking it; one with an infinite time if there is none up to `until`.
  Entry first(std::span<const Ball> balls, double until);
  /// Takes the entry that first() has returned just now. Returns its ball.
  std::uint32_t take_first() {
    const std::uint32_t ball = present_.back().ball;
    present_.pop_back();
    return ball;
  }
  /// Returns a ball that is due soon after the first one, to prefetch; `none` if none is known.
  std::uint32_t coming(std::size_t ahead) const {
    return ahead < present_.size() ? present_[present_.size() - 1 - ahead].ball : none;
  }
  std::size_t bytes() const;
  /// Forgets all entries. push() does nothing until refill().
  void forget() { heads_.clear(); }
  /// Enters all balls that are present anew. `now` is the time of the world.
  void refill(std::span<const Ball> balls, double now);

 private:
  struct alignas(64) Chunk {
    std::uint32_t balls[14];
    std::uint32_t count;
    std::uint32_t next;
  };
  /// Entries of a bucket, with those that are stale: as many as wanted, and the numbers from which on buckets
  /// become narrower or wider.
  static constexpr double wanted = 16.0, most_in_bucket = 2.5 * wanted, least_in_bucket = 0.3 * wanted;
  /// Numbers of buckets beyond this are not told apart.
  static constexpr double last_bucket = 0x1p62;

  /// What entry_of_ has instead of the name of a bucket.
  static constexpr std::uint32_t no_entry = none, far_entry = none - 1;

  std::uint64_t bucket_of(double time) const {
    const double place = (time - origin_) * by_width_;
    if (!(place > 0.0)) return 0;
    return static_cast<std::uint64_t>(std::min(place, last_bucket));
  }
  bool is_far(std::uint64_t bucket) const { return bucket - bucket_ >= heads_.size(); }
  /// Returns true if a ball that is due in a later bucket than the present one needs no other entry: one in
  /// an earlier bucket, or in this one, will do.
  bool suffices(std::uint32_t known, std::uint64_t bucket) const {
    return known != no_entry &&
           (is_far(bucket) || (known != far_entry && after_present(known) <= bucket - bucket_));
  }
  /// Name of a bucket of the ring: the low bits of its number.
  static std::uint32_t name_of(std::uint64_t bucket) {
    return static_cast<std::uint32_t>(bucket & 0x7fffffff);
  }
  /// How many buckets after the present one a bucket of the ring is.
  std::uint64_t after_present(std::uint32_t name) const { return (name - name_of(bucket_)) & 0x7fffffff; }
  void push_unsorted(std::span<const Ball> balls, std::uint32_t ball);
  void sort_present();
  void put(std::uint64_t bucket, std::uint32_t ball);
  void prefetch(std::span<const Ball> balls, std::uint32_t head) const;
  void open_next(std::span<const Ball> balls, double until);
  void take_far(std::span<const Ball> balls, double until);
  void choose_width(std::span<const Ball> balls, double now);
  void set_width(double width, double now);
  void fill(std::span<const Ball> balls, double now);
  void adapt(std::span<const Ball> balls);

  double width_ = 0.0, by_width_ = 0.0;
  double origin_ = 0.0;               ///< time at which bucket 0 begins
  std::uint64_t bucket_ = 0;          ///< the present bucket
  std::vector<std::uint32_t> heads_;  ///< ring of buckets: the first chunk of each
  std::vector<Chunk> chunks_;
  std::uint32_t free_ = none;
  std::vector<Entry> present_;           ///< entries of the present bucket, the first one last
  std::vector<std::uint32_t> far_;       ///< balls that are due beyond the ring
  std::vector<std::uint32_t> entry_of_;  ///< by ball: the bucket of the entry that counts; others are stale
  std::uint64_t entered_ = 0, adapted_ = 0, stored_ = 0;
};

}  // namespace kinesphere::core
