// Starting: bodies get capsules in windows, and the pairs that may change before these end become hot.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "number/infinity.hpp"
#include "number/powers.hpp"
#include "world/engine.hpp"

namespace kinesphere {
namespace {

/// A bound that has grown by more than this part of a body's way is so large that a report costs less.
constexpr double largest_growth = 0.25;

Vec3 centre_of(const Box& box) { return 0.5 * (box.lower + box.upper); }

/// About the distance between so many points along a line or in a layer, if their box is thinner than that,
/// or in a cube around it. The same on all machines, without std::cbrt().
double spacing_within(const Vec3& size, int count) {
  std::array<double, 3> sides{size.x, size.y, size.z};
  std::sort(sides.begin(), sides.end(), std::greater<>());
  const double on_line = sides[0] / count;
  if (!(sides[1] > on_line)) return on_line;
  const double in_layer = std::sqrt(sides[1] * on_line);
  if (!(sides[2] > in_layer)) return in_layer;
  return std::ldexp(sides[0], -std::ilogb(count) / 3);
}

}  // namespace

double World::Engine::reach_of_pair(const Body& a, const Body& b) const {
  return std::max(sensors_.reach(a.sensor_class), sensors_.reach(b.sensor_class));
}

Pace World::Engine::pace_of(const Body& body) const {
  const MovedBound moved(body.bound, time_);
  return {norm(moved.velocity) + moved.speed, moved.growth + norm(moved.acceleration)};
}

/// The first main window lets most new bodies go about a quarter of the distance between them.
void World::Engine::choose_tempo(std::span<const std::uint32_t> round) {
  // One that was chosen for few bodies may be far too slow for many.
  if (round.empty() || (tempo_.is_chosen() && 2 * round.size() < windows_.moving())) return;
  Vec3 lower{infinity, infinity, infinity};
  Vec3 upper = -lower;
  std::vector<double> speeds;
  double acceleration = 0.0;
  for (const std::uint32_t number : round) {
    const Vec3 centre = bodies_[number].bound.centre_at(time_);
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = std::min(lower[axis], centre[axis]);
      upper[axis] = std::max(upper[axis], centre[axis]);
    }
    const Pace pace = pace_of(bodies_[number]);
    speeds.push_back(pace.speed);
    acceleration += pace.acceleration / static_cast<double>(round.size());
  }
  const auto middle = speeds.begin() + static_cast<std::ptrdiff_t>(speeds.size() / 2);
  std::nth_element(speeds.begin(), middle, speeds.end());
  const double spacing = spacing_within(upper - lower, static_cast<int>(round.size()));
  const double way = std::max(0.25 * spacing, 0x1p8 * definition_.contact_tolerance);
  tempo_.choose(way, {*middle, acceleration});
}

/// With room for all that the body can touch or sense.
RoomyBound World::Engine::roomy_bound(std::uint32_t number) const {
  const Body& body = bodies_[number];
  const double room = sensor_reach(body) + definition_.contact_tolerance;
  if (!body.is_fixed()) return {MovedBound(body.bound, time_), room};
  Bound ball = body.bound;
  if (const Shape* shape = extent(number).shape) {
    const Box box = space_.within(box_of(*shape));
    ball.position = centre_of(box);
    ball.radius = norm(0.5 * (box.upper - box.lower));
  }
  return {MovedBound(ball, time_), room};
}

/// The window in which a body is to be from now on: the one that it is in, unless that lasts longer than the
/// one that suits it, or is far shorter.
Window World::Engine::window_for(std::uint32_t number) const {
  const Body& body = bodies_[number];
  if (body.is_fixed() || body.stands_still()) return Windows::endless();
  const Window window = window_to_start(number);
  if (!windows_.contains(number)) return window;
  const double end = windows_.end_of(number);
  const int tier = windows_.tier_of(number);
  const bool suits = tier >= window.tier - 2 * Tempo::powers_between_tiers && end <= window.end &&
                     (tier <= window.tier || !space_.repeats());
  return suits && time_ < end ? Window{tier, end} : window;
}

/// The window that suits a body which moves.
Window World::Engine::window_to_start(std::uint32_t number) const {
  const Body& body = bodies_[number];
  Window window = Windows::window_at(time_, tempo_.tier_for(pace_of(body)));
  if (!space_.repeats()) return window;
  const auto length = [&window] { return power_of_two(window.tier); };
  while (length() > longest_in_period(body, length())) {
    const Window shorter = Windows::window_at(time_, window.tier - 1);
    if (shorter.tier == window.tier) break;
    window = shorter;
  }
  return window;
}

/// How wide the box of a body may be on an axis that repeats, by space/space.hpp (2); a little less, for
/// rounding.
double World::Engine::widest_in_period(const Body& body, int axis) const {
  return (0.5 - 0x1p-10) * space_.period()[axis] - book_.rule().release_gap() - 4.0 * body.position_error;
}

