// The course of an instant: what is due is gathered, events are delivered, and what they have changed is
// settled before time moves on.
#include "engine/island.hpp"

#include <algorithm>

#include "archive/fields.hpp"
#include "archive/heap_counter.hpp"

namespace kinesphere {

Result<void> Island::gather() {
  for (;;) {
    if (auto settled = settle(); !settled) return settled;
    if (next_time() > time_) break;
    const HotPair pair = agenda_.first();
    agenda_.drop_first();
    if (facts().is_void(pair)) continue;
    if (auto looked = look(pair); !looked) return looked;
  }
  gathering_ = false;
  return {};
}

Event Island::contact(EventKind kind, std::uint32_t a, std::uint32_t b) const {
  return contact_event(kind, time_, sphere(a), sphere(b), bodies().space());
}

Event Island::wall_contact(EventKind kind, std::uint32_t number, Wall wall) const {
  return wall_event(kind, time_, sphere(number), *bodies().walls(), wall);
}

/// Who senses the other at the distance of this event now.
Senses Island::senses_in(const Event& event) const {
  const Sensing first = sensing_of(bodies(), bodies().table().number_of(event.first));
  const Sensing second = sensing_of(bodies(), bodies().table().number_of(event.second));
  const bool by_first = bodies().sensors.senses_one_way(first, second, event.distance);
  const bool by_second = bodies().sensors.senses_one_way(second, first, event.distance);
  if (by_first && by_second) return Senses::both;
  return by_first ? Senses::first : by_second ? Senses::second : Senses::neither;
}

std::optional<Event> Island::deliver() {
  const auto is_there = [this](BodyId id) {
    const std::uint32_t number = bodies().table().number_of(id);
    return id == bodies().id_of(number) && bodies()[number].present();
  };
  std::optional<Event> event = instant_.deliver(
      book(), is_there, [this](std::uint32_t number) { return sphere(number); },
      [this](const Event& enter) { return senses_in(enter); }, bodies().walls());
  if (!event) return event;
  event->first = bodies().table().tagged(event->first);
  if (event->second != no_body) event->second = bodies().table().tagged(event->second);
  ++counters_.events[static_cast<std::size_t>(event->kind)];
  if (!bodies().rests.empty()) wake_by(*event);
  if (event->repeated) ++counters_.repeated_contacts;
  return event;
}

Result<void> Island::probe(std::span<const std::uint32_t> numbers) {
  Shift alone;
  return probe(numbers, alone);
}

Result<void> Island::probe(std::span<const std::uint32_t> numbers, Shift& shift) {
  // Counted first: a probe that throws leaves the same world as one that does not answer.
  counters_.probes += numbers.size();
  if (beside_)
    for (const std::uint32_t number : numbers) beside_->note_change(number, time_);
  const auto broken = reports_.take(bodies(), time_, numbers, shift);
  if (!broken) return broken.error();
  for (const auto& [k, velocity, promise] : *broken) {
    Sphere reported = sphere(numbers[k]);
    reported.state.velocity = velocity;
    instant_.announce(violation_event(time_, reported, promise));
    void_facts(numbers[k]);
  }
  return {};
}

Result<bool> Island::probe_stale(std::span<const std::uint32_t> numbers, Shift& shift) {
  std::vector<std::uint32_t> stale;
  for (const std::uint32_t number : numbers)
    if (bodies()[number].enabled && !bodies()[number].fresh(time_)) stale.push_back(number);
  if (stale.empty()) return false;
  if (auto probed = probe(stale, shift); !probed) return probed.error();
  return true;
}

void Island::mark_dirty(std::uint32_t number) {
  if (bodies()[number].dirty) return;
  bodies()[number].dirty = true;
  dirty_.push_back(number);
}

void Island::void_facts(std::uint32_t number) {
  ++bodies()[number].stamp;
  mark_dirty(number);
}

void Island::kick(std::uint32_t number, const Vec3& velocity) {
  Body& body = bodies()[number];
  if (body.is_resting()) wake(number);
  if (body.fresh(time_)) {
    body.bound.velocity = velocity;
  } else {
    bodies().change_of(number).kicked_to = velocity;
  }
  if (beside_) {
    claim_linked(number);
    if (!beside_->claims.empty()) return;
  }
  if (bodies().definition().contacts == ContactMode::impacts) book().release_all(number);
  void_facts(number);
}

std::vector<std::uint32_t> Island::arrivals() const {
  std::vector<std::uint32_t> numbers;
  for (const std::uint32_t number : dirty_)
    if (bodies()[number].dirty && bodies()[number].arrived) numbers.push_back(number);
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

/// A capsule holds its body until its window ends, which is not past; only a change or a broken promise
/// leaves a body outside, and dirty.
std::vector<std::uint32_t> Island::bodies_in(const Box& box) const {
  std::vector<std::uint32_t> numbers;
  for (const std::uint32_t number : dirty_)
    if (bodies()[number].dirty) numbers.push_back(number);
  NeighbourSearch search;
  for (const std::uint32_t number : search.in_box(tables_->windows, box, time_))
    if (!bodies()[number].dirty) numbers.push_back(number);
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

void Island::settle_changed() {
  auto& changed = instant_.changed();
  while (!changed.empty()) {
    const auto [a, b] = changed.back();
    settle_changed(a, b);
    changed.pop_back();
  }
}

Result<void> Island::settle() {
  settle_changed();
  // Reports may show broken promises, which make further bodies dirty.
  while (!dirty_.empty()) {
    if (auto settled = settle_dirty(); !settled) return settled;
  }
  return {};
}

/// Body and body, or a body and (itself) its walls: what was certified concerns the contact as it was.
void Island::settle_changed(std::uint32_t a, std::uint32_t b) {
  if (!bodies()[a].present() || !bodies()[b].present() || bodies()[a].dirty || bodies()[b].dirty) return;
  agenda_.add(facts().hot_pair(time_, a, a == b ? HotPair::walls : b));
}

std::size_t Island::bytes() const {
  return agenda_.bytes() + reports_.bytes() + heap_bytes(instant_, dirty_, round_, found_.hot);
}

}  // namespace kinesphere
