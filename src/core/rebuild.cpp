// What a snapshot holds of a core, and how the rest is made anew.
#include <algorithm>
#include <functional>

#include "core/core.hpp"

namespace kinesphere::core {

Core::Saved Core::saved() const {
  Saved saved;
  saved.reaches.resize(balls_.size());
  saved.lists.resize(balls_.size());
  for (std::uint32_t number = 0; number < balls_.size(); ++number) {
    const Ball& ball = balls_[number];
    if (ball.has_region()) saved.reaches[number] = cells_.reach_of(ball.slot);
    if (ball.list == none) continue;
    const auto neighbours = lists_.at(ball.list);
    saved.lists[number].assign(neighbours.begin(), neighbours.end());
  }
  return saved;
}

bool Core::can_hold(const Bound& bound, double time) const {
  return norm_one(bound.centre_at(time)) + bound.radius_at(time) < 0x1p61 * unit_;
}

bool Core::rebuild(double time) {
  balls_.set_time(time);
  if (!balls_.has_valid_drifts() || saved_.reaches.size() != balls_.size() ||
      changes_.size() != balls_.size() || saved_.lists.size() != balls_.size())
    return false;
  std::vector<std::vector<std::uint32_t>> sorted = saved_.lists;
  for (std::vector<std::uint32_t>& list : sorted) std::sort(list.begin(), list.end());
  for (std::uint32_t number = 0; number < balls_.size(); ++number)
    if (!is_valid(number, sorted)) return false;
  for (std::uint32_t number = 0; number < balls_.size(); ++number) {
    Ball& ball = balls_[number];
    if (!ball.is_present()) continue;
    ++present_;
    if (saved_.reaches[number] > 0.0F) cells_.enter(balls_, number, saved_.reaches[number]);
    if (ball.is(Ball::passive)) continue;
    ball.list = lists_.add();
    lists_.assign(ball.list, saved_.lists[number]);
  }
  saved_ = {};
  queue_.refill(balls_.all(), time);
  queued_for_ = balls_.size();
  return true;
}

/// Returns false if no ball can be like this one, which was read from bytes. `lists`: in ascending order.
bool Core::is_valid(std::uint32_t number, std::span<const std::vector<std::uint32_t>> lists) const {
  const Ball& ball = balls_[number];
  if (!balls_.is_valid(number) || !(ball.radius < 0x1p32 * unit_)) return false;
  if (ball.is_present() && !can_hold(balls_.bound(number), balls_.time())) return false;
  const std::vector<std::uint32_t>& neighbours = lists[number];
  if (!ball.is_present()) return neighbours.empty();
  if (changes_[number] > last_change_ || (ball.is(Ball::passive) && changes_[number] != 0)) return false;
  const float reach = saved_.reaches[number];
  if (ball.is(Ball::arriving) && (!neighbours.empty() || ball.about != none)) return false;
  if (ball.is(Ball::arriving) && reach == 0.0F) return true;
  if (!(reach > 0.0F && reach < 0x1p62F)) return false;
  if (ball.is(Ball::passive) && !neighbours.empty()) return false;
  const bool waits = ball.about != none && ball.about != number;
  if (waits && (ball.is(Ball::passive) || !contains(ball.about))) return false;
  if (std::adjacent_find(neighbours.begin(), neighbours.end(), std::greater_equal()) != neighbours.end())
    return false;
  // Each of two that are neighbours has the other, but for passive ones.
  return std::all_of(neighbours.begin(), neighbours.end(), [&](std::uint32_t other) {
    if (!contains(other) || other == number || balls_[other].is(Ball::arriving) ||
        !cells_.are_near(ball, reach, balls_[other], saved_.reaches[other]))
      return false;
    const std::vector<std::uint32_t>& others = lists[other];
    return balls_[other].is(Ball::passive) || std::binary_search(others.begin(), others.end(), number);
  });
}

}  // namespace kinesphere::core
