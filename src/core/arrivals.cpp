// The first safe regions of balls that arrive.
#include <algorithm>

#include "core/core.hpp"
#include "core/even_spacing.hpp"
#include "number/infinity.hpp"

namespace kinesphere::core {
namespace {

/// So many balls that arrive at once look each for itself how far others are.
constexpr std::size_t single_arrivals = 8;
/// So many that arrive together are as far apart as they are on average.
constexpr std::size_t even_arrivals = 32;
/// A ball has so few neighbours at first.
constexpr std::size_t few_neighbours = 8;
/// A ball with so many neighbours is in a crowd.
constexpr std::size_t crowd = 32;

}  // namespace

/// Gives those of the changed balls that have arrived their first safe regions and their neighbours.
void Core::place_arrivals(std::span<const std::uint32_t> changed, Host& host) {
  std::vector<std::uint32_t> arrivals;
  for (const std::uint32_t number : changed)
    if (balls_[number].is(Ball::arriving)) arrivals.push_back(number);
  if (arrivals.empty()) return;
  choose_first_radius();
  const bool are_many = arrivals.size() > single_arrivals && 2 * arrivals.size() > present_;
  if (arrivals.size() > single_arrivals) {
    place_together(arrivals, are_many, host);
  } else {
    for (const std::uint32_t number : arrivals)
      enter_region(number, radius_among_others(number), false, host);
  }
  if (are_many) cells_.sort(balls_);
  for (const std::uint32_t number : arrivals) {
    balls_[number].set(Ball::arriving, false);
    find_neighbours(number, host);
    join_crowd(number, host);
  }
  std::sort(settling_.begin(), settling_.end());
  settling_.erase(std::unique(settling_.begin(), settling_.end()), settling_.end());
}

/// Gives balls that arrive together first safe regions: each part of space, with about equally many of them,
/// as wide ones as they are apart there.
void Core::place_together(std::span<std::uint32_t> arrivals, bool are_many, Host& host) {
  if (arrivals.size() <= even_arrivals) {
    const double radius = first_radius_of(arrivals);
    for (const std::uint32_t number : arrivals) enter_region(number, radius, are_many, host);
    return;
  }
  const Box extent = extent_of(arrivals);
  const Vec3 edges = extent.upper - extent.lower;
  const int axis = edges.x >= edges.y && edges.x >= edges.z ? 0 : edges.y >= edges.z ? 1 : 2;
  const auto middle = arrivals.begin() + static_cast<std::ptrdiff_t>(arrivals.size() / 2);
  std::nth_element(arrivals.begin(), middle, arrivals.end(), [&](std::uint32_t a, std::uint32_t b) {
    const double at_a = balls_[a].position[axis], at_b = balls_[b].position[axis];
    return at_a < at_b || (at_a == at_b && a < b);
  });
  place_together(arrivals.first(arrivals.size() / 2), are_many, host);
  place_together(arrivals.subspan(arrivals.size() / 2), are_many, host);
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
  std::vector<std::uint32_t> all;
  for (std::uint32_t number = 0; number < balls_.size(); ++number)
    if (balls_[number].list != none) all.push_back(number);
  first_radius_ = first_radius_of(all);
}

/// Returns about a third of the mean distance of these balls (length), in as many dimensions as they fill.
double Core::first_radius_of(std::span<const std::uint32_t> numbers) const {
  if (numbers.empty()) return tolerance_;
  const auto count = static_cast<double>(numbers.size());
  const Box extent = extent_of(numbers);
  double edges[3] = {extent.upper.x - extent.lower.x, extent.upper.y - extent.lower.y,
                     extent.upper.z - extent.lower.z};
  return tolerance_ + 0.35 * even_spacing(edges, count);
}

/// Returns the box around the reported centres of these balls.
Box Core::extent_of(std::span<const std::uint32_t> numbers) const {
  Vec3 lower{infinity, infinity, infinity}, upper = lower * -1.0;
  for (const std::uint32_t number : numbers)
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = std::min(lower[axis], balls_[number].position[axis]);
      upper[axis] = std::max(upper[axis], balls_[number].position[axis]);
    }
  return {lower, upper};
}

}  // namespace kinesphere::core
