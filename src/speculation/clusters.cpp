#include "speculation/clusters.hpp"

#include <algorithm>
#include <cassert>

namespace kinesphere {
namespace {

/// Moves a range to the end of its list, so that it can grow.
template <class T>
void move_to_end(std::vector<T>& list, IndexRange& range) {
  if (range.end == list.size()) return;
  const auto begin = static_cast<std::uint32_t>(list.size());
  const std::uint32_t size = range.size();
  list.resize(begin + std::size_t{size});
  std::copy_n(list.begin() + range.begin, size, list.begin() + begin);
  range = {begin, begin + size};
}

template <class T>
void append(std::vector<T>& list, IndexRange& range, const IndexRange& more) {
  move_to_end(list, range);
  list.resize(list.size() + more.size());
  std::copy_n(list.begin() + more.begin, more.size(), list.begin() + range.end);
  range.end += more.size();
}

template <class T>
void append(std::vector<T>& list, IndexRange& range, const T& one) {
  move_to_end(list, range);
  list.push_back(one);
  ++range.end;
}

}  // namespace

void Clusters::form(std::span<const PairCertificate> due, const Bodies& bodies,
                    std::vector<BatchState::BodySlot>& slots) {
  bodies_ = &bodies;
  slots_ = &slots;
  slots.resize(bodies.numbers());
  merge_bodies(due);
  distribute(due);
}

void Clusters::clear() {
  for (const std::uint32_t number : members_) (*slots_)[number] = {};
  members_.clear();
  due_.clear();
  count_ = checkpoint_count_ = 0;
}

/// Returns the first body of the pair that is not static; the pair belongs to its cluster.
std::uint32_t Clusters::mobile_of(const PairCertificate& pair) const {
  return bodies_->shapes.any() && (*bodies_)[pair.first].is_static() ? pair.second : pair.first;
}

/// Returns the index of a body, assigned in order of first occurrence.
std::uint32_t Clusters::index_of(std::uint32_t number) {
  std::uint32_t& node = (*slots_)[number].checkpoint;
  if (node == BatchState::none) {
    node = static_cast<std::uint32_t>(parents_.size());
    parents_.push_back(node);
    numbers_.push_back(number);
  }
  return node;
}

std::uint32_t Clusters::root_at(std::uint32_t node) {
  while (parents_[node] != node) node = parents_[node] = parents_[parents_[node]];
  return node;
}

void Clusters::merge_bodies(std::span<const PairCertificate> due) {
  parents_.clear();
  numbers_.clear();
  const bool any_static = bodies_->shapes.any();
  for (const PairCertificate& pair : due) {
    const std::uint32_t one = root_at(index_of(mobile_of(pair)));
    if (!pair.has_second()) continue;
    if (any_static && ((*bodies_)[pair.first].is_static() || (*bodies_)[pair.second].is_static())) continue;
    const std::uint32_t other = root_at(index_of(pair.second));
    parents_[std::max(one, other)] = std::min(one, other);
  }
}

/// Sorts bodies and pairs by cluster.
void Clusters::distribute(std::span<const PairCertificate> due) {
  for (std::uint32_t node = 0; node < parents_.size(); ++node) {
    // The root has the smallest index of its cluster, so its cluster exists already.
    const std::uint32_t top = root_at(node);
    const std::uint32_t index = top == node ? add().index : (*slots_)[numbers_[top]].cluster;
    (*slots_)[numbers_[node]].cluster = index;
    ++clusters_[index].members.end;
  }
  for (const PairCertificate& pair : due) ++clusters_[(*slots_)[mobile_of(pair)].cluster].due.end;
  std::uint32_t members = 0;
  std::uint32_t pairs = 0;
  for (Cluster& cluster : all()) {
    members += cluster.members.end;
    pairs += cluster.due.end;
    cluster.members = {members - cluster.members.end, members - cluster.members.end};
    cluster.due = {pairs - cluster.due.end, pairs - cluster.due.end};
  }
  members_.resize(members);
  due_.resize(pairs);
  for (const std::uint32_t number : numbers_) {
    BatchState::BodySlot& slot = (*slots_)[number];
    slot.checkpoint = clusters_[slot.cluster].members.end++;
    members_[slot.checkpoint] = number;
  }
  for (const PairCertificate& pair : due)
    due_[clusters_[(*slots_)[mobile_of(pair)].cluster].due.end++] = pair;
  checkpoint_count_ = members;
}

Cluster& Clusters::add() {
  if (clusters_.size() == count_) clusters_.emplace_back();
  Cluster& cluster = clusters_[count_];
  cluster.index = cluster.merged_into = static_cast<std::uint32_t>(count_++);
  cluster.needs_run = cluster.is_unsent = true;
  cluster.executed = cluster.has_run = cluster.updates_are_checked = cluster.failed = false;
  cluster.runs = cluster.superseded = 0;
  cluster.members = cluster.due = {};
  cluster.record = {};
  cluster.dirty.clear();
  cluster.pending.clear();
  return cluster;
}

Cluster& Clusters::root_of(std::uint32_t index) {
  while (clusters_[index].merged_into != index) index = clusters_[index].merged_into;
  return clusters_[index];
}

Cluster* Clusters::cluster_of(std::uint32_t number) {
  const std::uint32_t index = number < slots_->size() ? (*slots_)[number].cluster : BatchState::unassigned;
  return index == BatchState::unassigned ? nullptr : &root_of(index);
}

void Clusters::add_member(Cluster& cluster, std::uint32_t number) {
  assert(!cluster.is_merged());
  (*slots_)[number].cluster = cluster.index;
  (*slots_)[number].checkpoint = static_cast<std::uint32_t>(checkpoint_count_++);
  append(members_, cluster.members, number);
  cluster.is_unsent = true;
}

void Clusters::add_due(Cluster& cluster, const PairCertificate& pair) { append(due_, cluster.due, pair); }

Cluster& Clusters::merge(Cluster& one, Cluster& other) {
  assert(&one != &other && !one.is_merged() && !other.is_merged());
  Cluster& into = one.index < other.index ? one : other;
  Cluster& gone = one.index < other.index ? other : one;
  for (const std::uint32_t number : members_of(gone)) (*slots_)[number].cluster = into.index;
  append(members_, into.members, gone.members);
  append(due_, into.due, gone.due);
  into.dirty.insert(into.dirty.end(), gone.dirty.begin(), gone.dirty.end());
  into.pending.insert(into.pending.end(), gone.pending.begin(), gone.pending.end());
  into.needs_run = into.is_unsent = true;
  gone.needs_run = false;
  gone.merged_into = into.index;
  return into;
}

}  // namespace kinesphere
