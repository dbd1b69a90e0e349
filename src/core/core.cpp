// The loop: what is due first, and what follows from it.
#include "core/core.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "bodies/body_bounds.hpp"
#include "bound/quick_reject.hpp"
#include "contact/contact_event.hpp"
#include "number/infinity.hpp"
#include "number/powers.hpp"
#include "number/scope_guard.hpp"

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

Core::Core(const WorldDefinition& definition)
    : dimensions_(definition.dimensions),
      unit_(region_unit(definition)),
      margin_(rounding_margin(definition)),
      tolerance_(definition.contact_tolerance),
      balls_(periods_of(Space(definition)), definition.start_time),
      cells_(balls_.periods().length / unit_, definition.dimensions) {
  for (int axis = 0; axis < 3; ++axis)
    if (balls_.periods().length[axis] > 0.0) origin_[axis] = definition.box->lower[axis];
  const std::optional<Box> box = walls_of(definition);
  for (const Wall wall : kinesphere::walls)
    if (box && stands(*box, wall)) walls_.emplace_back(wall, half_space(*box, wall));
}

void Core::enter(std::uint32_t number, const Bound& bound, bool is_passive, bool meets_walls) {
  balls_.grow(number + 1);
  Ball& ball = balls_[number] = Ball();
  ball.due = ball.second = ball.own = infinity;
  ball.set(Ball::passive, is_passive);
  ball.set(Ball::meets_walls, meets_walls);
  ball.set(Ball::arriving, true);
  ball.set(Ball::present, true);
  if (!is_passive) ball.list = lists_.add();
  balls_.set_bound(number, bound);
  place_region(number, 0.0);
  cells_.enter(balls_, number, reach(ball));
  ++present_;
}

void Core::leave(std::uint32_t number) {
  Ball& ball = balls_[number];
  forget_neighbours(number);
  if (!ball.is(Ball::passive)) lists_.remove(ball.list);
  cells_.leave(balls_, number);
  ball = Ball();
  ball.due = infinity;
  --present_;
}

void Core::set_bound(std::uint32_t number, const Bound& bound) {
  Ball& ball = balls_[number];
  // A ball that has become larger has so much less room in its safe region.
  const double larger = bound.radius - ball.radius;
  if (larger > 0.0) ball.region -= static_cast<float>((1.0 + 0x1p-20) * larger / unit_);
  balls_.set_bound(number, bound);
}

void Core::settle(std::span<const std::uint32_t> changed, Host& host) {
  settling_.assign(changed.begin(), changed.end());
  place_arrivals(changed, host);
  for (const std::uint32_t number : changed) {
    compute_own(number, host);
    // It may be elsewhere. Others find it by its safe region.
    if (balls_[number].is(Ball::at_wall) || balls_[number].own > balls_.time()) continue;
    move_region(number, host);
  }
  for (const std::uint32_t number : settling_) schedule(number, host);
  if (balls_.size() <= 2 * queued_for_) return;
  queue_.refill(balls_.all(), balls_.time());
  queued_for_ = balls_.size();
}

std::optional<Core::Certificate> Core::certificate_of(std::uint32_t number) const {
  if (!contains(number)) return std::nullopt;
  const Ball& ball = balls_[number];
  const bool is_about_walls = ball.about == none && ball.is(Ball::at_wall);
  if (ball.about == number || (ball.about == none && !is_about_walls)) return std::nullopt;
  return Certificate{ball.about, ball.due};
}

Result<void> Core::handle_next(Host& host) {
  const DueQueue::Entry first = queue_.first(balls_.all(), balls_.time());
  queue_.pop();
  prefetch();
  ScopeGuard again([&] { queue_.push(balls_.all(), first.ball); });
  auto handled = handle(first.ball, host);
  if (handled) again.dismiss();
  return handled;
}

Result<void> Core::handle(std::uint32_t number, Host& host) {
  const std::uint32_t other = balls_[number].about;
  if (other == none) return handle_own(number, host);
  // One that was linked may be gone.
  if (other == number || !contains(other)) {
    schedule(number, host);
    return {};
  }
  // What the host says of the two holds until the own time of either.
  if (!(balls_[other].own > balls_.time()))
    if (auto handled = handle_own(other, host); !handled) return handled;
  const Result<double> until = host.recheck(number, other);
  if (!until) return until.error();
  postpone(number, *until);
  // The other one may be due about the same.
  if (balls_[other].about == number && balls_[other].due <= balls_.time()) postpone(other, *until);
  return {};
}

