// The loop: what is due first, and what follows from it.
#include "core/core.hpp"

#include <algorithm>
#include <bit>
#include <functional>

#include "bodies/body_bounds.hpp"
#include "bound/quick_reject.hpp"
#include "contact/contact_event.hpp"
#include "contact/contact_predictor.hpp"
#include "number/infinity.hpp"
#include "number/powers.hpp"

namespace kinesphere::core {
namespace {

/// The region unit is about 2^20 contact tolerances: lengths within limits::largest_length, and their
/// squares, are ordinary numbers in single precision then.
double region_unit(const WorldDefinition& definition) {
  return power_of_two(exponent_of(definition.contact_tolerance) + 20);
}

Periods periods_of(const Space& space) {
  Periods periods{.length = space.period(), .any = space.repeats()};
  for (int axis = 0; axis < 3; ++axis)
    if (space.repeats(axis)) periods.inverse[axis] = 1.0 / periods.length[axis];
  return periods;
}

}  // namespace

Core::Core(const WorldDefinition& definition, Reporter& reporter)
    : dimensions_(definition.dimensions),
      walls_(walls_of(definition)),
      unit_(region_unit(definition)),
      margin_(rounding_margin(definition)),
      tolerance_(definition.contact_tolerance),
      balls_(periods_of(Space(definition)), definition.start_time),
      cells_(balls_.periods().length / unit_, definition.dimensions),
      reporter_(reporter) {
  for (int axis = 0; axis < 3; ++axis)
    if (balls_.periods().length[axis] > 0.0) origin_[axis] = definition.box->lower[axis];
}

std::uint32_t Core::add(const Bound& bound) {
  std::uint32_t number;
  if (free_.empty()) {
    number = balls_.size();
    balls_.append();
  } else {
    std::pop_heap(free_.begin(), free_.end(), std::greater<>());
    number = free_.back();
    free_.pop_back();
    balls_[number] = Ball();
  }
  balls_[number].list = lists_.add();
  balls_.set_bound(number, bound);
  changed_.push_back(number);
  return number;
}

void Core::remove(std::uint32_t number) {
  Ball& ball = balls_[number];
  forget_neighbours(number);
  lists_.remove(ball.list);
  if (ball.has_region()) cells_.leave(balls_, number);
  ball = Ball();
  ball.due = infinity;
  std::erase(changed_, number);
  if (near_ && (near_->first == number || near_->second == number)) {
    if (near_->first != number) changed_.push_back(near_->first);
    near_.reset();
  }
  free_.push_back(number);
  std::push_heap(free_.begin(), free_.end(), std::greater<>());
}

void Core::replace(std::uint32_t number, const Bound& bound) {
  if (balls_[number].has_region()) {
    forget_neighbours(number);
    cells_.leave(balls_, number);
  }
  balls_.set_bound(number, bound);
  changed_.push_back(number);
}

void Core::set_velocity(std::uint32_t number, const Vec3& velocity) {
  balls_.set_state(number, {balls_.position(number), velocity});
  changed_.push_back(number);
  if (near_ && near_->first == number) near_.reset();
}

/// Restores the invariants for balls that have changed.
void Core::settle_changes() {
  if (near_) changed_.push_back(near_->first);
  near_.reset();
  if (changed_.empty()) return;
  place_arrivals();
  for (const std::uint32_t number : changed_) compute_own(number);
  for (std::size_t k = 0; k < changed_.size(); ++k)
    if (k == 0 || changed_[k] != changed_[k - 1]) schedule(changed_[k]);
  changed_.clear();
  if (balls_.size() <= 2 * queued_for_) return;
  queue_.refill(balls_.all(), balls_.time());
  queued_for_ = balls_.size();
}

std::optional<Near> Core::next(double until) {
  settle_changes();
  for (;;) {
    const DueQueue::Entry first = queue_.first(balls_.all(), until);
    if (first.ball == none) break;
    queue_.pop();
    prefetch();
    balls_.set_time(std::max(balls_.time(), first.time));
    ++counters_.due;
    near_ = handle(first.ball);
    if (near_) return near_;
  }
  balls_.set_time(until);
  return std::nullopt;
}

std::optional<Near> Core::handle(std::uint32_t number) {
  const Ball& ball = balls_[number];
  if (ball.about == number) {
    schedule(number);
  } else if (ball.about != none) {
    return meet(number, ball.about);
  } else if (ball.wall != 0) {
    return meet_wall(number);
  } else {
    leave_region(number);
  }
  return std::nullopt;
}

/// Probes two neighbours until it is clear whether they are within the tolerance.
std::optional<Near> Core::meet(std::uint32_t number, std::uint32_t other) {
  while (!(least_gap(number, other) > tolerance_)) {
    const bool first_is_fresh = balls_.is_fresh(number), second_is_fresh = balls_.is_fresh(other);
    if (first_is_fresh && second_is_fresh) return Near{number, other};
    const bool first_is_older = balls_[number].time < balls_[other].time;
    probe(!first_is_fresh && (second_is_fresh || first_is_older) ? number : other);
  }
  postpone(number, apart_until(number, other, balls_[number].second - balls_.time()));
  return std::nullopt;
}

std::optional<Near> Core::meet_wall(std::uint32_t number) {
  const auto wall = static_cast<Wall>(balls_[number].wall);
  while (!(wall_gap(number, wall) - balls_.growth(number) > tolerance_)) {
    if (balls_.is_fresh(number)) return Near{number, none, wall};
    probe(number);
  }
  compute_own(number);
  schedule(number);
  return std::nullopt;
}

void Core::put_off(const Near& near, double time) {
  near_.reset();
  if (near.wall == Wall::none) return postpone(near.first, time);
  compute_own(near.first, near.wall);
  Ball& ball = balls_[near.first];
  if (time < ball.own) {
    ball.own = time;
    ball.wall = static_cast<std::uint8_t>(near.wall);
  }
  schedule(near.first);
}

/// Nothing happens between a ball and the neighbour that it is due about before `time`. What is known of the
/// others holds on.
void Core::postpone(std::uint32_t number, double time) {
  Ball& ball = balls_[number];
  if (time < ball.second) {
    ball.due = time;
  } else {
    ball.due = ball.second;
    ball.about = ball.second < ball.own ? number : none;
  }
  queue_.push(balls_.all(), number);
}

/// Computes when a ball is due: at its own time, or when it may touch a neighbour, if that is earlier.
void Core::schedule(std::uint32_t number) {
  Ball& ball = balls_[number];
  if (ball.scans < 255) ++ball.scans;
  ball.about = none;
  ball.due = ball.second = ball.own;
  const auto neighbours = lists_.at(ball.list);
  ++counters_.scans;
  counters_.scanned += neighbours.size();
  for (std::size_t k = 0; k < neighbours.size(); k += most_lanes) {
    const auto some = neighbours.subspan(k, std::min(neighbours.size() - k, most_lanes));
    for (std::uint32_t left = candidates(number, some); left != 0; left &= left - 1) {
      const std::uint32_t other = some[static_cast<std::size_t>(std::countr_zero(left))];
      ++counters_.candidates;
      consider(ball, other, apart_until(number, other, ball.second - balls_.time()));
    }
  }
  queue_.push(balls_.all(), number);
}

void Core::consider(Ball& ball, std::uint32_t other, double time) {
  if (!(time < ball.second)) return;
  if (time < ball.due) {
    ball.second = ball.due;
    ball.due = time;
    ball.about = other;
  } else {
    ball.second = time;
  }
}

/// Returns a bit for each of some neighbours that may be met before Ball::second.
std::uint32_t Core::candidates(std::uint32_t number, std::span<const std::uint32_t> neighbours) const {
  const Ball& ball = balls_[number];
  const double duration = ball.second - balls_.time();
  if (!balls_.any_drifts()) {
    const NearQuery query{balls_.time(),
                          duration,
                          balls_.position(number),
                          ball.velocity,
                          ball.radius + balls_.growth(number) + margin_,
                          balls_.growth_speed(number),
                          ball.acceleration_limit,
                          balls_.any_grows(),
                          &balls_.periods()};
    return may_meet(balls_.all().data(), neighbours.data(), neighbours.size(), query);
  }
  std::uint32_t found = 0;
  const BoundAt own = balls_.bound_now(number);
  for (std::size_t k = 0; k < neighbours.size(); ++k) {
    BoundAt other = balls_.bound_now(neighbours[k]);
    other.centre = own.centre + balls_.nearest(other.centre - own.centre);
    if (!QuickReject(own, other).stay_apart(duration, margin_)) found |= 1u << k;
  }
  return found;
}

/// Returns a time before which two neighbours do not touch; +infinity if they do not for `horizon` from now.
/// Returns the present time if reports have to decide.
double Core::apart_until(std::uint32_t number, std::uint32_t neighbour, double horizon) const {
  const BoundAt own = balls_.bound_now(number);
  BoundAt other = balls_.bound_now(neighbour);
  if (balls_.periods().any) other.centre = own.centre + balls_.nearest(other.centre - own.centre);
  const QuickReject pair(own, other);
  if (pair.stay_apart(horizon, margin_)) return infinity;
  if (pair.is_near(tolerance_)) {
    const bool straight = own.is_exact() && other.is_exact() && own.acceleration == other.acceleration;
    const bool parts =
        straight && recede_for_good({own.centre, own.velocity}, State{other.centre, other.velocity});
    return parts ? infinity : balls_.time();
  }
  return std::max(rounding::sum_down(balls_.time(), pair.meeting(horizon, margin_)), balls_.time());
}

double Core::least_gap(std::uint32_t number, std::uint32_t other) const {
  return norm(balls_.between(number, other)) - (balls_[number].radius + balls_[other].radius) -
         balls_.growth(number) - balls_.growth(other);
}

void Core::probe(std::uint32_t number) {
  ++counters_.probes;
  State state = reporter_.report(number, balls_.time());
  if (balls_.periods().any) {
    // The report may be of any image.
    const Vec3 expected = balls_.position(number);
    state.position = expected + balls_.nearest(state.position - expected);
  }
  balls_.set_state(number, state);
}

/// Fetches what the balls that are due next need. Some of them may have been removed since they were queued.
void Core::prefetch() const {
  const auto fetch = [this](std::uint32_t number) {
    prefetch_line(&balls_[number]);
    prefetch_line(&balls_[number].due);
  };
  const auto fetch_list = [this](const Ball& ball) {
    if (ball.has_region()) prefetch_line(lists_.address(ball.list));
  };
  if (const std::uint32_t later = queue_.coming(1); later != none) {
    fetch_list(balls_[later]);
    if (balls_[later].about != none) fetch(balls_[later].about);
  }
  const std::uint32_t next = queue_.coming(0);
  if (next == none || !balls_[next].has_region()) return;
  const Ball& ball = balls_[next];
  if (ball.about != none && ball.about != next) return fetch_list(balls_[ball.about]);
  for (const std::uint32_t other : lists_.at(ball.list)) fetch(other);
}

std::size_t Core::bytes() const { return balls_.bytes() + lists_.bytes() + cells_.bytes() + queue_.bytes(); }

}  // namespace kinesphere::core
