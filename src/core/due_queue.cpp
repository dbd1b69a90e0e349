#include "core/due_queue.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/near_lanes.hpp"
#include "number/infinity.hpp"

namespace kinesphere::core {

void DueQueue::push(std::span<const Ball> balls, std::uint32_t ball) {
  const double time = balls[ball].due;
  if (heads_.empty() || !(time < infinity)) return;
  if (entry_of_.size() < balls.size()) entry_of_.resize(balls.size(), no_entry);
  const std::uint64_t bucket = bucket_of(time);
  if (bucket <= bucket_) {
    const Entry entry{time, ball};
    const auto later = [](const Entry& a, const Entry& b) { return b < a; };
    ++entered_;
    present_.insert(std::lower_bound(present_.begin(), present_.end(), entry, later), entry);
    return;
  }
  if (suffices(entry_of_[ball], bucket)) return;
  if (is_far(bucket)) {
    entry_of_[ball] = far_entry;
    far_.push_back(ball);
  } else {
    put(bucket, ball);
  }
}

void DueQueue::push(std::span<const Ball> balls, std::span<const std::uint32_t> many) {
  if (heads_.empty()) return;
  const std::size_t sorted = present_.size();
  // Buckets lie anywhere in memory: those of later balls are fetched meanwhile.
  constexpr std::size_t ahead = 8;
  for (std::size_t k = 0; k < many.size() + ahead; ++k) {
    if (k < many.size()) {
      const std::uint64_t bucket = bucket_of(balls[many[k]].due);
      const std::uint32_t head = heads_[bucket & (heads_.size() - 1)];
      if (head != none) prefetch_line(&chunks_[head]);
    }
    if (k >= ahead) push_unsorted(balls, many[k - ahead]);
  }
  if (present_.size() > sorted) sort_present();
}

void DueQueue::put(std::uint64_t bucket, std::uint32_t ball) {
  std::uint32_t& head = heads_[bucket & (heads_.size() - 1)];
  if (head == none || chunks_[head].count == std::size(Chunk{}.balls)) {
    std::uint32_t fresh = free_;
    if (fresh == none) {
      fresh = static_cast<std::uint32_t>(chunks_.size());
      chunks_.emplace_back();
    } else {
      free_ = chunks_[fresh].next;
    }
    chunks_[fresh].count = 0;
    chunks_[fresh].next = head;
    head = fresh;
  }
  Chunk& chunk = chunks_[head];
  chunk.balls[chunk.count++] = ball;
  entry_of_[ball] = name_of(bucket);
  ++stored_;
}

DueQueue::Entry DueQueue::first(std::span<const Ball> balls, double until) {
  const Entry nothing{infinity, none};
  for (;;) {
    while (!present_.empty()) {
      const Entry& entry = present_.back();
      if (entry.time > until) return nothing;
      if (balls[entry.ball].due == entry.time && balls[entry.ball].has_region()) return entry;
      present_.pop_back();
    }
    if (stored_ == 0 && far_.empty()) return nothing;
    if (bucket_of(until) <= bucket_) return nothing;
    open_next(balls, until);
  }
}

/// Enters a ball as push() does, if it is due at present at the end of the entries.
void DueQueue::push_unsorted(std::span<const Ball> balls, std::uint32_t ball) {
  if (bucket_of(balls[ball].due) > bucket_) return push(balls, ball);
  ++entered_;
  present_.push_back({balls[ball].due, ball});
}

void DueQueue::sort_present() {
  std::sort(present_.begin(), present_.end(), [](const Entry& a, const Entry& b) { return b < a; });
}

/// Fetches the balls of a bucket.
void DueQueue::prefetch(std::span<const Ball> balls, std::uint32_t head) const {
  for (std::uint32_t at = head; at != none; at = chunks_[at].next)
    for (std::uint32_t k = 0; k < chunks_[at].count; ++k) {
      const Ball& ball = balls[chunks_[at].balls[k]];
      prefetch_line(&ball);
      prefetch_line(&ball.due);
    }
}

void DueQueue::open_next(std::span<const Ball> balls, double until) {
  ++bucket_;
  prefetch(balls, heads_[(bucket_ + 1) & (heads_.size() - 1)]);
  std::uint32_t at = std::exchange(heads_[bucket_ & (heads_.size() - 1)], none);
  while (at != none) {
    // Chunks may move while balls that are due later go on to their buckets.
    const Chunk chunk = chunks_[at];
    chunks_[at].next = free_;
    free_ = at;
    stored_ -= chunk.count;
    for (std::uint32_t k = 0; k < chunk.count; ++k) {
      const std::uint32_t ball = chunk.balls[k];
      if (entry_of_[ball] != name_of(bucket_)) continue;  // it has an earlier entry, or had one
      entry_of_[ball] = no_entry;
      if (balls[ball].has_region()) push_unsorted(balls, ball);
    }
    at = chunk.next;
  }
  sort_present();
  if ((bucket_ & (heads_.size() / 2 - 1)) == 0 || stored_ == 0) take_far(balls, until);
  constexpr std::uint64_t buckets = 256;
  const bool have_many = static_cast<double>(entered_) >= static_cast<double>(buckets) * most_in_bucket;
  if (bucket_ - adapted_ >= buckets || have_many) adapt(balls);
}

/// Puts the balls that are due within the ring by now into their buckets. If the ring is empty, goes on to
/// the first bucket in which a ball is due, but not beyond `until`: balls that come to be due before would
/// all be of the present bucket.
void DueQueue::take_far(std::span<const Ball> balls, double until) {
  if (stored_ == 0 && present_.empty()) {
    std::uint64_t first = bucket_of(until) + 1;
    for (const std::uint32_t ball : far_) first = std::min(first, bucket_of(balls[ball].due));
    // The bucket itself is opened next.
    bucket_ = std::max(bucket_, first - 1);
    adapted_ = std::min(adapted_, bucket_);
  }
  std::size_t kept = 0;
  for (const std::uint32_t ball : far_) {
    if (entry_of_[ball] != far_entry) continue;  // it has been entered again since
    const std::uint64_t bucket = bucket_of(balls[ball].due);
    if (bucket > bucket_ && bucket - bucket_ >= heads_.size() && balls[ball].due < infinity) {
      far_[kept++] = ball;
      continue;
    }
    entry_of_[ball] = no_entry;
    push(balls, ball);
  }
  far_.resize(kept);
}

/// Makes buckets so wide that they hold about as many entries as wanted, if they do not.
void DueQueue::adapt(std::span<const Ball> balls) {
  const bool few = entered_ < balls.size() / 4 && bucket_ - adapted_ < 2 * heads_.size();
  if (few) return;
  const double by_bucket = static_cast<double>(entered_) / static_cast<double>(bucket_ - adapted_);
  entered_ = 0;
  adapted_ = bucket_;
  if (by_bucket < most_in_bucket && by_bucket > least_in_bucket) return;
  const double now = origin_ + static_cast<double>(bucket_) * width_;
  set_width(width_ * std::clamp(wanted / by_bucket, 0x1p-6, 0x1p6), now);
  fill(balls, now);
}

/// Chooses the width of buckets from the quarter of the balls that is due first. Those that are due at once
/// say nothing of it.
void DueQueue::choose_width(std::span<const Ball> balls, double now) {
  std::vector<double> times;
  for (const Ball& ball : balls)
    if (ball.has_region() && ball.due > now && ball.due < infinity) times.push_back(ball.due - now);
  double width = 1.0;
  if (!times.empty()) {
    const std::size_t part = times.size() / 4;
    std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(part), times.end());
    width = times[part] * wanted / (static_cast<double>(part) + 1.0);
  }
  set_width(width, now);
}

