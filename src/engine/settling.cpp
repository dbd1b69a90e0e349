// Settling: bodies get capsules one by one, and the pairs that may change before their windows end become
// hot.
#include <algorithm>
#include <cmath>

#include "engine/island.hpp"
#include "number/infinity.hpp"
#include "number/powers.hpp"

namespace kinesphere {
/// A capsule and hot pairs for each dirty body.
Result<void> Island::settle_dirty() {
  // Some have been removed or disabled since, or have started with all others.
  round_ = unsettled_.sort(bodies());
  Shift alone;
  if (auto probed = probe_stale(round_, alone); !probed) return probed.error();
  // Broken promises may have made further bodies dirty.
  round_ = unsettled_.numbers();
  settle(round_);
  for (const std::uint32_t number : round_) bodies()[number].settled_now();
  unsettled_.clear();
  return {};
}

void Island::settle(std::span<const std::uint32_t> numbers) {
  for (const std::uint32_t number : numbers)
    enter(number, pacing().next_window(number, facts().window_of(number)));
  search(numbers);
}

/// Of bodies that have a new capsule.
void Island::search(std::span<const std::uint32_t> numbers) {
  work_.counters.restarts += numbers.size();
  if (!beside_) tables_->windows.tidy();
  // An island that stopped to claim a body may have left something.
  found_.forget();
  const Facts facts = this->facts();
  for (const std::uint32_t number : numbers) {
    if (beside_) claim_linked(number);
    ++found_.searches;
    for (const std::uint32_t other : near(number)) {
      if (beside_ && !beside_->is_own(other)) {
        find_hot_pair_beside(number, other);
      } else if (!bodies()[other].settled) {
        facts.find_hot_pair(number, other, found_);
      }
    }
    if (beside_ && !beside_->claims.empty()) return;
    bodies()[number].settled = true;
  }
  for (const std::uint32_t number : numbers) {
    facts.find_known_pairs(number, found_);
    facts.find_walls(number, found_);
  }
  for (const std::uint32_t number : numbers) bodies()[number].settled = false;
  work_.settled += {numbers.size(), found_.near};
  found_.hand_over(agenda_, work_.counters);
}

/// A window that the body has for itself ends.
Result<void> Island::renew(std::uint32_t number) {
  const Pacing pacing = this->pacing();
  if (pacing.needs_report(number)) {
    if (auto probed = probe(std::span(&number, 1)); !probed) return probed;
  }
  if (bodies()[number].dirty) return {};
  const auto ended = facts().window_of(number);
  const bool lasted = ended && ended->end <= time_;
  enter(number, lasted ? pacing.longer_window(number, *ended) : pacing.window_for(number));
  search(std::span(&number, 1));
  return {};
}

/// The body gets a capsule from now on. That it was kicked does not end the phase, so its window may end
/// before.
void Island::enter(std::uint32_t number, const Window& window) {
  const Body& body = bodies()[number];
  if (bodies().space().repeats())
    bodies().bring_home(number, time_, window.end < infinity ? window.end - time_ : 0.0);
  if (body.arrived) {
    phase_end_ = std::min(phase_end_, window.end);
  } else if (window.end < phase_end_) {
    agenda_.add({window.end, number, HotPair::renewal, body.stamp, 0});
  }
  if (beside_) {
    const Vec3 middle = bodies().space().repeats() ? bodies().homes[number].middle : Vec3{};
    beside_->add({number, body.stamp, time_, window, body.bound, middle});
  } else {
    tables_->windows.enter(number, roomy_bound(bodies(), number, time_), time_, window);
  }
}

/// The bodies whose capsules may touch the body's new one; some of them need not.
std::span<const std::uint32_t> Island::near(std::uint32_t number) {
  const RoomyBound bound = roomy_bound(bodies(), number, time_);
  std::vector<std::uint32_t>& numbers =
      found_.search.near(tables_->windows, number, bound, time_, facts().end_of(number));
  if (!beside_) return numbers;
  std::erase_if(numbers, [&](std::uint32_t other) { return beside_->last_kick(other) != nullptr; });
  beside_->for_each_kicked([&](std::uint32_t other) {
    if (other != number) numbers.push_back(other);
  });
  return numbers;
}

}  // namespace kinesphere
