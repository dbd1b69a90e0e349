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
  constexpr std::size_t part = 256;
  for (std::size_t k = 0; k < changed.size(); k += part)
    look_out(changed.subspan(k, std::min(changed.size() - k, part)), host);
  for (const std::uint32_t number : undecided_) find_due(number, false, host);
  for (const std::uint32_t number : changed)
    if (!balls_[number].is(Ball::passive)) queue_.push(balls_.all(), number);
}

/// Computes when some balls are due, but for those about which the host has to be asked: these are added to
/// undecided_.
void Core::look_out(std::span<const std::uint32_t> some, Host& host) {
  first_.clear();
  second_.clear();
  for (const std::uint32_t number : some) {
    const Ball& ball = balls_[number];
    if (ball.is(Ball::passive) || ball.is(Ball::linked)) continue;
    for (const std::uint32_t other : lists_.at(ball.list)) {
      if (!looks_out_for(number, other)) continue;
      first_.push_back(number);
      second_.push_back(other);
    }
  }
  const std::size_t count = first_.size();
  const std::size_t whole = (count + group_lanes - 1) / group_lanes * group_lanes;
  if (count > 0) {
    first_.resize(whole, first_.back());
    second_.resize(whole, second_.back());
  }
  apart_.resize(whole);
  pairs_stay_apart(balls_.all().data(), first_.data(), second_.data(), whole, pair_query(), apart_.data());
  Counters work;
  std::size_t pair = 0;
  for (const std::uint32_t number : some) {
    Ball& ball = balls_[number];
    if (ball.is(Ball::passive)) continue;
    const std::size_t begin = pair;
    while (pair < count && first_[pair] == number) ++pair;
    if (ball.is(Ball::linked) || std::any_of(&apart_[begin], &apart_[pair], [&](double apart) {
          return !(rounding::sum_down(balls_.time(), apart) > balls_.time());
        })) {
      undecided_.push_back(number);
      continue;
    }
    if (ball.scans < 255) ++ball.scans;
    ball.about = none;
    ball.due = ball.second = ball.own;
    for (std::size_t k = begin; k < pair; ++k) {
      if (apart_[k] == infinity) continue;
      const double until = rounding::sum_down(balls_.time(), apart_[k]);
      ++work.certificates;
      work.hot_pairs += static_cast<std::uint64_t>(until < ball.own);
      consider(ball, second_[k], until);
    }
  }
  host.work_counters(some.front()) += work;
}

}  // namespace kinesphere::core
