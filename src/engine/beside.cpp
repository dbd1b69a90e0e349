#include "engine/beside.hpp"

#include <cassert>

#include "engine/island.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

void Island::begin(Beside& beside, std::span<const HotPair> due, std::span<const std::uint32_t> unsettled,
                   std::span<const Event> pending) {
  beside_ = &beside;
  time_ = beside.sea->begin;
  phase_end_ = beside.sea->phase_end;
  agenda_.clear();
  for (const HotPair& pair : due) agenda_.add(pair);
  instant_.clear();
  for (const Event& event : pending) instant_.announce(event);
  unsettled_.assign(unsettled);
  gathering_ = true;
  work_ = {};
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
