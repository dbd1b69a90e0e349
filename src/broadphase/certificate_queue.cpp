#include "broadphase/certificate_queue.hpp"

#include <bit>
#include <cassert>
#include <tuple>
#include <utility>

namespace kinesphere {
namespace {

/// Reversed order, with which the standard heap algorithms keep the earliest certificate in front.
auto later_by(const CertificateOrder& order) {
  return [order](const PairCertificate& a, const PairCertificate& b) { return order(b, a); };
}

}  // namespace

std::uint64_t CertificateQueue::bucket_of(double time) const {
  const double slices = (time - begin_) * per_time_;
  return slices < static_cast<double>(last_) ? static_cast<std::uint64_t>(std::max(slices, 0.0)) : last_;
}

/// Puts a certificate into a bucket after the current one. Precondition: its bucket index exceeds bucket_.
void CertificateQueue::wait(const PairCertificate& pair) {
  std::uint32_t node = free_;
  if (node == none) {
    node = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
  } else {
    free_ = nodes_[node].next;
  }
  nodes_[node].pair = pair;
  link(node);
  ++waiting_;
}

/// Puts a node into the list of its bucket.
void CertificateQueue::link(std::uint32_t node) {
  const std::uint64_t bucket = bucket_of(nodes_[node].pair.failure_time);
  std::uint32_t& head = head_of(bucket);
  nodes_[node].next = head;
  head = node;
  if (bucket == last_) ++waiting_beyond_;
}

/// Makes the last bucket as late as heads allow, and takes those out of it that belong to others.
void CertificateQueue::move_last() {
  last_ = bucket_ + heads_.size();
  waiting_beyond_ = 0;
  for (std::uint32_t at = std::exchange(beyond_, none); at != none;) {
    const std::uint32_t next = nodes_[at].next;
    link(at);
    at = next;
  }
}

void CertificateQueue::drop_first() {
  if (heap_comes_first()) {
    std::pop_heap(heap_.begin(), heap_.end(), later_by(order_));
    heap_.pop_back();
  } else {
    assert(next_ < sorted_.size());
    ++next_;
  }
}

void CertificateQueue::add(const PairCertificate& pair) {
  if (bucket_of(pair.failure_time) > bucket_) return wait(pair);
  heap_.push_back(pair);
  std::push_heap(heap_.begin(), heap_.end(), later_by(order_));
}

void CertificateQueue::clear() {
  sorted_.clear();
  next_ = 0;
  heap_.clear();
  nodes_.clear();
  heads_.clear();
  beyond_ = free_ = none;
  waiting_ = waiting_beyond_ = 0;
  bucket_ = last_ = 0;
}

/// Divides the times from `first` to `last` into buckets of about 16 certificates each, for `pairs`
/// certificates, and makes bucket 0 the current one. Precondition: no certificate is in a later bucket.
void CertificateQueue::divide(double first, double last, std::size_t pairs) {
  // Mean number of certificates per bucket.
  constexpr std::size_t in_a_slice = 16;
  constexpr std::size_t most = std::size_t{1} << 18;
  // Certificates that are added later may fail after `last`.
  constexpr std::size_t times_longer = 4;
  const std::size_t slices = std::clamp<std::size_t>(pairs / in_a_slice, 1, most);
  heads_.assign(std::bit_ceil(times_longer * slices), none);
  nodes_.clear();
  beyond_ = free_ = none;
  waiting_ = waiting_beyond_ = 0;
  bucket_ = 0;
  last_ = heads_.size();
  begin_ = first;
  const double length = (last - first) / static_cast<double>(slices);
  per_time_ = length > 0.0 ? 1.0 / length : 0.0;
  if (!(per_time_ < infinity)) per_time_ = 0.0;
}

void CertificateQueue::add_all(std::vector<PairCertificate>& pairs) {
  if (4 * pairs.size() < size() || pairs.size() < many) {
    for (const PairCertificate& pair : pairs) add(pair);
  } else {
    divide_all(pairs);
  }
  pairs.clear();
}

/// Divides the times of `pairs`, which are not empty, and of all certificates in the queue into buckets anew.
void CertificateQueue::divide_all(std::vector<PairCertificate>& pairs) {
  for_each([&](const PairCertificate& pair) { pairs.push_back(pair); });
  sorted_.clear();
  next_ = 0;
  heap_.clear();
  const auto [first, last] = std::minmax_element(pairs.begin(), pairs.end());
  divide(first->failure_time, last->failure_time, pairs.size());
  // Certificates of bucket 0 form the current bucket; the others go to later buckets.
  for (const PairCertificate& pair : pairs) {
    if (bucket_of(pair.failure_time) > 0) {
      wait(pair);
    } else {
      sorted_.push_back(pair);
    }
  }
  std::sort(sorted_.begin(), sorted_.end(), order_);
}

CertificateTimes::CertificateTimes(std::vector<PairCertificate> pairs) : pairs_(std::move(pairs)) {
  std::sort(pairs_.begin(), pairs_.end(), [](const PairCertificate& a, const PairCertificate& b) {
    return std::tie(a.first, a.second, a.failure_time) < std::tie(b.first, b.second, b.failure_time);
  });
}

double CertificateTimes::of(std::uint32_t a, std::uint32_t b) const {
  // PairCertificate::walls is the greatest number, so it is always second.
  const auto [first, second] = std::minmax(a, b);
  const auto found = std::partition_point(
      pairs_.begin(), pairs_.end(), [first = first, second = second](const PairCertificate& pair) {
        return std::tie(pair.first, pair.second) < std::tie(first, second);
      });
  return found != pairs_.end() && found->first == first && found->second == second ? found->failure_time
                                                                                   : infinity;
}

}  // namespace kinesphere
