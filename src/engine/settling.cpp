// Settling: bodies get capsules one by one, and the pairs that may change before their windows end become
// hot.
#include <algorithm>
#include <cmath>

#include "engine/island.hpp"
#include "number/infinity.hpp"
#include "number/powers.hpp"

namespace kinesphere {
namespace {

/// What a report costs, in looks at a capsule: with it, all that the caller does for it.
constexpr double price_of_report = 500.0;

}  // namespace

std::optional<Window> Island::registered_window(std::uint32_t number) const {
  if (const BodyKick* kick = beside_ ? beside_->last_kick(number) : nullptr) return kick->window;
  if (!tables_->windows.contains(number)) return std::nullopt;
  return tables_->windows.window_of(number);
}

/// The window in which a body is to be from now on: the one that it is in, unless that lasts longer than the
/// one that suits it, or is far shorter.
Window Island::window_for(std::uint32_t number) const {
  const Body& body = bodies()[number];
  if (body.is_fixed() || body.stands_still()) return Windows::endless();
  const Window window = window_to_start(number);
  const auto now = registered_window(number);
  if (!now || body.arrived) return window;
  const bool suits = now->tier >= window.tier - 2 * Tempo::powers_between_tiers && now->end <= window.end &&
                     (now->tier <= window.tier || !bodies().space().repeats());
  return suits && time_ < now->end ? *now : window;
}

int Island::tier_to_start(std::uint32_t number, const Pace& pace) const {
  int tier = tables_->tempo.tier_for(pace);
  if (!bodies().space().repeats()) return tier;
  tier = Windows::window_at(time_, tier).tier;
  const double release_gap = book().rule().release_gap();
  while (power_of_two(tier) > bodies().longest_in_period(number, time_, power_of_two(tier), release_gap)) {
    const int shorter = Windows::window_at(time_, tier - 1).tier;
    if (shorter == tier) break;
    tier = shorter;
  }
  return tier;
}

/// Whether, until the next window ends, the bound would grow so much that a report costs less, or the body go
/// so far from its last report that its place could not be computed well, or so large that no window suits
/// it.
bool Island::needs_report(std::uint32_t number) const {
  const Body& body = bodies()[number];
  if (body.fresh(time_)) return false;
  const Bound& bound = body.bound;
  const Pace pace = bodies().pace_of(number, time_);
  const Window window = Windows::window_at(time_, tier_to_start(number, pace));
  const double s = window.end - bound.time;
  const auto growth_after = [&bound](double time) {
    return (bound.growth_speed + 0.5 * bound.growth_acceleration * time) * time;
  };
  const double saved = growth_after(s) - growth_after(window.end - time_);
  if (tables_->tempo.cost_of_width(2.0 * saved) > price_of_report) return true;
  const double speed = norm(bound.velocity) + bound.growth_speed + body.largest_acceleration() * s;
  if (!bodies().space().repeats()) return speed * s > bodies().longest_way();
  if (window.tier < tables_->tempo.tier_for(pace)) return true;
  const Vec3& period = bodies().space().period();
  double half = infinity;
  for (int axis = 0; axis < 3; ++axis)
    if (bodies().space().repeats(axis)) half = std::min(half, 0.5 * period[axis]);
  return speed * s > half;
}

/// A capsule and hot pairs for each dirty body.
Result<void> Island::settle_dirty() {
  if (dirty_.size() > 1) {
    std::sort(dirty_.begin(), dirty_.end());
    dirty_.erase(std::unique(dirty_.begin(), dirty_.end()), dirty_.end());
  }
  // Some have been removed or disabled since, or have started with all others.
  std::erase_if(dirty_, [this](std::uint32_t number) { return !bodies()[number].dirty; });
  round_.clear();
  for (const std::uint32_t number : dirty_)
    if (!bodies()[number].fresh(time_)) round_.push_back(number);
  if (!round_.empty()) {
    if (auto probed = probe(round_); !probed) return probed;
  }
  round_ = dirty_;
  settle(round_);
  for (const std::uint32_t number : round_) bodies()[number].settled_now();
  dirty_.clear();
  return {};
}

void Island::settle(std::span<const std::uint32_t> numbers) {
  for (const std::uint32_t number : numbers) enter(number, window_for(number));
  search(numbers);
}

/// Of bodies that have a new capsule.
void Island::search(std::span<const std::uint32_t> numbers) {
  counters_.restarts += numbers.size();
  if (!beside_) tables_->windows.tidy();
  // An island that stopped to claim a body may have left something.
  found_.forget();
  for (const std::uint32_t number : numbers) {
    const auto others = near(number);
    if (beside_ && !beside_->claims.empty()) return;
    ++found_.searches;
    for (const std::uint32_t other : others)
      if (!bodies()[other].settled) find_hot_pair(number, other, found_);
    bodies()[number].settled = true;
  }
  for (const std::uint32_t number : numbers) {
    find_known_pairs(number, found_);
    find_walls(number, found_);
  }
  for (const std::uint32_t number : numbers) bodies()[number].settled = false;
  kicks_.bodies += numbers.size();
  kicks_.hot += found_.pairs;
  take(found_);
}

/// A window that the body has for itself ends.
Result<void> Island::renew(std::uint32_t number) {
  if (needs_report(number)) {
    if (auto probed = probe(std::span(&number, 1)); !probed) return probed;
  }
  if (bodies()[number].dirty) return {};
  // Nothing has happened to it for a while: the next one may be longer, so that there are not many.
  Window window = window_to_start(number);
  if (const auto ended = registered_window(number); ended && !bodies().space().repeats())
    window = Windows::window_at(time_, std::max(window.tier, ended->tier + 1));
  enter(number, window);
  search(std::span(&number, 1));
  return {};
}

void Island::take(Found& found) {
  counters_.searches += std::exchange(found.searches, 0);
  counters_.candidates += std::exchange(found.candidates, 0);
  counters_.hot_pairs += std::exchange(found.pairs, 0);
  agenda_.add_all(found.hot);
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
    const Vec3 middle = bodies().space().repeats() ? bodies().middle_of(number) : Vec3{};
    beside_->add({number, time_, window, body.bound, middle});
  } else {
    tables_->windows.enter(number, bodies().roomy_bound(number, time_), time_, window);
  }
}

