// When a ball can leave its safe region or touch a wall.
#include <algorithm>
#include <cmath>

#include "bound/rounding.hpp"
#include "contact/contact_event.hpp"
#include "contact/contact_predictor.hpp"
#include "core/core.hpp"
#include "number/infinity.hpp"

namespace kinesphere::core {

/// Computes Ball::own, given how long the ball stays in its safe region.
void Core::set_own(std::uint32_t number, double stay, Host& host) {
  set_stay(number, stay);
  if (balls_[number].walls != 0) limit_own(number, clear_of_walls(number, host));
}

/// Computes Ball::own as set_own() does, later than now. Where there is too little room for the least step of
/// time, nothing better can be said.
void Core::set_own_later(std::uint32_t number, double stay, Host& host) {
  set_own(number, stay, host);
  Ball& ball = balls_[number];
  if (!ball.is(Ball::at_wall)) ball.own = std::max(ball.own, just_after(balls_.time()));
}

/// Computes Ball::own as if there were no walls.
void Core::set_stay(std::uint32_t number, double stay) {
  Ball& ball = balls_[number];
  ball.own = std::max(rounding::sum_down(balls_.time(), stay), balls_.time());
  ball.set(Ball::at_wall, false);
}

/// Nothing happens between the ball and the walls before this time. The host has looked no farther than until
/// Ball::own.
void Core::limit_own(std::uint32_t number, double walls_until) {
  Ball& ball = balls_[number];
  if (!(walls_until < ball.own)) return;
  ball.own = walls_until;
  ball.set(Ball::at_wall, true);
}

StayCounts Core::count_stays() const {
  StayCounts counts;
  for (std::uint32_t number = 0; number < balls_.size(); ++number) {
    const Ball& ball = balls_[number];
    if (ball.is_present() && ball.own < infinity && !is_ghost(number)) counts.add(ball.own - balls_.time());
  }
  return counts;
}

/// Returns a time before which nothing happens between the ball and the walls; now if reports have to decide.
double Core::clear_of_walls(std::uint32_t number, Host& host) const {
  const Ball& ball = balls_[number];
  double clear = ball.is(Ball::linked) ? 0.0 : infinity;
  for (const auto& [wall, inside] : walls_)
    if ((ball.walls & wall_bit(wall)) != 0) clear = std::min(clear, clear_of_wall(number, inside));
  if (clear == 0.0) return host.walls_unchanged_until(number);
  return std::max(rounding::sum_down(balls_.time(), clear), balls_.time());
}

/// Returns a time for which the ball stays, from now on, so near the centre of its safe region on axes that
/// repeat that its image is certain (widest_region()), as it does in a region that is not wider, and for
/// which its last search holds in images that slide.
double Core::keeps_image(std::uint32_t number) const {
  const Ball& ball = balls_[number];
  const double widest = widest_region(ball);
  if (!(double{ball.region} * unit_ > widest) || ball.is(Ball::passive)) return searched_for(number);
  const Vec3 way = balls_.position(number) - region_centre(ball), velocity = balls_.velocity(number);
  const double limit = ball.acceleration_limit + norm_one(balls_.plan(number));
  double time = searched_for(number);
  for (int axis = 0; axis < 3; ++axis) {
    if (!(balls_.periods().length[axis] > 0.0)) continue;
    const double room = widest - margin_ - balls_.growth(number) - std::abs(way[axis]);
    if (!(room > 0.0)) return 0.0;
    time = std::min(time, rounding::first_crossing(
                              room, -(std::abs(velocity[axis]) + balls_.growth_speed(number)), -limit));
  }
  return time;
}

/// Returns a time for which the ball stays in its safe region from now on, where its image is certain and its
/// last search holds.
double Core::stays(std::uint32_t number) const {
  const double stay = stays_inside(number);
  return balls_.periods().any ? std::min(stay, keeps_image(number)) : stay;
}

/// Returns a time for which the centre stays in the safe region from now on.
///
/// Ahead of now, the bound is a ball around q + v t that grows; q is seen from the middle of the region. What
/// a planned acceleration adds counts as growth. The way that is left to the border of the region, which is
/// its radius less the growth and |q + v t|, is a concave function of t. So if it is positive at both ends of
/// a span, it is positive throughout: a time is guessed by Newton's method, and then tried.
double Core::stays_inside(std::uint32_t number) const {
  const Ball& ball = balls_[number];
  const Vec3 q = balls_.position(number) - region_centre(ball), v = balls_.velocity(number);
  const double rate = balls_.growth_speed(number),
               limit = ball.acceleration_limit + norm_one(balls_.plan(number));
  if (ball.is(Ball::passive)) return infinity;
  const double room = double{ball.region} * unit_ - margin_ - balls_.growth(number);
  const double qq = norm_squared(q), qv = dot(q, v), vv = norm_squared(v);
  const bool moves = v != Vec3{}, grows = rate > 0.0 || limit > 0.0;
  if (!(room > 0.0) || !(qq < room * room)) return 0.0;
  if (!moves && !grows) return infinity;
  // Of the slowest, squares underflow.
  if (vv < 0x1p-800)
    return rounding::first_crossing(room - (1.0 + 0x1p-40) * std::sqrt(qq), -(norm_one(v) + rate), -limit);
  double guess;
  if (grows) {
    guess = 2.0 * room / (rate + std::sqrt(rate * rate + 2.0 * limit * room));
    // Its motion alone takes it out by then; what grows may be so little that squares of `guess` overflow.
    if (moves) guess = std::min(guess, (room + std::sqrt(qq)) / std::sqrt(vv));
    for (int step = 0; step < 3; ++step) {
      const double distance = std::sqrt(std::max(qq + (2.0 * qv + vv * guess) * guess, 0x1p-900));
      const double left = room - (rate + 0.5 * limit * guess) * guess - distance;
      guess += left / (rate + limit * guess + (qv + vv * guess) / distance);
    }
    guess *= 1.0 - 0x1p-7;
  } else {
    const double root = std::sqrt(qv * qv + vv * (room * room - qq));
    guess = (1.0 - 0x1p-30) * (qv > 0.0 ? (room * room - qq) / (root + qv) : (root - qv) / vv);
  }
  for (int tries = 0; tries < 64; ++tries, guess *= 0.75) {
    const double left = room - (rate + 0.5 * limit * guess) * guess;
    const double square = qq + (2.0 * qv + vv * guess) * guess;
    const double rounding = 0x1p-48 * (qq + (2.0 * std::abs(qv) + vv * guess) * guess);
    if (left > 0.0 && square + rounding < left * left) return guess;
  }
  return 0.0;
}

/// Returns a time for which the ball does not touch this wall; 0 if it may do so now.
double Core::clear_of_wall(std::uint32_t number, const HalfSpace& inside) const {
  const Vec3& inwards = inside.normal;
  const double speed = dot(inwards, balls_.velocity(number)) - balls_.growth_speed(number);
  const double acceleration = dot(inwards, balls_.plan(number)) - balls_[number].acceleration_limit;
  const double gap =
      dot(inwards, balls_.position(number)) - inside.offset - balls_[number].radius - balls_.growth(number);
  if (speed >= 0.0 && acceleration >= 0.0 && gap > 0.0) return infinity;
  return gap > tolerance_ ? rounding::first_crossing(gap - margin_, speed, acceleration) : 0.0;
}

}  // namespace kinesphere::core
