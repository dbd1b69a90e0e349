#include "engine/islands.hpp"

#include <algorithm>
#include <cassert>
#include <exception>
#include <tuple>
#include <utility>

#include "number/infinity.hpp"

namespace kinesphere {
namespace {

constexpr std::size_t islands_at_once = 8;

}  // namespace

Islands::Islands(Tables& tables, Island& everybody, Shift& shift, const Probe& probe, Answerer* answerer)
    : tables_(tables),
      everybody_(everybody),
      shift_(shift),
      answerer_(answerer),
      attempts_(tables, everybody, shift.count(), probe, answerer) {}

bool Islands::run(double until, std::deque<Event>& events) {
  const Bodies& bodies = tables_.bodies;
  assert(everybody_.is_settled());
  // What these do reaches beyond an island, or asks the caller's own code in the middle of one.
  if (!bodies.rests.empty() || !bodies.changes.empty() || bodies.filters.has_pair_filter()) return false;
  if (size_.skips_phase()) return false;
  open(take_due(until, infinity));
  const auto all = [](const Group&) { return true; };
  const bool done = are_worth_it() && attempt_all(all);
  if (done) {
    for (const Told* one : finish(all)) events.push_back(one->event);
  } else {
    take_back();
  }
  close();
  size_.pause(done);
  if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
  return done;
}

double Islands::take_due(double until, double latest) {
  sea_.begin = everybody_.time();
  sea_.phase_end = everybody_.phase_end();
  sea_.until = until;
  due_.clear();
  return everybody_.agenda().take_until(
      until, std::min(sea_.phase_end, latest), size_.most_due(tables_.bodies.table().live_count()), due_,
      [facts = everybody_.facts()](const HotPair& pair) { return facts.is_void(pair); });
}

void Islands::open(double stop) {
  sea_.stop = stop;
  // Those that are due later were taken for a longer part.
  const auto later =
      std::partition_point(due_.begin(), due_.end(), [=](const HotPair& pair) { return pair.time < stop; });
  std::for_each(later, due_.end(), [this](const HotPair& pair) { everybody_.agenda().add(pair); });
  due_.erase(later, due_.end());
  size_.begin();
  failure_.reset();
  attempts_.clear();
  comparison_.clear();
  late_.clear();
  groups_.form(due_, tables_.bodies, sea_.places);
  sea_.is_kept.clear();
  // With room for those that are claimed, so that the list rarely has to grow while something is in it.
  if (sea_.kept.size() < groups_.kept()) sea_.kept = std::vector<Kept>(2 * groups_.kept());
  Beginning unsettled;
  for (const std::uint32_t number : everybody_.unsettled().numbers())
    if (tables_.bodies[number].dirty) unsettled.unsettled.push_back(number);
  everybody_.instant().pending().for_each([&](const Event& event) { unsettled.pending.push_back(event); });
  add(unsettled);
  tables_.book.start_side_by_side(tables_.bodies.sensors.any());
}

void Islands::close() {
  groups_.clear();
  tables_.book.stop_side_by_side();
}

/// There are enough, and most of the work is not in one of them.
bool Islands::are_worth_it() const {
  constexpr std::size_t few = 16;
  std::size_t all = 0;
  std::size_t largest = 0;
  for (const Group& group : groups_.all()) {
    all += group.due.size();
    largest = std::max<std::size_t>(largest, group.due.size());
  }
  return groups_.size() >= few && 2 * largest < all;
}

void Islands::join_bodies(std::span<const std::uint32_t> numbers) {
  Group* group = nullptr;
  for (const std::uint32_t number : numbers) {
    Group* const theirs = group_of(number);
    if (theirs == nullptr || theirs == group) continue;
    if (group != nullptr) join(*group, *theirs);
    group = group_of(number);
  }
  if (group == nullptr) group = &groups_.add();
  for (const std::uint32_t number : numbers)
    if (group_of(number) == nullptr) add_member(*group, number);
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
    groups_.add_due(group, pair);
  }
  for (const std::uint32_t number : more.unsettled) group_with({number}).unsettled.push_back(number);
  for (const Event& event : more.pending)
    group_with({tables_.bodies.table().number_of(event.first)}).pending.push_back(event);
}

