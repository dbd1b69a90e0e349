// Many balls that change at once: passes over all of them, in groups, instead of one ball after the other.
// Threads share each pass in parts that follow each other. What a ball is due about, and when, is as if each
// had changed after those with lower numbers.
#include <algorithm>
#include <array>

#include "bound/rounding.hpp"
#include "core/core.hpp"
#include "number/infinity.hpp"

namespace kinesphere::core {
namespace {

/// So many balls are a batch.
constexpr std::size_t batch = 64;
/// Least number of balls in a part.
constexpr std::size_t least_part = 1024;
/// The pairs of so many balls are listed at a time.
constexpr std::size_t listed_at_once = 256;

}  // namespace

/// Returns true if these are better settled in passes. A core with ghosts notes the course of each ball.
bool Core::is_batch(std::span<const std::uint32_t> changed) const {
  return changed.size() >= batch && ghosts_ == nullptr;
}

/// Calls work(some, part) for parts of a batch, in several threads. Each part has a place of its own in
/// parts_, in their order.
void Core::for_each_part(std::span<const std::uint32_t> changed, PoolLease& lease, auto work) {
  parts_.resize(std::max(parts_.size(), (changed.size() + least_part - 1) / least_part));
  for (Part& part : parts_) {
    part.undecided.clear();
    part.leaving.clear();
    part.near.clear();
    part.queued.clear();
    part.work = {};
  }
  lease.parallel_for(changed.size(), least_part, [&](std::size_t from, std::size_t to, std::size_t) {
    work(changed.subspan(from, to - from), parts_[from / least_part]);
  });
}

/// Computes Ball::own of changed balls. Those that may be elsewhere get another safe region.
void Core::set_own_of_many(std::span<const std::uint32_t> changed, Host& host, PoolLease& lease) {
  PoolLease alone;
  for_each_part(changed, walls_.empty() || host.answers_threads() ? lease : alone,
                [&](std::span<const std::uint32_t> some, Part& part) { set_own_of_some(some, part, host); });
  for (const Part& part : parts_)
    for (const std::uint32_t number : part.leaving) move_region(number, host);
}

void Core::set_own_of_some(std::span<const std::uint32_t> some, Part& part, Host& host) {
  const StayQuery query{.now = balls_.time(), .unit = unit_, .origin = origin_, .margin = margin_};
  const bool none_drifts = balls_.drifts() == nullptr;
  for (std::size_t k = 0; k < some.size(); k += group_lanes) {
    std::array<std::uint32_t, group_lanes> group;
    const std::size_t count = std::min(some.size() - k, group_lanes);
    for (std::size_t lane = 0; lane < group_lanes; ++lane) group[lane] = some[k + std::min(lane, count - 1)];
    std::array<double, group_lanes> stay;
    stay.fill(-1.0);
    if (none_drifts) stays_in_flight(balls_.all().data(), group.data(), group_lanes, query, stay.data());
    for (std::size_t lane = 0; lane < count; ++lane) {
      const std::uint32_t number = group[lane];
      if (stay[lane] < 0.0 || balls_[number].is(Ball::passive)) stay[lane] = stays_inside(number);
      if (balls_.periods().any) stay[lane] = std::min(stay[lane], keeps_image(number));
      set_own(number, stay[lane], host);
      if (may_be_elsewhere(number)) part.leaving.push_back(number);
    }
  }
}

/// The balls have changed, each after those with lower numbers (note_change()).
void Core::note_changes(std::span<const std::uint32_t> changed, Host& host, PoolLease& lease) {
  // Where all numbers are looked at, neighbours need not be.
  if (!is_batch(changed) || 16 * changed.size() < changes_.size()) {
    for (const std::uint32_t number : changed)
      if (!balls_[number].is(Ball::passive)) note_change(number, host);
    return;
  }
  const std::uint64_t last = *std::max_element(changes_.begin(), changes_.end());
  for_each_part(changed, lease, [&](std::span<const std::uint32_t> some, Part&) {
    for (const std::uint32_t number : some) {
      Ball& ball = balls_[number];
      if (ball.is(Ball::passive)) continue;
      ball.set(Ball::crowded, false);
      changes_[number] = last + 1;
    }
  });
}

/// Computes when changed balls are due, as schedule() does.
void Core::schedule_many(std::span<const std::uint32_t> changed, Host& host, PoolLease& lease) {
  const bool threads_ask = host.answers_threads();
  for_each_part(changed, lease, [&](std::span<const std::uint32_t> some, Part& part) {
    for (std::size_t k = 0; k < some.size(); k += listed_at_once)
      find_due_of(some.subspan(k, std::min(some.size() - k, listed_at_once)), part);
    if (!threads_ask) return;
    ask_host(part, host);
    for (const std::uint32_t number : some)
      if (queue_.lacks(balls_.all(), number)) part.queued.push_back(number);
  });
  std::vector<std::uint32_t>& queued = parts_.front().queued;
  for (Part& part : parts_) {
    if (!threads_ask) ask_host(part, host);
    for (const std::uint32_t number : part.near) balls_[number].set(Ball::crowded, true);
    host.work_counters(changed.front()) += part.work;
    if (&part != &parts_.front()) queued.insert(queued.end(), part.queued.begin(), part.queued.end());
  }
  queue_.push(balls_.all(), threads_ask ? queued : changed);
}

/// Begins the scan of some balls, and lists the pairs of each and those that it looks out for, ball by ball.
/// One that is linked is paired with itself, which is never apart. Returns their number; behind them, the
/// last pair fills the group.
std::size_t Core::list_pairs(std::span<const std::uint32_t> some, Part& part) {
  std::size_t count = 0;
  for (const std::uint32_t number : some) {
    Ball& ball = balls_[number];
    if (ball.is(Ball::passive)) continue;
    begin_scan(ball);
    const auto neighbours = lists_.at(ball.list);
    if (part.first.size() < count + neighbours.size() + group_lanes + 1) {
      part.first.resize(2 * (count + neighbours.size() + group_lanes + 1));
      part.second.resize(part.first.size());
      part.apart.resize(part.first.size());
    }
    std::uint32_t* const first = part.first.data();
    std::uint32_t* const second = part.second.data();
    for (const std::uint32_t other : neighbours) {
      first[count] = number;
      second[count] = other;
      count += static_cast<std::size_t>(looks_out_for(number, other));
    }
    first[count] = second[count] = number;
    count += static_cast<std::size_t>(ball.is(Ball::linked));
  }
  if (count == 0) return 0;
  for (std::size_t k = 0; k < group_lanes; ++k) {
    part.first[count + k] = part.first[count - 1];
    part.second[count + k] = part.second[count - 1];
  }
  return count;
}

/// Computes when some balls are due, except for those that are linked, or near one that they look out for:
/// Part::undecided gets all that they may meet.
void Core::find_due_of(std::span<const std::uint32_t> some, Part& part) {
  const std::size_t count = list_pairs(some, part);
  pairs_stay_apart(balls_.all().data(), part.first.data(), part.second.data(), count, pair_query(),
                   part.apart.data());
  const double now = balls_.time();
  std::vector<Meeting>& undecided = part.undecided;
  for (std::size_t k = 0; k < count;) {
    if (part.apart[k] == infinity) {
      ++k;
      continue;
    }
    const std::uint32_t number = part.first[k];
    const std::size_t before = undecided.size();
    bool is_decided = true;
    for (; k < count && part.first[k] == number; ++k) {
      if (part.apart[k] == infinity) continue;
      undecided.push_back({number, part.second[k], part.apart[k]});
      is_decided = is_decided && rounding::sum_down(now, part.apart[k]) > now;
    }
    if (!is_decided) continue;
    for (std::size_t found = before; found < undecided.size(); ++found) {
      const double until = rounding::sum_down(now, undecided[found].apart);
      ++part.work.certificates;
      part.work.hot_pairs += static_cast<std::uint64_t>(until < balls_[number].own);
      consider(balls_[number], undecided[found].other, until);
    }
    undecided.resize(before);
  }
}

/// Computes when those are due that are undecided, ball by ball.
void Core::ask_host(Part& part, Host& host) {
  const std::vector<Meeting>& undecided = part.undecided;
  for (std::size_t k = 0; k < undecided.size();) {
    const std::uint32_t number = undecided[k].ball;
    find_linked(number, part.linked, host);
    for (; k < undecided.size() && undecided[k].ball == number; ++k) {
      const std::uint32_t other = undecided[k].other;
      // The flags of others may be in use by other threads.
      if (other != number && look_out_for(number, other, undecided[k].apart, part.linked, part.work, host))
        part.near.insert(part.near.end(), {number, other});
    }
    look_out_for_linked(number, part.linked, part.work, host);
  }
}

}  // namespace kinesphere::core
