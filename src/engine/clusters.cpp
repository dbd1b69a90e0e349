#include "engine/clusters.hpp"

#include <algorithm>
#include <cassert>

namespace kinesphere {
namespace {

/// Moves a range to the end of its list, so that it can grow.
template <class T>
void move_to_end(std::vector<T>& list, IndexRange& stretch) {
  if (stretch.end == list.size()) return;
  const auto begin = static_cast<std::uint32_t>(list.size());
  const std::uint32_t size = stretch.size();
  list.resize(begin + std::size_t{size});
  std::copy_n(list.begin() + stretch.begin, size, list.begin() + begin);
  stretch = {begin, begin + size};
}

template <class T>
void append(std::vector<T>& list, IndexRange& stretch, const IndexRange& more) {
  move_to_end(list, stretch);
  list.resize(list.size() + more.size());
  std::copy_n(list.begin() + more.begin, more.size(), list.begin() + stretch.end);
  stretch.end += more.size();
}

template <class T>
void append(std::vector<T>& list, IndexRange& stretch, const T& one) {
  move_to_end(list, stretch);
  list.push_back(one);
  ++stretch.end;
}

}  // namespace

void Clusters::form(std::span<const PairCertificate> due, const Bodies& bodies,
                    std::vector<BatchState::BodySlot>& places) {
  bodies_ = &bodies;
  slots_ = &places;
  places.resize(bodies.numbers());
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
  std::uint32_t& place = (*slots_)[number].checkpoint;
  if (place == BatchState::none) {
    place = static_cast<std::uint32_t>(parents_.size());
    parents_.push_back(place);
    numbers_.push_back(number);
  }
  return place;
}

std::uint32_t Clusters::root_at(std::uint32_t place) {
  while (parents_[place] != place) place = parents_[place] = parents_[parents_[place]];
  return place;
}

void Clusters::merge_bodies(std::span<const PairCertificate> due) {
  parents_.clear();
  numbers_.clear();
  const bool any_fixed = bodies_->shapes.any();
  for (const PairCertificate& pair : due) {
    const std::uint32_t one = root_at(index_of(mobile_of(pair)));
    if (!pair.has_second()) continue;
    if (any_fixed && ((*bodies_)[pair.first].is_static() || (*bodies_)[pair.second].is_static())) continue;
    const std::uint32_t other = root_at(index_of(pair.second));
    parents_[std::max(one, other)] = std::min(one, other);
  }
}

/// Sorts bodies and pairs by cluster.
void Clusters::distribute(std::span<const PairCertificate> due) {
  for (std::uint32_t place = 0; place < parents_.size(); ++place) {
    // The root has the smallest index of its cluster, so its cluster exists already.
    const std::uint32_t top = root_at(place);
    const std::uint32_t own = top == place ? add().index : (*slots_)[numbers_[top]].cluster;
    (*slots_)[numbers_[place]].cluster = own;
    ++clusters_[own].members.end;
  }
  for (const PairCertificate& pair : due) ++clusters_[(*slots_)[mobile_of(pair)].cluster].due.end;
  std::uint32_t members = 0;
  std::uint32_t pairs = 0;
  for (Cluster& group : all()) {
    members += group.members.end;
    pairs += group.due.end;
    group.members = {members - group.members.end, members - group.members.end};
    group.due = {pairs - group.due.end, pairs - group.due.end};
  }
  members_.resize(members);
  due_.resize(pairs);
  for (const std::uint32_t number : numbers_) {
    BatchState::BodySlot& place = (*slots_)[number];
    place.checkpoint = clusters_[place.cluster].members.end++;
    members_[place.checkpoint] = number;
  }
  for (const PairCertificate& pair : due)
    due_[clusters_[(*slots_)[mobile_of(pair)].cluster].due.end++] = pair;
  checkpoint_count_ = members;
}

Cluster& Clusters::add() {
  if (clusters_.size() == count_) clusters_.emplace_back();
  Cluster& group = clusters_[count_];
  group.index = group.merged_into = static_cast<std::uint32_t>(count_++);
  group.needs_run = group.is_unsent = true;
  group.executed = group.has_run = group.updates_are_checked = group.failed = false;
  group.runs = group.superseded = 0;
  group.members = group.due = {};
  group.record = {};
  group.dirty.clear();
  group.pending.clear();
  return group;
}

Cluster& Clusters::root_of(std::uint32_t own) {
  while (clusters_[own].merged_into != own) own = clusters_[own].merged_into;
  return clusters_[own];
}

Cluster* Clusters::cluster_of(std::uint32_t number) {
  const std::uint32_t own = number < slots_->size() ? (*slots_)[number].cluster : BatchState::unassigned;
  return own == BatchState::unassigned ? nullptr : &root_of(own);
}

void Clusters::add_member(Cluster& group, std::uint32_t number) {
  assert(!group.is_merged());
  (*slots_)[number].cluster = group.index;
  (*slots_)[number].checkpoint = static_cast<std::uint32_t>(checkpoint_count_++);
  append(members_, group.members, number);
  group.is_unsent = true;
}

void Clusters::add_due(Cluster& group, const PairCertificate& pair) { append(due_, group.due, pair); }

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
