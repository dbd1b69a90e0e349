// The queue of crossings of one plane, and the steps of its sweep.
#include "research/rivals/hubbard/sweep.hpp"

#include <algorithm>
#include <tuple>

namespace kinesphere {
namespace {

/// Order of a heap with the first crossing in front.
struct Later {
  bool operator()(const Sweep::Crossing& a, const Sweep::Crossing& b) const {
    return std::tie(a.time, a.below, a.above) > std::tie(b.time, b.below, b.above);
  }
};

}  // namespace

void Sweep::insert(std::uint32_t number, const Line& line) {
  if (number >= rank_.size()) rank_.resize(number + 1, absent);
  rank_[number] = static_cast<std::uint32_t>(status_.size());
  status_.push_back({line, number});
}

void Sweep::erase(std::uint32_t number) {
  status_.erase(status_.begin() + rank_[number]);
  for (std::size_t k = rank_[number]; k < status_.size(); ++k)
    rank_[status_[k].number] = static_cast<std::uint32_t>(k);
  rank_[number] = absent;
  queue_.clear();
}

/// Appends the crossing of an entry and the next one to the queue and returns true, if they cross in what is
/// left of the interval. A crossing that rounding has delayed gets the present time.
inline bool Sweep::find_crossing(std::size_t lower) {
  const Entry& below = status_[lower];
  const Entry& above = status_[lower + 1];
  const double closing = below.line.speed - above.line.speed;
  const double gap = above.line.start - below.line.start;
  if (!(closing * duration_ > std::max(gap, 0.0))) return false;
  queue_.push_back({std::clamp(gap / closing, time_, duration_), below.number, above.number});
  return true;
}

void Sweep::begin(double duration) {
  time_ = 0.0;
  duration_ = duration;
  queue_.clear();
  for (std::size_t k = 0; k + 1 < status_.size(); ++k) find_crossing(k);
  std::make_heap(queue_.begin(), queue_.end(), Later{});
}

Sweep::Crossing Sweep::step() {
  const Crossing crossing = queue_.front();
  pop();
  time_ = crossing.time;
  const std::size_t lower = rank_[crossing.below];
  exchange(lower);
  if (lower > 0) schedule_crossing(lower - 1);
  if (lower + 2 < status_.size()) schedule_crossing(lower + 1);
  drop_outdated();
  return crossing;
}

void Sweep::schedule_crossing(std::size_t lower) {
  if (find_crossing(lower)) std::push_heap(queue_.begin(), queue_.end(), Later{});
}

/// Removes outdated crossings from the front of the queue.
void Sweep::drop_outdated() {
  while (!queue_.empty() && rank_[queue_.front().below] + 1 != rank_[queue_.front().above]) pop();
}

void Sweep::pop() {
  std::pop_heap(queue_.begin(), queue_.end(), Later{});
  queue_.pop_back();
}

}  // namespace kinesphere