/// The bodies whose capsules may touch the body's new one; some of them need not. Beside other islands those
/// that are not its own are claimed, if they matter.
std::span<const std::uint32_t> Island::near(std::uint32_t number) {
  const RoomyBound bound = bodies().roomy_bound(number, time_);
  const auto found = tables_->windows.near(number, bound, time_, end_of(number), found_.scratch);
  if (!beside_) return found;
  claim_linked(number);
  std::vector<std::uint32_t>& numbers = found_.scratch.numbers;
  std::erase_if(numbers, [&](std::uint32_t other) { return !may_count_on(number, other); });
  for (std::uint32_t place = 0; place < beside_->kicks.size(); ++place) {
    const std::uint32_t other = beside_->kicks[place].number;
    if (other != number && beside_->is_last(place)) numbers.push_back(other);
  }
  return numbers;
}

void Island::find_hot_pair(std::uint32_t a, std::uint32_t b, Found& found) const {
  ++found.candidates;
  const double until = unchanged_until(a, b);
  if (until == infinity) return;
  found.hot.push_back(hot_pair(until, a, b));
  ++found.pairs;
}

/// Whom the body touches or senses may be anywhere.
void Island::find_known_pairs(std::uint32_t number, Found& found) const {
  const auto add = [&](std::uint32_t other) {
    // Of two in the round the first one finds it.
    if (!tables_->windows.contains(other) || (bodies()[other].settled && other < number)) return;
    const double until = unchanged_until_by_thresholds(number, other);
    if (until < windows_end(number, other)) found.hot.push_back(hot_pair(until, number, other));
  };
  for (const std::uint32_t partner : book().partners_of(number)) add(partner);
  const auto crossed = book().crossings_of(number);
  for (std::size_t k = 0; k < crossed.size(); ++k) {
    const std::uint32_t other = crossed[k].partner;
    if (k > 0 && other == crossed[k - 1].partner) continue;
    if (!book().touch(number, other)) add(other);
  }
}

/// The body may reach or leave a wall before its window ends.
void Island::find_walls(std::uint32_t number, Found& found) const {
  const Body& body = bodies()[number];
  if (!bodies().walls() || body.is_fixed()) return;
  const double end = end_of(number);
  const double until = book().walls_of(number) != 0
                           ? time_
                           : until_reports_of_walls(book().rule(), body.bound, *bodies().walls(), time_, end);
  if (until < end) found.hot.push_back(hot_pair(until, number, HotPair::walls));
}

}  // namespace kinesphere
