#include "window/agenda.hpp"

#include <cassert>
#include <iterator>
#include <utility>

namespace kinesphere {
namespace {

bool later(const HotPair& a, const HotPair& b) { return b < a; }

}  // namespace

void Agenda::drop_first() {
  assert(!empty());
  if (heap_comes_first()) {
    std::pop_heap(heap_.begin(), heap_.end(), later);
    heap_.pop_back();
  } else if (++next_ == sorted_.size()) {
    sorted_.clear();
    next_ = 0;
  }
}

void Agenda::add(const HotPair& pair) {
  heap_.push_back(pair);
  std::push_heap(heap_.begin(), heap_.end(), later);
}

void Agenda::add_all(std::vector<HotPair>& pairs) {
  const std::size_t remaining = sorted_.size() - next_;
  if (8 * pairs.size() < remaining) {
    for (const HotPair& pair : pairs) add(pair);
  } else {
    std::sort(pairs.begin(), pairs.end());
    if (remaining == 0) {
      sorted_.swap(pairs);
    } else {
      std::vector<HotPair> merged;
      merged.reserve(remaining + pairs.size());
      std::merge(sorted_.begin() + static_cast<std::ptrdiff_t>(next_), sorted_.end(), pairs.begin(),
                 pairs.end(), std::back_inserter(merged));
      sorted_ = std::move(merged);
    }
    next_ = 0;
  }
  pairs.clear();
}

bool Agenda::is_sound() const {
  return next_ <= sorted_.size() && std::is_sorted(sorted_.begin(), sorted_.end()) &&
         std::is_heap(heap_.begin(), heap_.end(), later);
}

PairTimes::PairTimes(std::vector<HotPair> pairs) : pairs_(std::move(pairs)) {
  std::sort(pairs_.begin(), pairs_.end(), [](const HotPair& a, const HotPair& b) {
    return std::tie(a.first, a.second, a.time) < std::tie(b.first, b.second, b.time);
  });
}

double PairTimes::of(std::uint32_t a, std::uint32_t b) const {
  // The walls have the greatest number.
  const auto [first, second] = std::minmax(a, b);
  const auto found = std::partition_point(
      pairs_.begin(), pairs_.end(), [first = first, second = second](const HotPair& pair) {
        return std::tie(pair.first, pair.second) < std::tie(first, second);
      });
  return found != pairs_.end() && found->first == first && found->second == second ? found->time : infinity;
}

}  // namespace kinesphere