/// The ball may leave its safe region, or concern a wall.
Result<void> Core::handle_own(std::uint32_t number, Host& host) {
  if (!balls_[number].is(Ball::at_wall)) return leave_region(number, host);
  // The host looks as far ahead as the ball stays in its safe region.
  const double own = balls_[number].own;
  compute_stay(number);
  ScopeGuard again([&] {
    balls_[number].own = own;
    balls_[number].set(Ball::at_wall, true);
  });
  const Result<double> until = host.recheck_walls(number);
  if (!until) return until.error();
  again.dismiss();
  limit_own(number, *until);
  schedule(number, host);
  return {};
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

/// Computes when a ball is due: at its own time, or when something may happen between it and a neighbour, if
/// that is earlier.
void Core::schedule(std::uint32_t number, Host& host) {
  Ball& ball = balls_[number];
  if (ball.is(Ball::passive)) return;
  if (ball.scans < 255) ++ball.scans;
  ball.about = none;
  ball.due = ball.second = ball.own;
  ball.set(Ball::crowded, false);
  const auto neighbours = lists_.at(ball.list);
  Counters& work = host.work_counters();
  for (std::size_t k = 0; k < neighbours.size(); k += most_lanes) {
    const auto some = neighbours.subspan(k, std::min(neighbours.size() - k, most_lanes));
    std::array<double, most_lanes> apart;
    for (std::uint32_t left = candidates(number, some, ball.second - balls_.time(), apart); left != 0;
         left &= left - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(left));
      const std::uint32_t other = some[lane];
      double until = rounding::sum_down(balls_.time(), apart[lane]);
      if (!(until > balls_.time())) until = apart_until(number, other, ball.second - balls_.time(), host);
      ++work.certificates;
      if (until < ball.own) ++work.hot_pairs;
      consider(ball, other, until);
    }
  }
  if (ball.is(Ball::linked))
    for (const std::uint32_t other : host.linked_with(number))
      consider(ball, other, host.unchanged_until(number, other));
  queue_.push(balls_.all(), number);
}

/// Something may happen between a ball and a neighbour at this time. Of two at the same time, the ball is due
/// about the one with the lower number, in whatever order they are considered.
void Core::consider(Ball& ball, std::uint32_t other, double time) {
  if (time == ball.due && ball.about != none && other < ball.about) {
    ball.second = time;
    ball.about = other;
    return;
  }
  if (!(time < ball.second)) return;
  if (time < ball.due) {
    ball.second = ball.due;
    ball.due = time;
    ball.about = other;
  } else {
    ball.second = time;
  }
}

/// Returns a bit for each of some neighbours that may be met within this time from now, and how long each of
/// these is certainly not met (may_meet() in near_lanes.hpp).
std::uint32_t Core::candidates(std::uint32_t number, std::span<const std::uint32_t> neighbours,
                               double duration, std::span<double, most_lanes> apart) const {
  const Ball& ball = balls_[number];
  if (!balls_.any_drifts()) {
    const NearQuery query{balls_.time(),
                          duration,
                          balls_.position(number),
                          ball.velocity,
                          ball.radius + balls_.growth(number) + margin_,
                          margin_,
                          tolerance_ - margin_,
                          balls_.growth_speed(number),
                          ball.acceleration_limit,
                          balls_.any_grows(),
                          &balls_.periods()};
    return may_meet(balls_.all().data(), neighbours.data(), neighbours.size(), query, apart.data());
  }
  std::fill(apart.begin(), apart.end(), 0.0);
  std::uint32_t found = 0;
  const BoundAt own = balls_.bound_now(number);
  for (std::size_t k = 0; k < neighbours.size(); ++k) {
    BoundAt other = balls_.bound_now(neighbours[k]);
    other.centre = own.centre + balls_.nearest(other.centre - own.centre);
    if (!QuickReject(own, other).stay_apart(duration, margin_)) found |= 1u << k;
  }
  return found;
}

/// Returns a time before which nothing happens between two neighbours; +infinity if nothing does for
/// `horizon` from now. Returns the present time if reports have to decide.
double Core::apart_until(std::uint32_t number, std::uint32_t neighbour, double horizon, Host& host) {
  const BoundAt own = balls_.bound_now(number);
  BoundAt other = balls_.bound_now(neighbour);
  if (balls_.periods().any) other.centre = own.centre + balls_.nearest(other.centre - own.centre);
  const QuickReject pair(own, other);
  if (pair.stay_apart(horizon, margin_)) return infinity;
  if (!pair.is_near(tolerance_)) {
    const double time = rounding::sum_down(balls_.time(), pair.meeting(horizon, margin_));
    if (time > balls_.time()) return time;
  }
  balls_[number].set(Ball::crowded, true);
  return host.unchanged_until(number, neighbour);
}

/// Fetches what the balls that are due next need. Some of them may have been removed since they were queued.
void Core::prefetch() const {
  const auto fetch = [this](std::uint32_t number) {
    prefetch_line(&balls_[number]);
    prefetch_line(&balls_[number].due);
  };
  const auto fetch_list = [this](const Ball& ball) {
    if (ball.list != none) prefetch_line(lists_.address(ball.list));
  };
  if (const std::uint32_t later = queue_.coming(1); later != none) {
    fetch_list(balls_[later]);
    if (balls_[later].about != none) fetch(balls_[later].about);
  }
  const std::uint32_t next = queue_.coming(0);
  if (next == none || balls_[next].list == none) return;
  const Ball& ball = balls_[next];
  if (ball.about != none && ball.about != next) return fetch_list(balls_[ball.about]);
  for (const std::uint32_t other : lists_.at(ball.list)) fetch(other);
}

}  // namespace kinesphere::core
