#include "engine/islands.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "bound/encounter.hpp"

namespace kinesphere {
namespace {

/// Fewer are not worth the while.
constexpr std::size_t least_due = 128;
constexpr std::size_t kicks_at_once = 256;

}  // namespace

Islands::Islands(Tables& tables, Island& everybody, Shift& shift, const Probe& probe, Answerer* answerer)
    : tables_(tables), everybody_(everybody), shift_(shift), answerer_(answerer) {
  for (std::size_t worker = 0; worker < shift.count(); ++worker) {
    crew_.emplace_back(tables, everybody.time());
    crew_.back().reports().ask(probe, "run");
  }
}

bool Islands::run(double until, std::deque<Event>& events) {
  const Bodies& bodies = tables_.bodies;
  assert(everybody_.is_settled());
  // What these do reaches beyond an island, or asks the caller's own code in the middle of one.
  if (!bodies.rests.empty() || !bodies.changes.empty() || bodies.filters.has_pair_filter()) return false;
  begin_ = everybody_.time();
  sea_.phase_end = everybody_.phase_end();
  sea_.until = until;
  if (most_due_ == 0) most_due_ = std::max(least_due, bodies.table().live_count() / 16);
  std::vector<HotPair> due;
  sea_.stop = everybody_.agenda().take_until(
      until, sea_.phase_end, most_due_, due,
      [facts = everybody_.facts()](const HotPair& pair) { return facts.is_void(pair); });
  form(due);
  const bool done = are_worth_it() && attempt_all();
  if (done) {
    finish(events);
    choose_part();
  } else {
    everybody_.agenda().add_all(due);
  }
  leave();
  return done;
}

/// In a short part few kicked bodies meet others; in a long one each body is copied once for many pairs.
void Islands::choose_part() {
  const std::size_t again = attempts_ - count_;
  if (16 * again < count_) {
    most_due_ = std::min(2 * most_due_, std::max(least_due, tables_.bodies.table().live_count()));
  } else if (6 * again > count_) {
    most_due_ = std::max(most_due_ / 2, least_due);
  }
}

/// Bodies that due pairs join.
void Islands::form(std::span<const HotPair> due) {
  const auto moves = [this](std::uint32_t number) { return !tables_.bodies[number].is_fixed(); };
  sea_.places.resize(tables_.bodies.numbers());
  kept_.clear();
  std::vector<std::uint32_t> up;
  const auto place_of = [&](std::uint32_t number) {
    std::uint32_t& place = sea_.places[number].island;
    if (place == Sea::nobody) {
      place = static_cast<std::uint32_t>(up.size());
      up.push_back(place);
      kept_.emplace_back().number = number;
    }
    return place;
  };
  const auto top_of = [&](std::uint32_t place) {
    while (up[place] != place) place = up[place] = up[up[place]];
    return place;
  };
  const auto mover_of = [&](const HotPair& pair) { return moves(pair.first) ? pair.first : pair.second; };
  for (const HotPair& pair : due) {
    const std::uint32_t one = top_of(place_of(mover_of(pair)));
    if (!pair.has_second() || !moves(pair.first) || !moves(pair.second)) continue;
    const std::uint32_t other = top_of(place_of(pair.second));
    up[std::max(one, other)] = std::min(one, other);
  }
  count_ = 0;
  std::vector<std::uint32_t> group_of(up.size(), Sea::nobody);
  for (std::uint32_t place = 0; place < up.size(); ++place) {
    const std::uint32_t top = top_of(place);
    if (top == place) {
      group_of[place] = static_cast<std::uint32_t>(count_);
      new_group();
    }
    groups_[group_of[top]].members.push_back(place);
    sea_.places[kept_[place].number].island = group_of[top];
  }
  for (const HotPair& pair : due) groups_[sea_.places[mover_of(pair)].island].due.push_back(pair);
}

Islands::Group& Islands::new_group() {
  if (groups_.size() == count_) groups_.emplace_back();
  Group& group = groups_[count_];
  group.members.clear();
  group.due.clear();
  group.own = group.joined_to = static_cast<std::uint32_t>(count_++);
  group.attempted = group.failed = false;
  group.again = true;
  group.kicks.clear();
  group.claims.clear();
  group.counted_on.clear();
  group.turned.clear();
  return group;
}

/// There are enough, and most of the work is not in one of them.
bool Islands::are_worth_it() const {
  constexpr std::size_t few = 16;
  std::size_t all = 0;
  std::size_t largest = 0;
  for (std::size_t k = 0; k < count_; ++k) {
    all += groups_[k].due.size();
    largest = std::max(largest, groups_[k].due.size());
  }
  return count_ >= few && 2 * largest < all;
}

/// False, and everything is as it was, when one of them has failed.
bool Islands::attempt_all() {
  attempts_ = 0;
  tables_.book.start_side_by_side(tables_.bodies.sensors.any());
  bool failed = false;
  try {
    do {
      again_.clear();
      for (std::uint32_t own = 0; own < count_; ++own)
        if (groups_[own].again) again_.push_back(own);
      // The large ones first, so that nobody waits for them in the end.
      std::sort(again_.begin(), again_.end(), [this](std::uint32_t a, std::uint32_t b) {
        const std::size_t of_a = groups_[a].due.size();
        const std::size_t of_b = groups_[b].due.size();
        return of_a != of_b ? of_a > of_b : a < b;
      });
      attempts_ += again_.size();
      constexpr std::size_t islands_at_once = 8;
      shift_.for_each(again_.size(), islands_at_once,
                      [this](std::size_t begin, std::size_t end, std::size_t worker) {
                        for (std::size_t k = begin; k < end; ++k) attempt(again_[k], crew_[worker]);
                      });
      for (const std::uint32_t own : again_) failed = failed || groups_[own].failed;
    } while (!failed && (join_claims() || join_kicks()));
  } catch (...) {
    // It comes again where events are answered one by one, if it comes again.
    failed = true;
  }
  if (failed) {
    for (std::size_t k = 0; k < count_; ++k) take_back(groups_[k]);
  }
  tables_.book.stop_side_by_side();
  return !failed;
}

void Islands::attempt(std::uint32_t own, Island& island) {
  Group& group = groups_[own];
  for (const std::uint32_t place : group.members) {
    Kept& kept = kept_[place];
    if (kept.is_kept) continue;
    kept.body = tables_.bodies.keep(kept.number);
    kept.contacts = tables_.book.keep(kept.number);
    kept.is_kept = true;
  }
  group.again = false;
  group.attempted = true;
  island.begin(sea_, own, begin_, group.due);
  Beside& beside = island.beside();
  std::swap(beside.turned, group.turned);
  beside.turned.clear();
  group.told.clear();
  group.failed = true;
  try {
    group.failed = !island.go_on(answerer_, group.told) || beside.is_full();
  } catch (...) {
    std::swap(beside.turned, group.turned);
    throw;
  }
  std::swap(beside.turned, group.turned);
  std::swap(beside.kicks, group.kicks);
  std::swap(beside.claims, group.claims);
  std::swap(beside.counted_on, group.counted_on);
  group.counters = island.counters();
  group.settled = island.take_kicks();
  group.left = island.hot_pairs();
}

/// As if the group had never been attempted.
void Islands::take_back(Group& group) {
  if (!group.attempted) return;
  for (const std::uint32_t place : group.members) {
    const Kept& kept = kept_[place];
    if (!kept.is_kept) continue;
    tables_.bodies.put_back(kept.number, kept.body);
    tables_.book.put_back(kept.number, kept.contacts);
    sea_.places[kept.number].kick = Sea::none;
  }
  // A body that turned several times set out from where it did before the first.
  std::reverse(group.turned.begin(), group.turned.end());
  for (const auto& [body, departure] : group.turned) answerer_->depart(body, departure);
  group.turned.clear();
  group.attempted = false;
}

/// Gives groups the bodies that they claim, and joins those that count on bodies of others. True when some
/// have to run again.
bool Islands::join_claims() {
  bool any = false;
  for (const std::uint32_t own : again_) {
    // What it joins has claims of its own, which are of no use any more.
    const std::vector<std::uint32_t> claims = std::exchange(groups_[own].claims, {});
    for (const std::uint32_t number : claims) {
      any = true;
      const std::uint32_t ours = root_of(own);
      std::uint32_t& theirs = sea_.places[number].island;
      if (theirs != Sea::nobody) {
        join(ours, root_of(theirs));
      } else {
        theirs = ours;
        take_back(groups_[ours]);
        groups_[ours].again = true;
        groups_[ours].members.push_back(static_cast<std::uint32_t>(kept_.size()));
        kept_.emplace_back().number = number;
      }
    }
  }
  for (std::uint32_t own = 0; own < count_; ++own) {
    if (groups_[own].joined()) continue;
    for (const std::uint32_t number : groups_[own].counted_on) {
      const std::uint32_t theirs = sea_.places[number].island;
      if (theirs == Sea::nobody || root_of(theirs) == root_of(own)) continue;
      join(root_of(own), root_of(theirs));
      any = true;
    }
  }
  return any;
}

/// Of all groups that are not part of others, in the order of groups and times.
std::vector<Islands::OwnKick> Islands::kicks() const {
  std::vector<OwnKick> all;
  for (std::uint32_t own = 0; own < count_; ++own) {
    if (groups_[own].joined()) continue;
    for (const BodyKick& kick : groups_[own].kicks) all.push_back({own, &kick});
  }
  return all;
}

RoomyBound Islands::bound_of(const BodyKick& kick) const {
  return room_for(tables_.bodies, kick.number, MovedBound(kick.bound, kick.time));
}

/// Joins groups of which kicked bodies may meet. True when some have to run again. Kicks get windows of their
/// own, as if each had been there from the begin of the part on.
bool Islands::join_kicks() {
  const std::vector<OwnKick> kicks = this->kicks();
  if (kicks.empty()) return false;
  const auto bound_at_begin = [&](std::uint32_t k) {
    const BodyKick& kick = *kicks[k].kick;
    return room_for(tables_.bodies, kick.number, MovedBound(kick.bound, begin_));
  };
  std::vector<Windows::Starter> starters(kicks.size());
  shift_.for_each(kicks.size(), kicks_at_once, [&](std::size_t from, std::size_t to, std::size_t) {
    for (std::size_t k = from; k < to; ++k) {
      const auto number = static_cast<std::uint32_t>(k);
      const Window& window = kicks[k].kick->window;
      starters[k] = {number, Windows::level_of(bound_at_begin(number), window), window};
    }
  });
  Windows windows(tables_.bodies.space());
  windows.start(starters, begin_, bound_at_begin, shift_);
  std::vector<std::vector<Windows::Pair>> meeting(shift_.count());
  shift_.for_each(kicks.size(), kicks_at_once, [&](std::size_t from, std::size_t to, std::size_t worker) {
    Windows::Scratch scratch;
    for (const auto& [a, b] : windows.near_started(from, to, begin_, bound_at_begin, scratch))
      if (kicks[a].own != kicks[b].own && may_meet(*kicks[a].kick, *kicks[b].kick))
        meeting[worker].push_back({kicks[a].own, kicks[b].own});
  });
  bool any = false;
  for (const std::vector<Windows::Pair>& pairs : meeting) {
    for (const auto& [a, b] : pairs) {
      const std::uint32_t one = root_of(a);
      const std::uint32_t other = root_of(b);
      if (one == other) continue;
      join(one, other);
      any = true;
    }
  }
  return any;
}

bool Islands::may_meet(const BodyKick& a, const BodyKick& b) const {
  const Bodies& bodies = tables_.bodies;
  if (!bodies.may_meet(a.number, b.number)) return false;
  const double from = std::max(a.time, b.time);
  const double end = std::min(a.window.end, b.window.end);
  if (!(from < end)) return false;
  MovedBound moved(b.bound, from);
  if (bodies.space().repeats()) moved.centre += bodies.space().shift_between_homes(b.middle, a.middle);
  const Encounter pair(MovedBound(a.bound, from), moved);
  const double near = reach_of_pair(bodies, a.number, b.number) + bodies.definition().contact_tolerance;
  return !pair.stay_apart(end - from, near);
}

std::uint32_t Islands::root_of(std::uint32_t own) const {
  while (groups_[own].joined_to != own) own = groups_[own].joined_to;
  return own;
}

/// Needs two that are joined to no other.
void Islands::join(std::uint32_t one, std::uint32_t other) {
  if (one == other) {
    take_back(groups_[one]);
    groups_[one].again = true;
    return;
  }
  const auto [to, from] = std::minmax({one, other});
  Group& into = groups_[to];
  Group& gone = groups_[from];
  take_back(into);
  take_back(gone);
  for (const std::uint32_t place : gone.members) sea_.places[kept_[place].number].island = to;
  into.members.insert(into.members.end(), gone.members.begin(), gone.members.end());
  into.due.insert(into.due.end(), gone.due.begin(), gone.due.end());
  into.again = true;
  gone.again = false;
  gone.joined_to = to;
}

/// What came of the groups becomes what came of everybody.
void Islands::finish(std::deque<Event>& events) {
  register_kicks();
  std::vector<HotPair> left;
  std::vector<const Told*> told;
  for (std::uint32_t own = 0; own < count_; ++own) {
    const Group& group = groups_[own];
    if (group.joined()) continue;
    everybody_.counters() += group.counters;
    everybody_.add_kicks(group.settled);
    left.insert(left.end(), group.left.begin(), group.left.end());
    for (const Told& one : group.told) told.push_back(&one);
    if (tables_.bodies.shapes.any()) {
      for (const std::uint32_t place : group.members)
        tables_.book.tell_fixed(kept_[place].number, kept_[place].contacts);
    }
  }
  everybody_.agenda().add_all(left);
  std::sort(told.begin(), told.end(), [](const Told* a, const Told* b) {
    if (a->event.time != b->event.time) return a->event.time < b->event.time;
    return a->round != b->round ? a->round < b->round : delivered_before(a->event, b->event);
  });
  for (const Told* one : told) events.push_back(one->event);
  everybody_.move_on_to(std::min(sea_.until, sea_.stop));
}

/// Bodies have the capsules that they got, unless they start anew in any case when the part is over.
void Islands::register_kicks() {
  Windows& windows = tables_.windows;
  std::vector<OwnKick> all = kicks();
  const double end = sea_.phase_end;
  if (sea_.until >= end && sea_.stop == end) {
    std::erase_if(all, [&](const OwnKick& one) {
      return one.kick->window.end == end && windows.end_of(one.kick->number) == end;
    });
  }
  std::vector<Windows::Entry> entries(all.size());
  shift_.for_each(all.size(), kicks_at_once, [&](std::size_t begin, std::size_t last, std::size_t) {
    for (std::size_t k = begin; k < last; ++k) {
      const BodyKick& kick = *all[k].kick;
      entries[k] = windows.prepare(kick.number, bound_of(kick), kick.time, kick.window);
    }
  });
  for (std::size_t k = 0; k < all.size(); ++k) {
    const BodyKick& kick = *all[k].kick;
    windows.enter(kick.number, bound_of(kick), kick.time, kick.window, entries[k]);
  }
  windows.tidy();
}

void Islands::leave() {
  for (const Kept& kept : kept_) sea_.places[kept.number] = {};
}

}  // namespace kinesphere
