// The scan of a ball's neighbours: when it is due.
#include <algorithm>
#include <array>
#include <bit>

#include "bound/quick_reject.hpp"
#include "core/core.hpp"
#include "number/infinity.hpp"

namespace kinesphere::core {

/// A ball has changed: it looks out for all of its neighbours from now on, and for those that it touches.
void Core::note_change(std::uint32_t number, Host& host) {
  Ball& ball = balls_[number];
  ball.set(Ball::crowded, false);
  std::uint64_t last = changes_[number];
  for (const std::uint32_t other : lists_.at(ball.list)) last = std::max(last, changes_[other]);
  find_linked(number, linked_, host);
  for (const std::uint32_t other : linked_) last = std::max(last, changes_[other]);
  changes_[number] = last + 1;
}

/// Computes when a ball is due: at its own time, or when something may happen between it and a neighbour that
/// it looks out for, if that is earlier. `is_last`: it has changed last of all of them, so it looks out for
/// all.
void Core::schedule(std::uint32_t number, bool is_last, Host& host) {
  if (balls_[number].is(Ball::passive)) return;
  find_due(number, is_last, host);
  queue_.push(balls_.all(), number);
  note_course(number);
}

void Core::find_due(std::uint32_t number, bool is_last, Host& host) {
  Ball& ball = balls_[number];
  begin_scan(ball);
  const auto neighbours = lists_.at(ball.list);
  find_linked(number, linked_, host);
  Counters& work = host.work_counters(number);
  for (std::size_t k = 0; k < neighbours.size(); k += most_lanes) {
    std::array<std::uint32_t, most_lanes> room;
    auto some = neighbours.subspan(k, std::min(neighbours.size() - k, most_lanes));
    if (!is_last) some = looked_out_for(number, some, room);
    std::array<double, most_lanes> apart;
    for (std::uint32_t left = candidates(number, some, ball.second - balls_.time(), apart); left != 0;
         left &= left - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(left));
      if (!look_out_for(number, some[lane], apart[lane], linked_, work, host)) continue;
      ball.set(Ball::crowded, true);
      balls_[some[lane]].set(Ball::crowded, true);
    }
  }
  look_out_for_linked(number, linked_, work, host);
}

/// The list of a ball is about to be scanned.
void Core::begin_scan(Ball& ball) {
  if (ball.scans < 255) ++ball.scans;
  ball.about = none;
  ball.due = ball.second = ball.own;
}

void Core::find_linked(std::uint32_t number, std::vector<std::uint32_t>& linked, Host& host) const {
  linked.clear();
  if (balls_[number].is(Ball::linked)) host.linked_with(number, linked);
}

/// A ball may meet a neighbour, but certainly does not for the time `apart`. `linked`: those with which it is
/// linked. Returns true if the two may be in touch.
bool Core::look_out_for(std::uint32_t number, std::uint32_t other, double apart,
                        std::span<const std::uint32_t> linked, Counters& work, Host& host) {
  Ball& ball = balls_[number];
  double until = rounding::sum_down(balls_.time(), apart);
  if (!(until > balls_.time())) {
    if (std::binary_search(linked.begin(), linked.end(), other)) return true;
    until = apart_until(number, other, ball.second - balls_.time());
  }
  const bool are_near = !(until > balls_.time());
  if (are_near) until = std::min(host.unchanged_until(number, other), holds_until(number, other));
  ++work.certificates;
  if (until < ball.own) ++work.hot_pairs;
  consider(ball, other, until);
  return are_near;
}

void Core::look_out_for_linked(std::uint32_t number, std::span<const std::uint32_t> linked, Counters& work,
                               Host& host) {
  for (const std::uint32_t other : linked) {
    if (!looks_out_for(number, other)) continue;
    ++work.certificates;
    consider(balls_[number], other,
             std::min(host.unchanged_until(number, other), holds_until(number, other)));
  }
}

/// Computes when a ball is due that has a later own time than before.
void Core::schedule_anew(std::uint32_t number, Host& host) {
  const bool looks_out_for_all = balls_.is_exact(number);
  if (looks_out_for_all) note_change(number, host);
  schedule(number, looks_out_for_all, host);
}

/// Returns how long it holds what the host says of a ball and one that it looks out for, which is that
/// nothing happens before a time or the own time of either: until the own time of the other one. If that one
/// is in exact flight, it looks out for the ball from then on (schedule_anew()).
double Core::holds_until(std::uint32_t number, std::uint32_t other) const {
  return balls_.is_exact(number) && balls_.is_exact(other) ? infinity : balls_[other].own;
}

/// Returns those of some neighbours that a ball looks out for. There has to be room for all of them.
std::span<const std::uint32_t> Core::looked_out_for(std::uint32_t number,
                                                    std::span<const std::uint32_t> neighbours,
                                                    std::span<std::uint32_t> room) const {
  std::size_t count = 0;
  for (const std::uint32_t neighbour : neighbours) {
    room[count] = neighbour;
    count += static_cast<std::size_t>(looks_out_for(number, neighbour));
  }
  return room.first(count);
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

/// What concerns all pairs now.
PairQuery Core::pair_query() const { return balls_.pair_query(margin_, tolerance_ - margin_); }

/// Returns a bit for each of some neighbours that may be met within this time from now, and how long each of
/// these is certainly not met (may_meet() in near_lanes.hpp).
std::uint32_t Core::candidates(std::uint32_t number, std::span<const std::uint32_t> neighbours,
                               double duration, std::span<double, most_lanes> apart) const {
  const BoundAt own = balls_.bound_now(number);
  const NearQuery query{.pairs = pair_query(),
                        .duration = duration,
                        .position = own.centre,
                        .velocity = own.velocity,
                        .radius = own.radius + margin_,
                        .speed = own.speed,
                        .growth = own.growth,
                        .plan = own.acceleration};
  return may_meet(balls_.all().data(), neighbours.data(), neighbours.size(), query, apart.data());
}

/// Returns apart_until() of two bounds in the images in which they are nearest.
[[gnu::always_inline]] inline double Core::apart_until(const BoundAt& own, const BoundAt& other,
                                                       double horizon) const {
  const QuickReject pair(own, other);
  // What is near is never put off here: only the host remembers that it has been.
  if (pair.is_near(tolerance_)) return balls_.time();
  if (pair.stay_apart(horizon, margin_)) return infinity;
  return std::max(rounding::sum_down(balls_.time(), pair.meeting(horizon, margin_)), balls_.time());
}

/// Returns a time before which the bounds of two neighbours do not come near each other; +infinity if they do
/// not for `horizon` from now. Returns the present time if they may be near each other now, so that reports
/// have to decide.
double Core::apart_until(std::uint32_t number, std::uint32_t neighbour, double horizon) const {
  if (space_.slides()) return apart_in_rows_until(number, neighbour, horizon);
  const BoundAt own = balls_.bound_now(number);
  BoundAt other = balls_.bound_now(neighbour);
  if (balls_.periods().any) other.centre = own.centre + balls_.nearest(other.centre - own.centre);
  return apart_until(own, other, horizon);
}

/// The same where images slide.
double Core::apart_in_rows_until(std::uint32_t number, std::uint32_t neighbour, double horizon) const {
  const BoundAt own = balls_.bound_now(number);
  BoundAt other = balls_.bound_now(neighbour);
  const Vec3 way = other.centre - own.centre;
  other.centre = own.centre + balls_.nearest_in_rows(way);
  other.velocity.x -= balls_.rows(way) * space_.slide_speed();
  return apart_until(own, other, horizon);
}

}  // namespace kinesphere::core
