// Processing of one instant: what is due is handled, events are delivered, and bodies that they changed are
// recertified before time advances.
#include "processor/event_processor.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <iterator>

#include "archive/heap_counter.hpp"
#include "processor/sleeping.hpp"

namespace kinesphere {

Result<void> EventProcessor::gather(double until) {
  for (;;) {
    if (auto recertified = recertify(); !recertified) return recertified;
    const double next = next_time(until);
    if (next > time_) {
      if (next > until || next >= pause() || !events_.is_quiet()) break;
      advance_clock(next);
      if (auto noted = note_instant(); !noted) return noted;
    }
    if (auto handled = core().handle_next(*this); !handled) return handled;
  }
  gathering_ = false;
  return {};
}

/// Returns an event of two bodies, or of a body and a wall, of a kind that is still to be chosen.
DescribedEvent EventProcessor::describe_pair(std::uint32_t a, std::uint32_t b) const {
  const Sphere first = sphere(a), second = sphere(b);
  const Event event = contact_event(EventKind::zeno_guard, time_, first, second, bodies().space());
  return {event, terms_of(event, first, second)};
}

DescribedEvent EventProcessor::describe_wall(std::uint32_t number, Wall wall) const {
  const Sphere body = sphere(number);
  const Event event = wall_event(EventKind::zeno_guard, time_, body, *bodies().walls(), wall);
  return {event, terms_of(event, body, body)};
}

/// Returns which of the two bodies senses the other at the distance of this event now.
Senses EventProcessor::senses_in(const Event& event) const {
  const Sensing first = sensing_of(bodies(), bodies().table().number_of(event.first));
  const Sensing second = sensing_of(bodies(), bodies().table().number_of(event.second));
  const bool by_first = bodies().sensors.senses_one_way(first, second, event.distance);
  const bool by_second = bodies().sensors.senses_one_way(second, first, event.distance);
  if (by_first && by_second) return Senses::both;
  return by_first ? Senses::first : by_second ? Senses::second : Senses::neither;
}

std::optional<Event> EventProcessor::pop() {
  const auto is_there = [this](BodyId id) {
    const std::uint32_t number = bodies().table().number_of(id);
    return id == bodies().id_of(number) && bodies()[number].present();
  };
  std::optional<Event> event = events_.pop(
      contacts(), is_there, [this](std::uint32_t number) { return sphere(number); },
      [this](const Event& enter) { return senses_in(enter); }, bodies().walls());
  if (!event) return event;
  if (event->second != no_body) {
    if (is_there(event->first) && is_there(event->second))
      event->pair_state =
          contacts()
              .pairs()
              .between(bodies().table().number_of(event->first), bodies().table().number_of(event->second))
              .state;
    event->second = bodies().table().tagged(event->second);
  }
  event->first = bodies().table().tagged(event->first);
  Counters& counters = counters_of(bodies().table().number_of(event->first));
  ++counters.events[static_cast<std::size_t>(event->kind)];
  if (!bodies().sleep_records.empty()) Sleeping(*state_, *this).wake_by(*event);
  if (event->repeated) ++counters.repeated_contacts;
  if (event->jammed) ++counters.jammed_contacts;
  if (reports_.profile() != nullptr) reports_.profile()->note_event(bodies().table(), *event);
  return event;
}

Event EventProcessor::take_timer() {
  ++counters_.events[static_cast<std::size_t>(EventKind::timer)];
  return {.kind = EventKind::timer, .time = time_, .first_user_data = state_->timers.take()};
}

/// Counts probes. They are counted first, so that a probe that throws leaves the same state as one that gives
/// no answer.
void EventProcessor::note_probes(std::span<const std::uint32_t> numbers, ProbeCause cause) {
  for (const std::uint32_t number : numbers) ++counters_of(number).probes;
  if (reports_.profile() != nullptr) reports_.profile()->note_probes(bodies().table(), numbers, cause);
}

Result<void> EventProcessor::probe(std::span<const std::uint32_t> numbers, ProbeCause cause,
                                   PoolLease& work) {
  note_probes(numbers, cause);
  const auto broken = reports_.take(bodies(), time_, numbers, work);
  if (!broken) return broken.error();
  // What has changed is told to the core as a whole.
  if (cause != ProbeCause::change) note_reports(numbers);
  for (const auto& [k, velocity, violation, acceleration_limit] : *broken) {
    Sphere reported = sphere(numbers[k]);
    const Vec3 stored = bodies()[numbers[k]].bound.centre_at(time_);
    reported.state.velocity = bodies().space().velocity_in_row(velocity, stored, reported.state.position);
    events_.queue(violation_event(time_, reported, violation, acceleration_limit));
    contacts().set_largest_acceleration(numbers[k], bodies().largest_acceleration(numbers[k]));
    invalidate(numbers[k]);
  }
  return {};
}

Result<bool> EventProcessor::probe_stale(std::span<const std::uint32_t> numbers, ProbeCause cause) {
  std::vector<std::uint32_t> stale;
  for (const std::uint32_t number : numbers)
    if (bodies()[number].enabled && !bodies()[number].fresh(time_)) stale.push_back(number);
  if (stale.empty()) return false;
  if (auto probed = probe(stale, cause); !probed) return probed.error();
  return true;
}

Result<void> EventProcessor::spot_check(std::span<const std::uint32_t> numbers) {
  if (numbers.empty()) return {};
  note_probes(numbers, ProbeCause::region);
  const auto broken = reports_.contradicted(bodies(), time_, numbers);
  if (!broken) return broken.error();
  for (const std::uint32_t number : *broken) dirty_.add(bodies(), number);
  return {};
}

Result<SpotChecks::Census> EventProcessor::spot_check_due(std::span<const std::uint32_t> numbers,
                                                          std::uint64_t probes) {
  const SpotChecks& checks = state_->spot_checks;
  const bool counts = SpotChecks::counts(probes);
  const bool may_choose_any = checks.may_choose_any(time_);
  SpotChecks::Census census;
  std::vector<std::uint32_t> due;
  for (const std::uint32_t number : numbers) {
    const Body& body = bodies()[number];
    const std::uint32_t name = bodies().table().name_of(number);
    const bool may_be_due = may_choose_any || name < SpotChecks::first_names || body.bound.velocity == Vec3{};
    if ((!may_be_due && !counts && census.any) || !SpotChecks::concerns(body)) continue;
    if (!core().is_ghost(number)) {
      census.any = true;
      if (counts) SpotChecks::count(census, body);
    }
    if (may_be_due && SpotChecks::may_check(body, time_) && checks.is_due(body, name, time_))
      due.push_back(number);
  }
  if (auto checked = spot_check(due); !checked) return checked.error();
  return census;
}

/// Makes everything stale that depends on how the body has moved until now.
[[gnu::always_inline]] inline void EventProcessor::turn_reported(std::uint32_t number, bool turns) {
  contacts().turn_reported(number);
  invalidate(number, turns);
}

[[gnu::always_inline]] inline void EventProcessor::turn(std::uint32_t number, const Vec3& velocity) {
  Body& body = bodies()[number];
  if (body.is_sleeping()) Sleeping(*state_, *this).wake(number);
  if (!body.fresh(time_)) bodies().change_of(number).velocity = velocity;
  // A body with a report of now moves on with it at once, also if it awaits another report, having slept.
  if (body.bound.time == time_) body.bound.velocity = bodies().velocity_in_image(number, velocity);
  turn_reported(number, true);
}

void EventProcessor::set_velocity(std::uint32_t number, const Vec3& velocity) { turn(number, velocity); }

void EventProcessor::set_velocities(std::span<const BodyId> ids, std::span<const Vec3> velocities,
                                    PoolLease& lease) {
  const auto number_of = [&](std::size_t k) { return bodies().table().number_of(ids[k]); };
  // Threads work on bodies that differ, in ascending order, and of which nothing else has changed.
  struct Part {
    std::size_t stale = 0;  ///< bodies that await a report, and then where their changes begin
    std::vector<std::uint32_t> touching{};
    bool is_regular = true;
  };
  std::vector<Part> parts((ids.size() + least_part - 1) / least_part);
  const bool may_share = lease.count() > 1 && parts.size() > 1;
  const auto for_each_part = [&](auto work) {
    lease.parallel_for(ids.size(), least_part, [&](std::size_t from, std::size_t to, std::size_t) {
      work(from, to, parts[from / least_part]);
    });
  };
  if (may_share)
    for_each_part([&](std::size_t from, std::size_t to, Part& part) {
      for (std::size_t k = from; k < to; ++k) {
        const Body& body = bodies()[number_of(k)];
        part.stale += static_cast<std::size_t>(!body.fresh(time_));
        part.is_regular = part.is_regular && !body.is_sleeping() && !body.dirty &&
                          body.change_number == Body::none && (k == 0 || number_of(k - 1) < number_of(k));
      }
    });
  if (!may_share ||
      !std::all_of(parts.begin(), parts.end(), [](const Part& part) { return part.is_regular; })) {
    for (std::size_t k = 0; k < ids.size(); ++k) turn(number_of(k), velocities[k]);
    return;
  }
  std::size_t stale = 0;
  for (Part& part : parts) stale += std::exchange(part.stale, stale);
  const std::size_t first_change = bodies().changes.extend(stale), first_place = dirty_.extend(ids.size());
  for_each_part([&](std::size_t from, std::size_t to, Part& part) {
    std::size_t place = first_change + part.stale;
    for (std::size_t k = from; k < to; ++k) {
      const std::uint32_t number = number_of(k);
      Body& body = bodies()[number];
      if (!body.fresh(time_)) bodies().give_change(number, place++).velocity = velocities[k];
      if (body.bound.time == time_) body.bound.velocity = bodies().velocity_in_image(number, velocities[k]);
      ++body.revision;
      dirty_.put_turned(body, number, first_place + k);
      if (contacts().touches_any(number)) part.touching.push_back(number);
    }
  });
  events_.outdate();
  for (const Part& part : parts)
    for (const std::uint32_t number : part.touching) contacts().turn_reported(number);
}

void EventProcessor::set_angular_velocity(std::uint32_t number, const Vec3& angular_velocity) {
  Body& body = bodies()[number];
  RigidRecord& record = bodies().rigid[body];
  record.change({record.at(time_).orientation, angular_velocity}, time_, body.fresh(time_));
  if (!body.fresh(time_)) bodies().change_of(number);
  contacts().set_largest_acceleration(number, bodies().largest_acceleration(number));
  turn_reported(number);
}

void EventProcessor::detach(std::uint32_t number) {
  events_.end_all_contacts(
      contacts(), number, time_, [this](std::uint32_t other) { return sphere(other); }, bodies().walls());
  events_.drop_woken(bodies().id_of(number));
  Body& body = bodies()[number];
  ++body.revision;
  dirty_.forget(body);
  contacts().pairs().forget_turns(number);
  if (core().contains(number)) core().leave(number);
}

void EventProcessor::turn_back(const Event& crossing) {
  const std::uint32_t a = bodies().table().number_of(crossing.first);
  const std::uint32_t b = bodies().table().number_of(crossing.second);
  if (!bodies()[a].present() || !bodies()[b].present() || !bodies().may_meet(a, b)) return;
  if (senses_in(crossing) == Senses::neither) return;
  const auto overlaps = contacts().overlaps_of(a, b);
  const bool is_within = std::any_of(overlaps.begin(), overlaps.end(), [&](const OverlapRecord& overlap) {
    return overlap.distance == crossing.distance;
  });
  if (is_within != (crossing.kind == EventKind::sensor_enter)) return;
  // Two that move on would cross the distance again at this instant, for ever.
  const Sphere first = sphere(a), second = sphere(b);
  Event now = crossing;
  describe(now, first, second, bodies().space());
  const double onward = is_within ? now.approach_speed : -now.approach_speed;
  const ContactTerms terms = terms_of(now, first, second);
  if (onward > approach_error(now, terms.arm, terms.rates)) return;
  contacts().turn_back(crossing);
  events_.changed().emplace_back(a, b);
}

void EventProcessor::note_response() {
  events_.note_response(contacts(), [this](std::uint32_t number, const Vec3& place) {
    return motion_at(bodies(), time_, number, place);
  });
}

Result<void> EventProcessor::recertify_all() {
  note_response();
  // Reports can violate bounds, which makes further bodies dirty.
  do {
    if (auto recertified = recertify_dirty(); !recertified) return recertified;
  } while (!dirty_.empty());
  return {};
}

/// Tells the core of the dirty bodies, when their states are known.
Result<void> EventProcessor::recertify_dirty() {
  // Listed bodies may have been removed or disabled since.
  round_ = dirty_.sort(bodies());
  PoolLease own(workers_for(round_.size()));
  PoolLease& lease = reports_.lease() != nullptr ? *reports_.lease() : own;
  if (auto probed = probe_dirty(lease); !probed) return probed;
  // Reports that violate bounds may have made further bodies dirty.
  round_ = dirty_.numbers();
  settle_core(lease);
  return {};
}

/// Probes the dirty bodies of round_ whose state is unknown: often all of them.
Result<void> EventProcessor::probe_dirty(PoolLease& lease) {
  std::atomic<bool> are_all_stale = true;
  lease.parallel_for(round_.size(), least_part, [&](std::size_t from, std::size_t to, std::size_t) {
    for (std::size_t k = from; k < to && are_all_stale; ++k)
      if (!bodies()[round_[k]].enabled || bodies()[round_[k]].fresh(time_)) are_all_stale = false;
  });
  if (round_.empty()) return {};
  if (are_all_stale) return probe(round_, ProbeCause::change, lease);
  std::vector<std::uint32_t> stale;
  for (const std::uint32_t number : round_)
    if (bodies()[number].enabled && !bodies()[number].fresh(time_)) stale.push_back(number);
  return stale.empty() ? Result<void>() : probe(stale, ProbeCause::change, lease);
}

std::size_t EventProcessor::bytes() const {
  return reports_.bytes() + known_.bytes() + heap_bytes(events_, dirty_, round_);
}

}  // namespace kinesphere
