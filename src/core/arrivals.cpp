// The first safe regions of balls that arrive.
#include <algorithm>

#include "core/core.hpp"
#include "core/first_radii.hpp"

namespace kinesphere::core {
namespace {

/// A ball has so few neighbours at first.
constexpr std::size_t few_neighbours = 8;
/// A ball with so many neighbours is in a crowd.
constexpr std::size_t crowd = 32;

}  // namespace

/// Gives those of the changed balls that have arrived their first safe regions and their neighbours.
void Core::place_arrivals(std::span<const std::uint32_t> changed, Host& host) {
  if (arriving_ == 0) return;
  std::vector<Arrival> arrivals;
  for (const std::uint32_t number : changed)
    if (balls_[number].is(Ball::arriving)) arrivals.push_back({number, balls_[number].position});
  if (arrivals.empty()) return;
  choose_radii(arrivals);
  const bool are_many = arrivals.size() > single_arrivals && 2 * arrivals.size() > present_;
  for (const Arrival& arrival : arrivals) {
    const double radius = arrival.radius > 0.0 ? arrival.radius : radius_among_others(arrival.ball);
    enter_region(arrival.ball, radius, are_many, host);
  }
  if (are_many) cells_.sort(balls_);
  for (const std::uint32_t number : changed) {
    if (!balls_[number].is(Ball::arriving)) continue;
    balls_[number].set(Ball::arriving, false);
    --arriving_;
    find_neighbours(number, host);
    join_crowd(number, host);
  }
  std::sort(settling_.begin(), settling_.end());
  settling_.erase(std::unique(settling_.begin(), settling_.end()), settling_.end());
}

/// Chooses the radii of first safe regions of balls that arrive; 0 for those that look how far others are. A
/// core that has ghosts knows a part of the balls, so it is told.
void Core::choose_radii(std::span<Arrival> arrivals) {
  if (ghosts_ != nullptr) {
    for (Arrival& arrival : arrivals) arrival.radius = ghosts_->first_radius_of(arrival.ball);
    return;
  }
  choose_first_radius();
  if (arrivals.size() > single_arrivals) choose_first_radii(arrivals, tolerance_);
}

/// Returns the radius of the first safe region of a ball that arrives alone (length): it has a few neighbours
/// then, unless all others are far away.
double Core::radius_among_others(std::uint32_t number) {
  double radius = std::max(balls_[number].radius, 0x1p-10 * first_radius_);
  for (; radius < first_radius_; radius *= 2.0) {
    Ball at = balls_[number];
    at.region = static_cast<float>(radius / unit_);
    cells_.search(at, reach(at), search_);
    search_.drop_repeats();
    if (search_.found.size() > few_neighbours) break;
  }
  return std::max(std::min(radius, first_radius_), 0.5 * balls_[number].radius);
}

/// A ball that has arrived among many with smaller safe regions gets one like theirs.
void Core::join_crowd(std::uint32_t number, Host& host) {
  const Ball& ball = balls_[number];
  if (ball.is(Ball::passive) || lists_.at(ball.list).size() < crowd) return;
  std::vector<float> others;
  for (const std::uint32_t other : lists_.at(ball.list))
    if (!balls_[other].is(Ball::passive)) others.push_back(balls_[other].region);
  if (others.size() < crowd / 2) return;
  const auto middle = others.begin() + static_cast<std::ptrdiff_t>(others.size() / 2);
  std::nth_element(others.begin(), middle, others.end());
  if (!(*middle < 0.7F * ball.region)) return;
  enter_region(number, double{*middle} * unit_, false, host);
  find_neighbours(number, host);
}

/// Chooses the radius of the first safe region of a ball that arrives alone (length), anew when there are
/// twice as many.
void Core::choose_first_radius() {
  if (measured_ <= present_ && present_ < 2 * measured_) return;
  measured_ = present_;
  BoundingBox bounds;
  std::size_t moving = 0;
  for (std::uint32_t number = 0; number < balls_.size(); ++number) {
    if (balls_[number].list == none) continue;
    bounds.add(balls_[number].position);
    ++moving;
  }
  first_radius_ = first_radius(bounds.box(), moving, tolerance_);
}

}  // namespace kinesphere::core
