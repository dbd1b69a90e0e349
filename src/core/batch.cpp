// Many balls that change at once: passes over all of them, in groups, instead of one ball after the other.
// What they are due about, and when, is as if each had changed after those with lower numbers.
#include <algorithm>
#include <array>

#include "bound/rounding.hpp"
#include "core/core.hpp"
#include "number/infinity.hpp"

namespace kinesphere::core {
namespace {

/// So many balls are a batch.
constexpr std::size_t batch = 64;
/// The pairs of so many balls are listed at a time.
constexpr std::size_t part = 256;

}  // namespace

/// Returns true if these are better settled in passes. A core with ghosts notes the course of each ball.
bool Core::is_batch(std::span<const std::uint32_t> changed) const {
  return changed.size() >= batch && ghosts_ == nullptr;
}

/// Computes Ball::own of changed balls.
void Core::set_own_of_many(std::span<const std::uint32_t> changed, Host& host) {
  const StayQuery query{.now = balls_.time(), .unit = unit_, .origin = origin_, .margin = margin_};
  const bool none_drifts = balls_.drifts() == nullptr;
  for (std::size_t k = 0; k < changed.size(); k += group_lanes) {
    std::array<std::uint32_t, group_lanes> group;
    const std::size_t count = std::min(changed.size() - k, group_lanes);
    for (std::size_t lane = 0; lane < group_lanes; ++lane)
      group[lane] = changed[k + std::min(lane, count - 1)];
    std::array<double, group_lanes> stay;
    stay.fill(-1.0);
    if (none_drifts) stays_in_flight(balls_.all().data(), group.data(), group_lanes, query, stay.data());
    for (std::size_t lane = 0; lane < count; ++lane) {
      const std::uint32_t number = group[lane];
      if (stay[lane] < 0.0 || balls_[number].is(Ball::passive)) stay[lane] = stays_inside(number);
      if (balls_.periods().any) stay[lane] = std::min(stay[lane], keeps_image(number));
      set_own(number, stay[lane], host);
    }
  }
}

/// The balls have changed, each after those with lower numbers (note_change()).
void Core::note_changes(std::span<const std::uint32_t> changed, Host& host) {
  // Where all numbers are looked at, neighbours need not be.
  if (!is_batch(changed) || 16 * changed.size() < changes_.size()) {
    for (const std::uint32_t number : changed)
      if (!balls_[number].is(Ball::passive)) note_change(number, host);
    return;
  }
  const std::uint64_t last = *std::max_element(changes_.begin(), changes_.end());
  for (const std::uint32_t number : changed) {
    Ball& ball = balls_[number];
    if (ball.is(Ball::passive)) continue;
    ball.set(Ball::crowded, false);
    changes_[number] = last + 1;
  }
}

/// Computes when changed balls are due, as schedule() does.
void Core::schedule_many(std::span<const std::uint32_t> changed, Host& host) {
  undecided_.clear();
  Counters work;
  for (std::size_t k = 0; k < changed.size(); k += part)
    find_due_of(changed.subspan(k, std::min(changed.size() - k, part)), work);
  host.work_counters(changed.front()) += work;
  ask_host(host);
  queue_.push(balls_.all(), changed);
}

/// Begins the scan of some balls, and lists the pairs of each and those that it looks out for, ball by ball:
/// first_ and second_. One that is linked is paired with itself, which is never apart. Returns their number;
/// behind them, the last pair fills the group.
std::size_t Core::list_pairs(std::span<const std::uint32_t> some) {
  std::size_t count = 0;
  for (const std::uint32_t number : some) {
    Ball& ball = balls_[number];
    if (ball.is(Ball::passive)) continue;
    begin_scan(ball);
    const auto neighbours = lists_.at(ball.list);
    if (first_.size() < count + neighbours.size() + group_lanes + 1) {
      first_.resize(2 * (count + neighbours.size() + group_lanes + 1));
      second_.resize(first_.size());
    }
    for (const std::uint32_t other : neighbours) {
      first_[count] = number;
      second_[count] = other;
      count += static_cast<std::size_t>(looks_out_for(number, other));
    }
    first_[count] = second_[count] = number;
    count += static_cast<std::size_t>(ball.is(Ball::linked));
  }
  if (count == 0) return 0;
  for (std::size_t k = 0; k < group_lanes; ++k) {
    first_[count + k] = first_[count - 1];
    second_[count + k] = second_[count - 1];
  }
  return count;
}

/// Computes when some balls are due, except for those that are linked, or near one that they look out for:
/// undecided_ gets all that they may meet.
void Core::find_due_of(std::span<const std::uint32_t> some, Counters& work) {
  const std::size_t count = list_pairs(some);
  if (apart_.size() < first_.size()) apart_.resize(first_.size());
  pairs_stay_apart(balls_.all().data(), first_.data(), second_.data(), count, pair_query(), apart_.data());
  const double now = balls_.time();
  for (std::size_t k = 0; k < count;) {
    if (apart_[k] == infinity) {
      ++k;
      continue;
    }
    Ball& ball = balls_[first_[k]];
    const std::size_t before = undecided_.size();
    bool is_decided = true;
    for (const std::uint32_t number = first_[k]; k < count && first_[k] == number; ++k) {
      if (apart_[k] == infinity) continue;
      undecided_.push_back({number, second_[k], apart_[k]});
      is_decided = is_decided && rounding::sum_down(now, apart_[k]) > now;
    }
    if (!is_decided) continue;
    for (std::size_t found = before; found < undecided_.size(); ++found) {
      const double until = rounding::sum_down(now, undecided_[found].apart);
      ++work.certificates;
      work.hot_pairs += static_cast<std::uint64_t>(until < ball.own);
      consider(ball, undecided_[found].other, until);
    }
    undecided_.resize(before);
  }
}

/// Computes when those are due that are undecided, ball by ball.
void Core::ask_host(Host& host) {
  for (std::size_t k = 0; k < undecided_.size();) {
    const std::uint32_t number = undecided_[k].ball;
    const auto linked = linked_with(number, host);
    for (; k < undecided_.size() && undecided_[k].ball == number; ++k)
      if (undecided_[k].other != number)
        look_out_for(number, undecided_[k].other, undecided_[k].apart, linked, host);
    look_out_for_linked(number, linked, host);
  }
}

}  // namespace kinesphere::core
