#include "research/rivals/event_driven/event_tree.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace kinesphere {

void EventTree::insert(const Candidate& candidate) {
  Tree::iterator entry;
  bool inserted;
  if (spare_.empty()) {
    std::tie(entry, inserted) = tree_.emplace(candidate, Places{});
  } else {
    spare_.back().key() = candidate;
    auto result = tree_.insert(std::move(spare_.back()));
    spare_.pop_back();
    entry = result.position;
    inserted = result.inserted;
  }
  assert(inserted);
  static_cast<void>(inserted);
  const auto list = [entry](std::vector<Tree::iterator>& entries) {
    entries.push_back(entry);
    return static_cast<std::uint32_t>(entries.size() - 1);
  };
  entry->second[0] = list(by_body_[candidate.first]);
  if (candidate.concerns_pair()) entry->second[1] = list(by_body_[candidate.second]);
  ++insertions_;
  largest_size_ = std::max(largest_size_, tree_.size());
}

Candidate EventTree::pop() {
  const Candidate candidate = earliest();
  take_out(tree_.begin());
  return candidate;
}

void EventTree::take_out(Tree::iterator entry) {
  const Candidate& candidate = entry->first;
  unlist(candidate.first, entry->second[0]);
  if (candidate.concerns_pair()) unlist(candidate.second, entry->second[1]);
  spare_.push_back(tree_.extract(entry));
}

void EventTree::unlist(std::uint32_t body, std::uint32_t place) {
  auto& entries = by_body_[body];
  const Tree::iterator moved = entries.back();
  entries[place] = moved;
  moved->second[moved->first.first == body ? 0 : 1] = place;
  entries.pop_back();
}

}  // namespace kinesphere
