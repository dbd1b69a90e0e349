#include "engine/islands.hpp"

#include <algorithm>
#include <cassert>
#include <exception>
#include <initializer_list>
#include <utility>

#include "bound/encounter.hpp"

namespace kinesphere {
namespace {

constexpr std::size_t kicks_at_once = 256;

}  // namespace

Islands::Islands(Tables& tables, Island& everybody, Shift& shift, const Probe& probe, Answerer* answerer)
    : tables_(tables), everybody_(everybody), shift_(shift), answerer_(answerer) {
  for (std::size_t worker = 0; worker < shift.count(); ++worker) {
    crew_.emplace_back(tables, everybody.time());
    crew_.back().agenda().order_by(everybody.agenda().order());
    crew_.back().reports().ask(probe, "run");
  }
}

bool Islands::run(double until, std::deque<Event>& events) {
  const Bodies& bodies = tables_.bodies;
  assert(everybody_.is_settled());
  // What these do reaches beyond an island, or asks the caller's own code in the middle of one.
  if (!bodies.rests.empty() || !bodies.changes.empty() || bodies.filters.has_pair_filter()) return false;
  open(take_due(until, infinity));
  const auto all = [](const Group&) { return true; };
  const bool done = are_worth_it() && attempt_all(all);
  if (done) {
    for (const Told* one : finish(all)) events.push_back(one->event);
  } else {
    take_back();
  }
  close();
  return done;
}

double Islands::take_due(double until, double latest) {
  begin_ = everybody_.time();
  sea_.phase_end = everybody_.phase_end();
  sea_.until = until;
  if (most_due_ == 0) most_due_ = std::max(least_due_, tables_.bodies.table().live_count() / 16);
  due_.clear();
  return everybody_.agenda().take_until(
      until, std::min(sea_.phase_end, latest), most_due_, due_,
      [facts = everybody_.facts()](const HotPair& pair) { return facts.is_void(pair); });
}

void Islands::open(double stop) {
  sea_.stop = stop;
  // Those that are due later were taken for a longer part.
  const auto later =
      std::partition_point(due_.begin(), due_.end(), [=](const HotPair& pair) { return pair.time < stop; });
  std::for_each(later, due_.end(), [this](const HotPair& pair) { everybody_.agenda().add(pair); });
  due_.erase(later, due_.end());
  first_runs_ = repeats_ = 0;
  failure_.reset();
  foreign_kicks_.clear();
  compared_foreign_kicks_ = 0;
  meetings_.clear();
  form(due_);
  Beginning unsettled;
  for (const std::uint32_t number : everybody_.dirty())
    if (tables_.bodies[number].dirty) unsettled.unsettled.push_back(number);
  everybody_.instant().pending().for_each([&](const Event& event) { unsettled.pending.push_back(event); });
  add(unsettled);
  tables_.book.start_side_by_side(tables_.bodies.sensors.any());
}

void Islands::close() {
  for (const Kept& kept : kept_) sea_.places[kept.number] = {};
  tables_.book.stop_side_by_side();
}

/// In a short part few kicked bodies meet others; in a long one each body is copied once for many pairs.
void Islands::choose_part() {
  if (16 * repeats_ < first_runs_) {
    most_due_ = std::min(2 * most_due_, std::max(least_due_, tables_.bodies.table().live_count()));
  } else if (6 * repeats_ > first_runs_) {
    most_due_ = std::max(most_due_ / 2, least_due_);
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
      sea_.places[number].kept = place;
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
    groups_[group_of[top]].members.push_back(kept_[place].number);
    sea_.places[kept_[place].number].island = group_of[top];
  }
  for (const HotPair& pair : due) groups_[sea_.places[mover_of(pair)].island].with.due.push_back(pair);
}

Islands::Group& Islands::new_group() {
  if (groups_.size() == count_) groups_.emplace_back();
  Group& group = groups_[count_];
  group.members.clear();
  group.with.clear();
  group.own = group.joined_to = static_cast<std::uint32_t>(count_++);
  group.attempted = group.has_run = group.failed = false;
  group.failure.reset();
  group.again = group.is_news = true;
  group.kicks.clear();
  group.claims.clear();
  group.counted_on.clear();
  group.turned.clear();
  return group;
}

void Islands::add_member(Group& group, std::uint32_t number) {
  sea_.places[number].island = group.own;
  sea_.places[number].kept = static_cast<std::uint32_t>(kept_.size());
  kept_.emplace_back().number = number;
  group.members.push_back(number);
  group.is_news = true;
}

Islands::Group* Islands::group_of(std::uint32_t number) {
  const std::uint32_t own = number < sea_.places.size() ? sea_.places[number].island : Sea::nobody;
  return own == Sea::nobody ? nullptr : &groups_[root_of(own)];
}

void Islands::join_bodies(std::span<const std::uint32_t> numbers) {
  Group* group = nullptr;
  for (const std::uint32_t number : numbers) {
    Group* const theirs = group_of(number);
    if (theirs == nullptr || theirs == group) continue;
    if (group != nullptr) join(group->own, theirs->own);
    group = group_of(number);
  }
  if (group == nullptr) group = &new_group();
  for (const std::uint32_t number : numbers) {
    if (group_of(number) != nullptr) continue;
    take_back(*group);
    group->again = true;
    add_member(*group, number);
  }
}

void Islands::add(const Beginning& more) {
  sea_.places.resize(tables_.bodies.numbers());
  const auto group_with = [this](std::initializer_list<std::uint32_t> numbers) -> Group& {
    join_bodies(numbers);
    Group& group = *group_of(*numbers.begin());
    take_back(group);
    group.again = group.is_news = true;
    return group;
  };
  for (const HotPair& pair : more.due) {
    Group& group = pair.has_second() ? group_with({pair.first, pair.second}) : group_with({pair.first});
    group.with.due.push_back(pair);
  }
  for (const std::uint32_t number : more.unsettled) group_with({number}).with.unsettled.push_back(number);
  for (const Event& event : more.pending)
    group_with({tables_.bodies.table().number_of(event.first)}).with.pending.push_back(event);
}

void Islands::add_foreign_kick(const BodyKick& kick) { foreign_kicks_.push_back(kick); }

const Islands::Kept* Islands::kept(std::uint32_t number) const {
  const std::uint32_t place = number < sea_.places.size() ? sea_.places[number].kept : Sea::none;
  return place != Sea::none && kept_[place].is_kept ? &kept_[place] : nullptr;
}

/// There are enough, and most of the work is not in one of them.
bool Islands::are_worth_it() const {
  constexpr std::size_t few = 16;
  std::size_t all = 0;
  std::size_t largest = 0;
  for (std::size_t k = 0; k < count_; ++k) {
    all += groups_[k].with.due.size();
    largest = std::max(largest, groups_[k].with.due.size());
  }
  return count_ >= few && 2 * largest < all;
}

/// False when one of them has failed.
bool Islands::attempt_found() {
  assert(sea_.places.size() == tables_.bodies.numbers());
  // The large ones first, so that nobody waits for them in the end.
  std::sort(again_.begin(), again_.end(), [this](std::uint32_t a, std::uint32_t b) {
    const std::size_t of_a = groups_[a].with.due.size();
    const std::size_t of_b = groups_[b].with.due.size();
    return of_a != of_b ? of_a > of_b : a < b;
  });
  for (const std::uint32_t own : again_) {
    Group& group = groups_[own];
    (std::exchange(group.has_run, true) ? repeats_ : first_runs_) += group.with.due.size();
  }
  constexpr std::size_t islands_at_once = 8;
  try {
    shift_.for_each(again_.size(), islands_at_once,
                    [this](std::size_t begin, std::size_t end, std::size_t worker) {
                      for (std::size_t k = begin; k < end; ++k) attempt(again_[k], crew_[worker]);
                    });
  } catch (const std::exception& thrown) {
    // It comes again where events are answered one by one, if it comes again.
    failure_ = Error{ErrorCode::callback_threw, "callback", no_body, thrown.what()};
    return false;
  } catch (...) {
    failure_ = Error{ErrorCode::callback_threw, "callback", no_body, "something that is no std::exception"};
    return false;
  }
  for (const std::uint32_t own : again_) {
    if (!groups_[own].failed) continue;
    failure_ = groups_[own].failure;
    return false;
  }
  return true;
}

void Islands::attempt(std::uint32_t own, Island& island) {
  Group& group = groups_[own];
  for (const std::uint32_t number : group.members) {
    Kept& kept = kept_[sea_.places[number].kept];
    if (kept.is_kept) continue;
    kept.body = tables_.bodies.keep(kept.number);
    kept.contacts = tables_.book.keep(kept.number);
    kept.is_kept = true;
  }
  group.again = false;
  group.attempted = group.is_news = true;
  group.kicks_are_compared = false;
  island.begin(sea_, own, begin_, group.with);
  Beside& beside = island.beside();
  std::swap(beside.turned, group.turned);
  beside.turned.clear();
  group.told.clear();
  group.failed = true;
  try {
    const auto gone = island.go_on(answerer_, group.told);
    if (!gone) group.failure = gone.error();
    group.failed = !gone || beside.is_full();
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

void Islands::take_back() {
  for (Group& group : groups()) {
    take_back(group);
    if (!group.joined()) everybody_.agenda().add_all(group.with.due);
  }
}

/// As if the group had never been attempted.
void Islands::take_back(Group& group) {
  if (!group.attempted) return;
  for (const std::uint32_t number : group.members) {
    const Kept& kept = kept_[sea_.places[number].kept];
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
      const std::uint32_t theirs = sea_.places[number].island;
      if (theirs != Sea::nobody) {
        join(ours, root_of(theirs));
      } else {
        take_back(groups_[ours]);
        groups_[ours].again = true;
        add_member(groups_[ours], number);
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

/// Of all groups that are not part of others, and of other processes: first those that have not been compared
/// with any.
std::vector<Islands::OwnKick> Islands::kicks() const {
  std::vector<OwnKick> all;
  for (const bool compared : {false, true}) {
    for (std::uint32_t own = 0; own < count_; ++own) {
      const Group& group = groups_[own];
      if (group.joined() || group.kicks_are_compared != compared) continue;
      for (const BodyKick& kick : group.kicks) all.push_back({own, &kick});
    }
    for (std::size_t k = 0; k < foreign_kicks_.size(); ++k)
      if ((k < compared_foreign_kicks_) == compared) all.push_back({Sea::nobody, &foreign_kicks_[k]});
  }
  return all;
}

std::size_t Islands::new_kicks() const {
  std::size_t count = foreign_kicks_.size() - compared_foreign_kicks_;
  for (std::uint32_t own = 0; own < count_; ++own)
    if (!groups_[own].joined() && !groups_[own].kicks_are_compared) count += groups_[own].kicks.size();
  return count;
}

RoomyBound Islands::bound_of(const BodyKick& kick) const {
  return room_for(tables_.bodies, kick.number, MovedBound(kick.bound, kick.time));
}

/// Joins groups of which kicked bodies may meet. True when some have to run again. Kicks that are new get
/// windows of their own, as if each had been there from the begin of the part on, and the others are held
/// against them.
bool Islands::join_kicks() {
  const std::size_t count = new_kicks();
  if (count == 0) return false;
  const std::vector<OwnKick> kicks = this->kicks();
  compared_foreign_kicks_ = foreign_kicks_.size();
  for (Group& group : groups()) group.kicks_are_compared = group.kicks_are_compared || !group.kicks.empty();
  const auto bound_at_begin = [&](std::uint32_t k) {
    const BodyKick& kick = *kicks[k].kick;
    return room_for(tables_.bodies, kick.number, MovedBound(kick.bound, begin_));
  };
  std::vector<Windows::Starter> starters(count);
  shift_.for_each(count, kicks_at_once, [&](std::size_t from, std::size_t to, std::size_t) {
    for (std::size_t k = from; k < to; ++k) {
      const auto number = static_cast<std::uint32_t>(k);
      const Window& window = kicks[k].kick->window;
      starters[k] = {number, Windows::level_of(bound_at_begin(number), window), window};
    }
  });
  Windows windows(tables_.bodies.space());
  windows.start(starters, begin_, bound_at_begin, shift_);
  // Of a kick that is another process's, the body stands for its group, which is not here.
  std::vector<std::vector<Windows::Pair>> meeting(shift_.count());
  std::vector<std::vector<Windows::Pair>> meeting_foreign(shift_.count());
  const auto compare = [&](std::uint32_t a, std::uint32_t b, std::size_t worker) {
    if (kicks[a].own == kicks[b].own) return;
    if (kicks[a].own == Sea::nobody) std::swap(a, b);
    const bool is_foreign = kicks[b].own == Sea::nobody;
    if (is_foreign && sea_.places[kicks[b].kick->number].island == kicks[a].own) return;
    if (!may_meet(*kicks[a].kick, *kicks[b].kick)) return;
    (is_foreign ? meeting_foreign : meeting)[worker].push_back(
        {kicks[a].own, is_foreign ? kicks[b].kick->number : kicks[b].own});
  };
  shift_.for_each(count, kicks_at_once, [&](std::size_t from, std::size_t to, std::size_t worker) {
    Windows::Scratch scratch;
    for (const auto& [a, b] : windows.near_started(from, to, begin_, bound_at_begin, scratch))
      compare(a, b, worker);
  });
  shift_.for_each(kicks.size() - count, kicks_at_once,
                  [&](std::size_t from, std::size_t to, std::size_t worker) {
                    Windows::Scratch scratch;
                    for (auto k = static_cast<std::uint32_t>(count + from); k < count + to; ++k)
                      for (const std::uint32_t other :
                           windows.near(k, bound_at_begin(k), begin_, kicks[k].kick->window.end, scratch))
                        compare(k, other, worker);
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
  for (const std::vector<Windows::Pair>& pairs : meeting_foreign)
    for (const auto& [own, number] : pairs) meetings_.emplace_back(own, number);
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
  for (const std::uint32_t number : gone.members) sea_.places[number].island = to;
  into.members.insert(into.members.end(), gone.members.begin(), gone.members.end());
  into.with.add(gone.with);
  into.again = into.is_news = true;
  gone.again = false;
  gone.joined_to = to;
}

void Islands::finish(const Group& group, bool is_counted, std::vector<const Told*>& told) {
  if (is_counted) {
    everybody_.counters() += group.counters;
    everybody_.add_kicks(group.settled);
  }
  left_.insert(left_.end(), group.left.begin(), group.left.end());
  for (const Told& one : group.told) told.push_back(&one);
  if (!tables_.bodies.shapes.any()) return;
  for (const std::uint32_t number : group.members)
    tables_.book.tell_fixed(number, kept_[sea_.places[number].kept].contacts);
}

void Islands::finish(std::vector<const Told*>& told) {
  register_kicks();
  everybody_.leave_unsettled();
  everybody_.agenda().add_all(left_);
  std::sort(told.begin(), told.end(), [](const Told* a, const Told* b) {
    if (a->event.time != b->event.time) return a->event.time < b->event.time;
    return a->round != b->round ? a->round < b->round : delivered_before(a->event, b->event);
  });
  everybody_.move_on_to(std::min(sea_.until, sea_.stop));
  choose_part();
}

/// Bodies have the capsules that they got: also those that start anew when the part is over, since queries
/// may come before that, where the run is interrupted.
void Islands::register_kicks() {
  Windows& windows = tables_.windows;
  std::vector<OwnKick> all = kicks();
  std::erase_if(all, [](const OwnKick& one) { return one.own == Sea::nobody; });
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

}  // namespace kinesphere
