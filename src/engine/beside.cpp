#include "engine/beside.hpp"

#include <cassert>

#include "engine/island.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

void Island::begin(Sea& sea, std::uint32_t own, double now, std::span<const HotPair> due,
                   std::span<const std::uint32_t> unsettled, std::span<const Event> pending) {
  time_ = now;
  phase_end_ = sea.phase_end;
  agenda_.clear();
  for (const HotPair& pair : due) agenda_.add(pair);
  instant_.clear();
  for (const Event& event : pending) instant_.announce(event);
  dirty_.assign(unsettled.begin(), unsettled.end());
  gathering_ = true;
  counters_ = {};
  kicks_ = {};
  beside().begin(sea, own);
}

Outcome Island::end(std::uint32_t worker) {
  agenda_.for_each([this](const HotPair& pair) {
    if (!facts().is_void(pair)) beside_->left.add(pair);
  });
  return beside_->end(worker, {counters_, take_kicks()});
}

/// As World::Engine::advance(), but that no windows start.
Result<void> Island::go_on(Answerer* answerer) {
  if (!beside_->sea->comes(time_)) return settle();
  std::uint32_t round = 0;
  for (;;) {
    if (gathering_) {
      if (auto gathered = gather(); !gathered) return gathered;
    }
    while (const std::optional<Event> event = deliver()) {
      beside_->told.add({round, *event});
      if (answerer != nullptr) {
        if (auto answered = answer(*event, *answerer); !answered) return answered;
      }
      if (!beside_->claims.empty()) return {};
    }
    if (auto settled = settle(); !settled) return settled;
    if (!beside_->claims.empty() || beside_->is_full()) return {};
    ++round;
    if (!instant_.pending().empty()) continue;
    const double next = next_time();
    if (!beside_->sea->comes(next)) return {};
    if (next > time_) round = 0;
    come_to(next);
  }
}

Result<void> Island::answer(const Event& event, Answerer& answerer) {
  const auto answer = answerer.answer(event);
  if (!answer) return answer.error();
  const auto note = [&](BodyId body, const std::optional<Vec3>& velocity) {
    if (velocity) beside_->turned.add({body, answerer.departure(body)});
  };
  note(event.first, answer->first_velocity);
  note(event.second, answer->second_velocity);
  answerer.turn(event, *answer);
  const BodyTable& table = bodies().table();
  if (answer->first_velocity) kick(table.number_of(event.first), *answer->first_velocity);
  if (answer->second_velocity) kick(table.number_of(event.second), *answer->second_velocity);
  return {};
}

/// Whom the body touches or senses, the island has to have too.
void Island::claim_linked(std::uint32_t number) {
  const auto claim = [this](std::uint32_t other) {
    if (!beside_->is_own(other) && !bodies()[other].is_fixed()) beside_->claims.add(other);
  };
  for (const std::uint32_t other : book().partners_of(number)) claim(other);
  for (const Crossing& crossing : book().crossings_of(number)) claim(crossing.partner);
}

/// With one that is not its own: that one is claimed, if the two have to be looked at in this part.
void Island::find_hot_pair_beside(std::uint32_t number, std::uint32_t other) {
  assert(beside_->is_own(number) && !beside_->is_own(other));
  const Facts facts = this->facts();
  // What two in endless windows have to be looked at for is not known of another island's.
  if (beside_->as_it_began(other) != nullptr && facts.windows_end(number, other) == infinity)
    return beside_->claims.add(other);
  const double until = facts.find_hot_pair(number, other, found_);
  if (until == infinity || bodies()[other].is_fixed()) return;
  if (beside_->sea->comes(until)) {
    beside_->claims.add(other);
  } else {
    beside_->counted_on.add({other, time_});
  }
}

}  // namespace kinesphere