/// False when one of them has failed, or so many run again and again that others had better do it.
bool Islands::attempt_found() {
  if (thrown_) return false;
  if (size_.repeats_too_often()) return false;
  attempts_.forget_taken_back(groups_, sea_);
  assert(sea_.places.size() == tables_.bodies.numbers());
  sea_.is_kept.resize(groups_.kept(), 0);
  if (sea_.kept.size() < groups_.kept()) sea_.kept.resize(groups_.kept());
  // The large ones first, so that nobody waits for them in the end.
  constexpr std::size_t large = 16;
  std::stable_partition(again_.begin(), again_.end(),
                        [this](std::uint32_t own) { return groups_[own].due.size() >= large; });
  for (const std::uint32_t own : again_) {
    Group& group = groups_[own];
    size_.note_run(group.due.size(), std::exchange(group.has_run, true));
  }
  try {
    shift_.for_each(again_.size(), islands_at_once, [this](std::size_t begin, std::size_t end, std::size_t) {
      for (std::size_t k = begin; k < end; ++k) keep(groups_[again_[k]]);
    });
    shift_.for_each(again_.size(), islands_at_once,
                    [this](std::size_t begin, std::size_t end, std::size_t worker) {
                      for (std::size_t k = begin; k < end; ++k) {
                        Group& group = groups_[again_[k]];
                        attempts_.run(group, due_of(group), sea_, static_cast<std::uint32_t>(worker));
                      }
                    });
  } catch (const std::exception& thrown) {
    // It comes again where events are answered one by one, if it comes again.
    failure_ = Error{ErrorCode::callback_threw, "callback", no_body, thrown.what()};
    return false;
  } catch (...) {
    failure_ = Error{ErrorCode::callback_threw, "callback", no_body, "something that is no std::exception"};
    return false;
  }
  comparison_.note_runs(again_);
  for (const std::uint32_t own : again_) {
    if (!groups_[own].failed) continue;
    // None where it had to stop; and where that was not so, it is the first of its worker that failed.
    failure_ = attempts_.failure_of(groups_[own]);
    return false;
  }
  return true;
}

/// As the bodies are when the part begins. Others may look at that while the group runs.
void Islands::keep(const Group& group) {
  for (const std::uint32_t number : groups_.members_of(group)) {
    const std::uint32_t place = sea_.places[number].kept;
    if (std::exchange(sea_.is_kept[place], std::uint8_t{1}) == 0)
      sea_.kept[place] = {tables_.bodies.keep(number), KeptContacts::of(tables_.book, number)};
  }
}

void Islands::take_back() {
  for (Group& group : groups()) {
    take_back(group);
    if (group.joined()) continue;
    const std::span<const HotPair> due = due_of(group);
    left_.insert(left_.end(), due.begin(), due.end());
  }
  everybody_.agenda().add_all(left_);
}

/// As if the group had never been attempted.
void Islands::take_back(Group& group) {
  if (!group.attempted) return;
  for (const std::uint32_t number : members_of(group)) {
    if (kept(number) == nullptr) continue;
    Sea::Place& place = sea_.places[number];
    Kept& before = sea_.kept[place.kept];
    tables_.bodies.put_back(number, before.body);
    before.contacts.put_back(tables_.book, number);
    before.since = {};
    place.kick = Sea::none;
  }
  // A body that turned several times set out from where it did before the first.
  const std::span<const Turn> turned = turned_of(group);
  std::for_each(turned.rbegin(), turned.rend(), [this](const Turn& turn) { set_out_again(turn); });
  group.attempted = false;
}

/// All others have to go back, too, before anybody learns that this one did not.
void Islands::set_out_again(const Turn& turn) {
  try {
    answerer_->depart(turn.first, turn.second);
  } catch (...) {
    if (thrown_) return;
    thrown_ = std::current_exception();
    failure_ = Error{ErrorCode::callback_threw, "mover", no_body, "run: mover threw as it went back"};
  }
}

void Islands::add_member(Group& group, std::uint32_t number) {
  take_back(group);
  group.again = true;
  groups_.add_member(group, number);
}

/// Needs two that are joined to no other; one that is to be joined with itself runs again.
void Islands::join(Group& one, Group& other) {
  take_back(one);
  take_back(other);
  one.again = true;
  if (&one != &other) groups_.join(one, other);
}

/// Gives groups the bodies that they claim, and joins those that count on bodies that others have changed too
/// early. True when some have to run again.
bool Islands::join_claims() {
  bool any = false;
  for (const std::uint32_t own : again_) {
    for (const std::uint32_t number : attempts_.claims_of(groups_[own])) {
      any = true;
      Group* const theirs = group_of(number);
      if (theirs != nullptr) {
        join(groups_.root_of(own), *theirs);
      } else {
        add_member(groups_.root_of(own), number);
      }
    }
  }
  return join_counted_on() || any;
}