/// How long a window of a body may last, `length` at most, for the box around its way to be no wider than
/// that.
double World::Engine::longest_in_period(const Body& body, double length) const {
  const MovedBound moved(body.bound, time_);
  const double radius =
      moved.radius + sensors_.reach(body.sensor_class) + 2.0 * definition_.contact_tolerance;
  double longest = length;
  for (int axis = 0; axis < 3; ++axis) {
    if (!space_.repeats(axis)) continue;
    const double speed = std::abs(moved.velocity[axis]) + 2.0 * moved.speed;
    const double a = norm_one(moved.acceleration) + moved.growth;
    const double way = std::max(widest_in_period(body, axis) - 2.0 * radius, 0.0);
    if ((speed + a * longest) * longest <= way) continue;
    const double divisor = speed + std::sqrt(speed * speed + 4.0 * a * way);
    if (divisor > 0.0) longest = std::min(longest, 2.0 * way / divisor);
  }
  return longest;
}

/// Moves the body to the image in which the middle of its way until then lies in the primary box.
void World::Engine::bring_home(std::uint32_t number, double length) {
  const Vec3 middle = centre_of(roomy_bound(number).box_of_way(length));
  const auto [home, images] = space_.wrapped(middle);
  middles_[number] = home;
  if (images == Vec3{}) return;
  bodies_[number].bound.position -= space_.shift_of(images);
  images_[number] += images;
}

/// What brings body b to the image in which body a may meet it while both are in their windows.
Vec3 World::Engine::shift_to_meet(std::uint32_t a, std::uint32_t b) const {
  return space_.shift_between_homes(middles_[b], middles_[a]);
}

/// The bound of body b as body a has to reckon with it, where space repeats.
Bound World::Engine::seen_from(std::uint32_t a, std::uint32_t b) const {
  Bound bound = bodies_[b].bound;
  bound.position += shift_to_meet(a, b);
  return bound;
}

/// Whether, until the next window ends, the bound would grow so much that a report costs less, or the body go
/// so far from its last report that its place could not be computed well, or so large that no window suits
/// it.
bool World::Engine::needs_report(std::uint32_t number) const {
  const Body& body = bodies_[number];
  if (body.fresh(time_)) return false;
  const Bound& bound = body.bound;
  const Window window = window_to_start(number);
  const double s = window.end - bound.time;
  const double growth = (bound.growth_speed + 0.5 * bound.growth_acceleration * s) * s;
  if (growth > largest_growth * tempo_.typical_way()) return true;
  const double speed = norm(bound.velocity) + bound.growth_speed + body.largest_acceleration() * s;
  if (!space_.repeats()) return speed * s > longest_way();
  if (window.tier < tempo_.tier_for(pace_of(body))) return true;
  const Vec3& period = space_.period();
  double half = infinity;
  for (int axis = 0; axis < 3; ++axis)
    if (space_.repeats(axis)) half = std::min(half, 0.5 * period[axis]);
  return speed * s > half;
}

/// New windows for those whose windows have ended, or for all, and for some that join them.
Result<void> World::Engine::start_windows(bool all, std::span<const std::uint32_t> joining) {
  std::vector<std::uint32_t> round = windows_.ended(time_, all);
  const bool most = 2 * (round.size() + joining.size()) > windows_.moving();
  std::vector<std::uint32_t> asked;
  for (const std::uint32_t number : round)
    if (!bodies_[number].dirty && needs_report(number)) asked.push_back(number);
  if (!asked.empty()) {
    if (auto probed = probe(asked); !probed) return probed;
  }
  if (most) tempo_.start_main(time_, std::exchange(kicks_, {}));
  scratch_.cost = {};
  windows_.end_windows(time_, all);
  // Those with a broken promise, too, are settled by themselves.
  std::erase_if(round, [this](std::uint32_t number) { return bodies_[number].dirty; });
  ++counters_.window_ends;
  counters_.starts += round.size();
  counters_.restarts += joining.size();
  const auto ended = static_cast<std::ptrdiff_t>(round.size());
  round.insert(round.end(), joining.begin(), joining.end());
  std::inplace_merge(round.begin(), round.begin() + ended, round.end());
  for (const std::uint32_t number : round) {
    if (windows_.contains(number)) windows_.leave(number);
    Window window = window_to_start(number);
    // A layer in which others are already would have to be sorted anew: rather a shorter window.
    while (!windows_.is_free(window)) {
      const int tier = window.tier;
      window = Windows::window_at(time_, tier - Tempo::powers_between_tiers);
      if (window.tier == tier) break;
    }
    if (!windows_.is_free(window)) {
      // There is none: the body is settled by itself.
      mark_dirty(number);
      continue;
    }
    if (space_.repeats()) bring_home(number, window.end - time_);
    const RoomyBound bound = roomy_bound(number);
    windows_.start(number, bound, time_, window);
    tempo_.note_start(pace_of(bodies_[number]), 2.0 * (bound.moved.radius + bound.room), window.tier);
  }
  std::erase_if(round, [this](std::uint32_t number) { return !windows_.contains(number); });
  windows_.finish_start();
  hot_.clear();
  for (std::size_t k = 0; k < windows_.started(); ++k) {
    const auto others = windows_.near_started(
        k, time_, [this](std::uint32_t number) { return roomy_bound(number); }, scratch_);
    scratch_.cost.hot += find_hot_pairs(windows_.started_number(k), others);
  }
  tempo_.finish_start(scratch_.cost, windows_.size());
  for (const std::uint32_t number : round) {
    find_known_pairs(number);
    find_walls(number);
    bodies_[number].settled = true;
  }
  agenda_.add_all(hot_);
  for (const std::uint32_t number : round) bodies_[number].settled = false;
  return {};
}

