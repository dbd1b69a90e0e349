// The loop: what is due first, and what follows from it.
#include "core/core.hpp"

#include <algorithm>
#include <array>

#include "bodies/body_bounds.hpp"
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
  Periods periods{.length = space.period(),
                  .slide_speed = space.slide_speed(),
                  .any = space.repeats(),
                  .slides = space.slides()};
  for (int axis = 0; axis < 3; ++axis)
    if (space.repeats(axis)) periods.inverse[axis] = 1.0 / periods.length[axis];
  return periods;
}

/// Returns the periods that a search in cells knows (region units). Those of y are left out where images
/// slide: Core::search_rows() has them.
Vec3 periods_of_cells(const Space& space, double unit) {
  const Vec3 periods = space.period() / unit;
  return space.slides() ? Vec3{periods.x, 0.0, periods.z} : periods;
}

}  // namespace

Core::Core(const WorldDefinition& definition)
    : dimensions_(definition.dimensions),
      space_(definition),
      unit_(region_unit(definition)),
      margin_(rounding_margin(definition)),
      tolerance_(definition.contact_tolerance),
      parting_(ContactRule(definition).release_gap()),
      balls_(periods_of(space_), definition.start_time),
      cells_(periods_of_cells(space_, unit_), definition.dimensions) {
  for (int axis = 0; axis < 3; ++axis)
    if (balls_.periods().length[axis] > 0.0) origin_[axis] = definition.box->lower[axis];
  const std::optional<Box> box = walls_of(definition);
  for (const Wall wall : kinesphere::walls)
    if (box && stands(*box, wall)) walls_.emplace_back(wall, half_space(*box, wall));
}

void Core::enter(std::uint32_t number, const Bound& bound, bool is_passive, bool meets_walls) {
  balls_.grow(number + 1);
  if (changes_.size() < balls_.size()) changes_.resize(balls_.size());
  changes_[number] = 0;
  if (space_.slides()) search_ends_.resize(balls_.size(), infinity);
  Ball& ball = balls_[number] = Ball();
  ball.due = ball.second = ball.own = infinity;
  ball.set(Ball::passive, is_passive);
  ball.set(Ball::meets_walls, meets_walls);
  ball.set(Ball::arriving, true);
  ball.set(Ball::present, true);
  if (!is_passive) ball.list = lists_.add();
  balls_.set_bound(number, bound);
  ++present_;
  ++arriving_;
}

void Core::show(std::uint32_t number) {
  place_region(number, 0.0);
  cells_.enter(balls_, number, reach(balls_[number]));
}

void Core::leave(std::uint32_t number) {
  Ball& ball = balls_[number];
  if (ball.is(Ball::arriving)) --arriving_;
  forget_neighbours(number);
  if (!ball.is(Ball::passive)) lists_.remove(ball.list);
  if (ball.has_region()) cells_.leave(balls_, number);
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
  note_course(number);
}

void Core::settle(std::span<const std::uint32_t> changed, Host& host, PoolLease& lease) {
  settling_.assign(changed.begin(), changed.end());
  place_arrivals(changed, host);
  if (is_batch(changed))
    set_own_of_many(changed, host, lease);
  else
    for (const std::uint32_t number : changed) {
      set_own(number, stays(number), host);
      if (may_be_elsewhere(number)) move_region(number, host);
    }
  note_changes(settling_, host, lease);
  // For many more balls than before, the queue is made anew.
  const bool are_many_more = balls_.size() > 2 * queued_for_;
  if (are_many_more) queue_.forget();
  if (is_batch(settling_))
    schedule_many(settling_, host, lease);
  else
    for (const std::uint32_t number : settling_) schedule(number, false, host);
  if (!are_many_more) return;
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
  const std::uint32_t number = queue_.take_first();
  prefetch();
  ScopeGuard again([&] { queue_.push(balls_.all(), number); });
  auto handled = handle(number, host);
  if (handled) again.dismiss();
  return handled;
}

Result<void> Core::handle(std::uint32_t number, Host& host) {
  const std::uint32_t other = balls_[number].about;
  if (other == none) return handle_own(number, host);
  // One that was linked may be gone.
  if (other == number || !contains(other)) {
    schedule(number, false, host);
    return {};
  }
  // What the host says of the two holds until the own time of either.
  if (!(balls_[other].own > balls_.time()))
    if (auto handled = handle_own(other, host); !handled) return handled;
  const Result<double> until = recheck(number, other, host);
  if (!until) return until.error();
  postpone(number, *until);
  // The other one may be due about the same.
  if (balls_[other].about == number && balls_[other].due <= balls_.time())
    postpone(other, std::min(*until, balls_[number].own));
  return {};
}

/// Finds out whether something happens between a ball and a neighbour now. As long as their bounds may be
/// near each other, the older one reports; both at once if they are exact, since one report would not change
/// when they may meet. When both reports are of now, the host decides. Returns a time before which nothing
/// happens between them, as Host::recheck() does.
Result<double> Core::recheck(std::uint32_t number, std::uint32_t other, Host& host) {
  ++host.work_counters(number).pair_checks;
  const Ball &ball = balls_[number], &partner = balls_[other];
  const auto is_plain = [](const Ball& each) { return each.is(Ball::plain) && !each.is(Ball::linked); };
  const auto ask_host = [&]() -> Result<double> {
    const Result<double> until = host.recheck(number, other);
    if (!until) return until.error();
    return std::min(*until, holds_until(number, other));
  };
  if (!is_plain(ball) || !is_plain(partner)) return ask_host();
  const double now = balls_.time();
  const bool are_exact = balls_.is_exact(number) && balls_.is_exact(other);
  for (;;) {
    const double until = apart_until(number, other, ball.own - now);
    ++host.work_counters(number).certificates;
    if (until > now) return until;
    if (ball.time == now && partner.time == now) return ask_host();
    const bool is_first = ball.time < partner.time;
    const std::array<std::uint32_t, 2> older{is_first ? number : other, is_first ? other : number};
    const bool asks_both = are_exact && std::max(ball.time, partner.time) < now;
    const Result<bool> kept = host.report(std::span(older).first(asks_both ? 2 : 1), Host::Reason::near);
    if (!kept) return kept.error();
    if (!*kept) return infinity;
    if (are_exact) return ask_host();
  }
}

/// The ball may leave its safe region, or concern a wall.
Result<void> Core::handle_own(std::uint32_t number, Host& host) {
  if (!balls_[number].is(Ball::at_wall)) return leave_region(number, host);
  // The host looks as far ahead as the ball stays in its safe region.
  const double own = balls_[number].own;
  set_stay(number, stays(number));
  ScopeGuard again([&] {
    balls_[number].own = own;
    balls_[number].set(Ball::at_wall, true);
  });
  const Result<double> until = host.recheck_walls(number);
  if (!until) return until.error();
  again.dismiss();
  limit_own(number, *until);
  schedule_anew(number, host);
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
  note_course(number);
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