/// Sets the width of buckets, but not so narrow that times are not told apart.
void DueQueue::set_width(double width, double now) {
  width_ = std::max(width, 0x1p-40 * std::max(1e-30, std::abs(now)));
  by_width_ = 1.0 / width_;
}

void DueQueue::refill(std::span<const Ball> balls, double now) {
  choose_width(balls, now);
  fill(balls, now);
}

void DueQueue::fill(std::span<const Ball> balls, double now) {
  const auto buckets = static_cast<std::size_t>(static_cast<double>(balls.size()) / wanted);
  heads_.assign(std::bit_ceil(std::max<std::size_t>(buckets, 256)), none);
  origin_ = now;
  bucket_ = adapted_ = entered_ = stored_ = 0;
  present_.clear();
  far_.clear();
  chunks_.clear();
  free_ = none;
  entry_of_.assign(balls.size(), no_entry);
  for (std::uint32_t ball = 0; ball < balls.size(); ++ball) {
    if (balls[ball].has_region()) push_unsorted(balls, ball);
  }
  sort_present();
}

std::size_t DueQueue::bytes() const {
  return heads_.capacity() * sizeof(std::uint32_t) + chunks_.capacity() * sizeof(Chunk) +
         present_.capacity() * sizeof(Entry) +
         (far_.capacity() + entry_of_.capacity()) * sizeof(std::uint32_t);
}

}  // namespace kinesphere::core