bool Islands::join_counted_on() {
  constexpr std::size_t groups_at_once = 512;
  std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> found(shift_.count());
  shift_.for_each(groups_.size(), groups_at_once,
                  [&](std::size_t begin, std::size_t end, std::size_t worker) {
                    for (Group& group : groups_.all().subspan(begin, end - begin)) {
                      if (group.joined()) continue;
                      group.superseded = 0;
                      for (const auto& [number, time] : counted_on_of(group)) {
                        const Kept* const before = kept(number);
                        if (before == nullptr) continue;
                        // Its new capsule is held against those of others by itself.
                        if (before->since.kick < time && size_.may_leave_some()) {
                          ++group.superseded;
                        } else if (before->since.change <= time) {
                          found[worker].emplace_back(group.own, number);
                        }
                      }
                    }
                  });
  bool any = false;
  for (const auto& some : found) {
    for (const auto& [own, number] : some) {
      Group& ours = groups_.root_of(own);
      Group& theirs = *group_of(number);
      if (&ours == &theirs) continue;
      join(ours, theirs);
      any = true;
    }
  }
  return any;
}

/// Of two bodies as they are after these kicks.
HotPair Islands::pair_of(const BodyKick& kick, const BodyKick& other, double until) const {
  const bool in_order = tables_.bodies.table().comes_before(kick.number, other.number);
  const auto& [first, second] = in_order ? std::tie(kick, other) : std::tie(other, kick);
  return {until, first.number, second.number, first.stamp, second.stamp};
}

/// Joins groups of which kicked bodies may meet. True when some have to run again.
bool Islands::join_kicks() {
  std::vector<GroupKick> kicks;
  const std::size_t fresh = comparison_.take(groups_, attempts_, kicks);
  if (fresh == 0) return false;
  bool any = false;
  for (const auto& [a, b, until, is_void] : meetings(tables_, kicks, fresh, sea_.begin, shift_)) {
    const auto [own, foreign] = kicks[a].own == Sea::nobody ? std::pair(b, a) : std::pair(a, b);
    if (kicks[foreign].own == Sea::nobody) {
      // That body stands for its group, which is not here.
      const std::uint32_t number = kicks[foreign].kick->number;
      if (sea_.places[number].island != kicks[own].own) comparison_.note_meeting(kicks[own].own, number);
      continue;
    }
    Group& one = groups_.root_of(kicks[a].own);
    Group& other = groups_.root_of(kicks[b].own);
    if (&one == &other) continue;
    // Processes tell each other of what is left of each group, not of what is between two.
    if (until != Meeting::unknown && !sea_.comes(until) && size_.may_leave_some()) {
      if (!is_void) late_.note(one, other, pair_of(*kicks[a].kick, *kicks[b].kick, until));
      continue;
    }
    join(one, other);
    any = true;
  }
  return any;
}

void Islands::finish(const Group& group, bool is_counted, std::vector<const Told*>& told) {
  if (is_counted) {
    const Work& work = attempts_.work_of(group);
    everybody_.work().counters += work.counters;
    everybody_.work().settled += {work.settled.bodies, work.settled.near - group.superseded};
    everybody_.work().counters.hot_pairs -= group.superseded;
  }
  const std::span<const HotPair> left = left_of(group);
  left_.insert(left_.end(), left.begin(), left.end());
  for (const Told& one : attempts_.told_by(group)) told.push_back(&one);
  if (!tables_.bodies.shapes.any()) return;
  for (const std::uint32_t number : members_of(group))
    sea_.kept[sea_.places[number].kept].contacts.tell_fixed(tables_.book, number);
}

void Islands::finish(std::vector<const Told*>& told) {
  register_kicks();
  // As if one of the two had found the other.
  late_.for_each_left(groups_, [this](const HotPair& pair) {
    everybody_.work().settled += {0, 1};
    ++everybody_.work().counters.hot_pairs;
    left_.push_back(pair);
  });
  everybody_.leave_unsettled();
  everybody_.agenda().add_all(left_);
  std::sort(told.begin(), told.end(), [](const Told* a, const Told* b) {
    if (a->event.time != b->event.time) return a->event.time < b->event.time;
    return a->round != b->round ? a->round < b->round : delivered_before(a->event, b->event);
  });
  everybody_.move_on_to(std::min(sea_.until, sea_.stop));
  size_.adapt(tables_.bodies.table().live_count());
}

/// Bodies have the capsules that they got: also those that start anew when the part is over, since queries
/// may come before that, where the run is interrupted.
void Islands::register_kicks() {
  std::vector<Windows::Arrival> arrivals;
  std::vector<const BodyKick*> kicks;
  for (const Group& group : groups_.all()) {
    if (group.joined()) continue;
    std::uint32_t place = group.outcome.kicks.begin;
    for (const BodyKick& kick : kicks_of(group)) {
      if (sea_.places[kick.number].kick != place++) continue;
      arrivals.push_back({kick.number, kick.time, kick.window});
      kicks.push_back(&kick);
    }
  }
  tables_.windows.enter_all(
      arrivals,
      [&](std::size_t k) {
        const BodyKick& kick = *kicks[k];
        return room_for(tables_.bodies, kick.number, MovedBound(kick.bound, kick.time));
      },
      shift_);
  tables_.windows.tidy(shift_);
}

}  // namespace kinesphere
