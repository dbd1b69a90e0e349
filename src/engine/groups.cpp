#include "engine/groups.hpp"

#include <algorithm>
#include <cassert>

namespace kinesphere {
namespace {

/// Moves a stretch to the end of its list, so that it can grow.
template <class T>
void move_to_end(std::vector<T>& list, Stretch& stretch) {
  if (stretch.end == list.size()) return;
  const auto begin = static_cast<std::uint32_t>(list.size());
  const std::uint32_t size = stretch.size();
  list.resize(begin + std::size_t{size});
  std::copy_n(list.begin() + stretch.begin, size, list.begin() + begin);
  stretch = {begin, begin + size};
}

template <class T>
void append(std::vector<T>& list, Stretch& stretch, const Stretch& more) {
  move_to_end(list, stretch);
  list.resize(list.size() + more.size());
  std::copy_n(list.begin() + more.begin, more.size(), list.begin() + stretch.end);
  stretch.end += more.size();
}

template <class T>
void append(std::vector<T>& list, Stretch& stretch, const T& one) {
  move_to_end(list, stretch);
  list.push_back(one);
  ++stretch.end;
}

}  // namespace

void Groups::form(std::span<const HotPair> due, const Bodies& bodies, std::vector<Sea::Place>& places) {
  bodies_ = &bodies;
  places_ = &places;
  places.resize(bodies.numbers());
  join_bodies(due);
  deal_out(due);
}

void Groups::clear() {
  for (const std::uint32_t number : members_) (*places_)[number] = {};
  members_.clear();
  due_.clear();
  count_ = kept_ = 0;
}

/// The first body of the pair that moves: its group is that of the pair.
std::uint32_t Groups::mover_of(const HotPair& pair) const {
  return bodies_->shapes.any() && (*bodies_)[pair.first].is_fixed() ? pair.second : pair.first;
}

/// In the order in which they come up.
std::uint32_t Groups::place_of(std::uint32_t number) {
  std::uint32_t& place = (*places_)[number].kept;
  if (place == Sea::none) {
    place = static_cast<std::uint32_t>(up_.size());
    up_.push_back(place);
    numbers_.push_back(number);
  }
  return place;
}

std::uint32_t Groups::top_of(std::uint32_t place) {
  while (up_[place] != place) place = up_[place] = up_[up_[place]];
  return place;
}

void Groups::join_bodies(std::span<const HotPair> due) {
  up_.clear();
  numbers_.clear();
  const bool any_fixed = bodies_->shapes.any();
  for (const HotPair& pair : due) {
    const std::uint32_t one = top_of(place_of(mover_of(pair)));
    if (!pair.has_second()) continue;
    if (any_fixed && ((*bodies_)[pair.first].is_fixed() || (*bodies_)[pair.second].is_fixed())) continue;
    const std::uint32_t other = top_of(place_of(pair.second));
    up_[std::max(one, other)] = std::min(one, other);
  }
}

/// Bodies and pairs, group by group.
void Groups::deal_out(std::span<const HotPair> due) {
  for (std::uint32_t place = 0; place < up_.size(); ++place) {
    // The one at the top has the smallest place of all, and its group already.
    const std::uint32_t top = top_of(place);
    const std::uint32_t own = top == place ? add().own : (*places_)[numbers_[top]].island;
    (*places_)[numbers_[place]].island = own;
    ++groups_[own].members.end;
  }
  for (const HotPair& pair : due) ++groups_[(*places_)[mover_of(pair)].island].due.end;
  std::uint32_t members = 0;
  std::uint32_t pairs = 0;
  for (Group& group : all()) {
    members += group.members.end;
    pairs += group.due.end;
    group.members = {members - group.members.end, members - group.members.end};
    group.due = {pairs - group.due.end, pairs - group.due.end};
  }
  members_.resize(members);
  due_.resize(pairs);
  for (const std::uint32_t number : numbers_) {
    Sea::Place& place = (*places_)[number];
    place.kept = groups_[place.island].members.end++;
    members_[place.kept] = number;
  }
  for (const HotPair& pair : due) due_[groups_[(*places_)[mover_of(pair)].island].due.end++] = pair;
  kept_ = members;
}

Group& Groups::add() {
  if (groups_.size() == count_) groups_.emplace_back();
  Group& group = groups_[count_];
  group.own = group.joined_to = static_cast<std::uint32_t>(count_++);
  group.again = group.is_news = true;
  group.attempted = group.has_run = group.kicks_are_compared = group.failed = false;
  group.attempts = group.superseded = 0;
  group.members = group.due = {};
  group.outcome = {};
  group.unsettled.clear();
  group.pending.clear();
  return group;
}

Group& Groups::root_of(std::uint32_t own) {
  while (groups_[own].joined_to != own) own = groups_[own].joined_to;
  return groups_[own];
}

Group* Groups::group_of(std::uint32_t number) {
  const std::uint32_t own = number < places_->size() ? (*places_)[number].island : Sea::nobody;
  return own == Sea::nobody ? nullptr : &root_of(own);
}

void Groups::add_member(Group& group, std::uint32_t number) {
  assert(!group.joined());
  (*places_)[number].island = group.own;
  (*places_)[number].kept = static_cast<std::uint32_t>(kept_++);
  append(members_, group.members, number);
  group.is_news = true;
}

void Groups::add_due(Group& group, const HotPair& pair) { append(due_, group.due, pair); }

Group& Groups::join(Group& one, Group& other) {
  assert(&one != &other && !one.joined() && !other.joined());
  Group& into = one.own < other.own ? one : other;
  Group& gone = one.own < other.own ? other : one;
  for (const std::uint32_t number : members_of(gone)) (*places_)[number].island = into.own;
  append(members_, into.members, gone.members);
  append(due_, into.due, gone.due);
  into.unsettled.insert(into.unsettled.end(), gone.unsettled.begin(), gone.unsettled.end());
  into.pending.insert(into.pending.end(), gone.pending.begin(), gone.pending.end());
  into.again = into.is_news = true;
  gone.again = false;
  gone.joined_to = into.own;
  return into;
}

}  // namespace kinesphere