/// A capsule and hot pairs for each dirty body.
Result<void> World::Engine::settle_dirty() {
  if (dirty_.size() > 1) {
    std::sort(dirty_.begin(), dirty_.end());
    dirty_.erase(std::unique(dirty_.begin(), dirty_.end()), dirty_.end());
  }
  // Some have been removed or disabled since.
  std::erase_if(dirty_, [this](std::uint32_t number) { return !bodies_[number].dirty; });
  round_.clear();
  for (const std::uint32_t number : dirty_)
    if (!bodies_[number].fresh(time_)) round_.push_back(number);
  if (!round_.empty()) {
    if (auto probed = probe(round_); !probed) return probed;
  }
  const std::size_t count = dirty_.size();
  // Where they are many, all others begin anew with them.
  constexpr std::size_t many = 8;
  const bool anew = count > many && many * count > windows_.size();
  std::vector<std::uint32_t> joining;
  round_.clear();
  for (const std::uint32_t number : dirty_) {
    const bool alone = !anew || bodies_[number].is_fixed() || bodies_[number].stands_still();
    (alone ? round_ : joining).push_back(number);
  }
  if (anew || !tempo_.is_chosen()) choose_tempo(anew ? joining : round_);
  counters_.restarts += round_.size();
  kicks_.bodies += round_.size();
  for (const std::uint32_t number : round_) enter(number);
  windows_.tidy();
  if (!joining.empty()) {
    if (auto started = start_windows(true, joining); !started) return started;
    for (const std::uint32_t number : joining) bodies_[number].settled = true;
  }
  hot_.clear();
  for (const std::uint32_t number : round_) {
    kicks_.hot += find_hot_pairs(number, windows_.near(number, roomy_bound(number), time_, scratch_));
    find_known_pairs(number);
    find_walls(number);
    bodies_[number].settled = true;
  }
  agenda_.add_all(hot_);
  // Probes may have shown meanwhile that others broke their promises.
  const auto settled = dirty_.begin() + static_cast<std::ptrdiff_t>(count);
  for (auto at = dirty_.begin(); at != settled; ++at) bodies_[*at].dirty = bodies_[*at].settled = false;
  dirty_.erase(dirty_.begin(), settled);
  return {};
}

/// The body gets a capsule from now on.
void World::Engine::enter(std::uint32_t number) {
  const Window window = window_for(number);
  if (space_.repeats()) bring_home(number, window.end < infinity ? window.end - time_ : 0.0);
  windows_.enter(number, roomy_bound(number), time_, window);
}

/// Those of the others that may meet the body before a window ends. Returns how many they are.
std::size_t World::Engine::find_hot_pairs(std::uint32_t number, std::span<const std::uint32_t> others) {
  ++counters_.searches;
  counters_.candidates += others.size();
  const std::size_t before = hot_.size();
  for (const std::uint32_t other : others) {
    if (bodies_[other].settled) continue;
    const double until = unchanged_until(number, other);
    if (until == infinity) continue;
    hot_.push_back(hot_pair(until, number, other));
  }
  const std::size_t hot = hot_.size() - before;
  counters_.hot_pairs += hot;
  return hot;
}

/// Whom the body touches or senses may be anywhere.
void World::Engine::find_known_pairs(std::uint32_t number) {
  const auto add = [&](std::uint32_t other) {
    if (!windows_.contains(other) || bodies_[other].settled) return;
    const double until = unchanged_until_by_thresholds(number, other);
    if (until < windows_end(number, other)) hot_.push_back(hot_pair(until, number, other));
  };
  for (const std::uint32_t partner : book_.partners_of(number)) add(partner);
  const auto crossed = book_.crossings_of(number);
  for (std::size_t k = 0; k < crossed.size(); ++k) {
    const std::uint32_t other = crossed[k].partner;
    if (k > 0 && other == crossed[k - 1].partner) continue;
    if (!book_.touch(number, other)) add(other);
  }
}

/// The body may reach or leave a wall before its window ends.
void World::Engine::find_walls(std::uint32_t number) {
  const Body& body = bodies_[number];
  if (!walls_ || body.is_fixed()) return;
  const double end = windows_.end_of(number);
  const double until = book_.walls_of(number) != 0
                           ? time_
                           : until_reports_of_walls(book_.rule(), body.bound, *walls_, time_, end);
  if (until < end) hot_.push_back(hot_pair(until, number, HotPair::walls));
}

}  // namespace kinesphere
