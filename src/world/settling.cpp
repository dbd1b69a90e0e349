// Settling: after it, a fact is recorded for every pair that concerns a body.
#include <algorithm>
#include <cmath>

#include "world/engine.hpp"

namespace kinesphere {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

/// The body must be settled before time moves on. Facts about it stay.
void World::Engine::mark_dirty(std::uint32_t number) {
  if (bodies_[number].dirty) return;
  bodies_[number].dirty = true;
  dirty_.push_back(number);
  schedule_.set(number, infinity);
}

/// A discontinuity: nothing that was certified about the body holds any more.
void World::Engine::void_facts(std::uint32_t number) {
  ++bodies_[number].epoch;
  bodies_[number].watches.clear();
  mark_dirty(number);
}

Result<void> World::Engine::settle_all() {
  auto& changed = book_.changed();
  while (!changed.empty()) {
    const auto [a, b] = changed.back();
    // What either body watches of the other concerns the old state.
    unwatch(a, b);
    unwatch(b, a);
    if (bodies_[a].present() && bodies_[b].present() && !bodies_[a].dirty && !bodies_[b].dirty) {
      if (auto settled = a == b ? settle_walls(a) : settle_pair(a, b); !settled) return settled;
      if (!bodies_[a].dirty) reschedule(a);
    }
    changed.pop_back();
  }
  // Settling may find broken promises, which make further bodies dirty.
  while (!dirty_.empty()) {
    std::vector<std::uint32_t> round;
    round.swap(dirty_);
    std::sort(round.begin(), round.end());
    round.erase(std::unique(round.begin(), round.end()), round.end());
    // Some have been removed or disabled since.
    std::erase_if(round, [this](std::uint32_t number) { return !bodies_[number].dirty; });
    if (auto settled = settle_round(round); !settled) return settled;
  }
  return {};
}

/// A round that a bad answer breaks off has to be done again.
class World::Engine::RoundInProgress {
 public:
  RoundInProgress(Engine& engine, const std::vector<std::uint32_t>& round) : engine_(engine), round_(round) {}
  RoundInProgress(const RoundInProgress&) = delete;
  RoundInProgress& operator=(const RoundInProgress&) = delete;
  ~RoundInProgress() {
    for (const std::uint32_t number : round_) engine_.bodies_[number].searched = false;
    if (done_) return;
    for (const std::uint32_t number : round_) {
      engine_.bodies_[number].dirty = false;
      engine_.mark_dirty(number);
    }
  }
  void finish() { done_ = true; }

 private:
  Engine& engine_;
  const std::vector<std::uint32_t>& round_;
  bool done_ = false;
};

Result<void> World::Engine::settle_round(const std::vector<std::uint32_t>& round) {
  RoundInProgress in_progress(*this, round);
  std::vector<std::uint32_t> stale;
  for (const std::uint32_t number : round)
    if (!bodies_[number].fresh(time_)) stale.push_back(number);
  if (!stale.empty()) {
    if (auto probed = probe(stale); !probed) return probed;
  }
  choose_first_horizons(round);
  for (const std::uint32_t number : round) {
    bodies_[number].dirty = false;
    register_box(number);
  }
  for (const std::uint32_t number : round) {
    if (auto searched = search(number); !searched) return searched;
    bodies_[number].searched = true;
  }
  for (const std::uint32_t number : round)
    if (!bodies_[number].dirty) reschedule(number);
  in_progress.finish();
  return {};
}

/// New bodies begin with a horizon that lets them go about a quarter of the distance between them.
void World::Engine::choose_first_horizons(const std::vector<std::uint32_t>& round) {
  Vec3 lower{infinity, infinity, infinity};
  Vec3 upper = -lower;
  int count = 0;
  for (const std::uint32_t number : round) {
    if (bodies_[number].horizon || bodies_[number].is_fixed()) continue;
    ++count;
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = std::min(lower[axis], bodies_[number].box.lower[axis]);
      upper[axis] = std::max(upper[axis], bodies_[number].box.upper[axis]);
    }
  }
  if (count == 0) return;
  const Vec3 size = upper - lower;
  const double spacing =
      std::ldexp(std::max({size.x, size.y, size.z}), -std::ilogb(count) / definition_.dimensions);
  const double way = spacing > 0.0 ? 0.25 * spacing : definition_.contact_tolerance;
  for (const std::uint32_t number : round)
    if (!bodies_[number].horizon && !bodies_[number].is_fixed())
      bodies_[number].horizon = Horizon::of_new_body(way, definition_.contact_tolerance);
}

/// Contains all that the body can touch or sense.
Bound World::Engine::reach(const Body& body) const {
  Bound bound = body.bound;
  if (sensors_.any()) bound.radius += sensors_.reach(body.definition.sensor_class);
  return bound;
}

void World::Engine::register_box(std::uint32_t number) {
  Body& body = bodies_[number];
  if (body.is_fixed()) return register_shape(number);
  const double speed = norm(body.bound.velocity) + body.definition.velocity_error;
  double length = body.horizon->length(speed, body.largest_acceleration());
  if (space_.repeats()) length = std::min(length, longest_in_period(body));
  body.box_end = just_after(time_ + length);
  body.box = space_.within(swept_box(reach(body), time_, body.box_end));
  bring_home(body);
  grid_.set(number, body.box);
}

/// Moves the body to the image in which the centre of its box lies in the primary box.
void World::Engine::bring_home(Body& body) const {
  if (!space_.repeats()) return;
  const Vec3 images = space_.wrapped(0.5 * (body.box.lower + body.box.upper)).images;
  if (images == Vec3{}) return;
  body.bound.position -= space_.shift_of(images);
  body.image += images;
  body.box = space_.within(swept_box(reach(body), time_, body.box_end));
}

/// How long a box of a body may last to be as narrow as space/space.hpp wants it (2): the box of a bound
/// grows by at most (|v| + 2 e1) s + (|g| / 2 + A) s^2 on an axis.
double World::Engine::longest_in_period(const Body& body) const {
  const Bound& bound = body.bound;
  const double reserve =
      book_.rule().release_gap() + 4.0 * body.definition.position_error + 2.0 * reach(body).radius;
  double longest = infinity;
  for (int axis = 0; axis < 3; ++axis) {
    if (!space_.repeats(axis)) continue;
    const double period = space_.period()[axis];
    // A little less than half, for rounding.
    const double room = (0.5 - 0x1p-10) * period - reserve;
    const double speed = std::abs(bound.velocity[axis]) + 2.0 * bound.growth_speed;
    const double a = 0.5 * std::abs(bound.planned_acceleration[axis]) + bound.growth_acceleration;
    const double way = std::max(room, 0.0);
    const double divisor = speed + std::sqrt(speed * speed + 4.0 * a * way);
    if (divisor > 0.0) longest = std::min(longest, 2.0 * way / divisor);
  }
  return longest;
}

/// What brings body b to the image in which body a may meet it while both boxes last: nearest by their boxes.
Vec3 World::Engine::shift_to_meet(std::uint32_t a, std::uint32_t b) const {
  const Box& box = bodies_[a].box;
  const Box& other = bodies_[b].box;
  return space_.shift_to_nearest(0.5 * (other.lower + other.upper), 0.5 * (box.lower + box.upper));
}

/// The bound of body b as body a has to reckon with it, where space repeats.
Bound World::Engine::seen_from(std::uint32_t a, std::uint32_t b) const {
  Bound bound = bodies_[b].bound;
  bound.position += shift_to_meet(a, b);
  return bound;
}

/// Records facts between a body whose box is new and everything that its box meets.
Result<void> World::Engine::search(std::uint32_t number) {
  ++counters_.searches;
  std::erase_if(bodies_[number].watches,
                [this](const Watch& w) { return w.epoch != bodies_[w.partner].epoch; });
  partners_ = book_.partners_of(number);
  for (const Crossing& crossing : book_.crossings_of(number)) partners_.push_back(crossing.partner);
  const std::size_t known = partners_.size();
  space_.for_each_overlap(grid_, bodies_[number].box, [&](std::uint32_t other) {
    if (other != number) partners_.push_back(other);
  });
  const std::size_t candidates = partners_.size() - known;
  counters_.candidates += candidates;
  const double extent = bodies_[number].box_extent();
  const auto larger = static_cast<std::size_t>(std::count_if(
      partners_.begin() + static_cast<std::ptrdiff_t>(known), partners_.end(),
      [&](std::uint32_t other) { return Horizon::is_larger(bodies_[other].box_extent(), extent); }));
  for (const std::uint32_t partner : partners_) {
    // A dirty partner will search itself; one that has searched in this round has found this body.
    const Body& other = bodies_[partner];
    if (other.dirty || other.searched || has_watch(number, partner) || has_watch(partner, number)) continue;
    if (!may_meet(number, partner)) continue;
    if (auto settled = settle_pair(number, partner); !settled) return settled;
    if (bodies_[number].dirty) return {};
  }
  Body& body = bodies_[number];
  if (body.is_fixed()) return {};
  body.horizon->learn(candidates, larger, extent, 2.0 * reach(body).radius, definition_.dimensions);
  return settle_walls(number);
}

/// Records a fact about two bodies, probing them as far as that needs.
Result<void> World::Engine::settle_pair(std::uint32_t number, std::uint32_t partner) {
  if (bodies_[number].is_fixed()) {
    // It may meet all the others, and leaves them to watch it.
    auto settled = settle_pair(partner, number);
    if (!bodies_[partner].dirty) reschedule(partner);
    return settled;
  }
  for (;;) {
    if (bodies_[number].dirty || bodies_[partner].dirty)
      return {};  // a broken promise came up: its body searches again
    const bool known = visit_pair(number, partner, [=, this](const Bound& bound, const auto& other) {
      return look_at_pair(number, partner, bound, other);
    });
    if (known) return {};
    if (auto probed = probe_staler(number, partner); !probed) return probed;
  }
}

/// Records a fact from the reports that there are. False when they are too old for that.
template <class Partner>
bool World::Engine::look_at_pair(std::uint32_t number, std::uint32_t partner, const Bound& bound,
                                 const Partner& other) {
  const Body& a = bodies_[number];
  const Body& b = bodies_[partner];
  const double boxes_end = std::min(a.box_end, b.box_end);
  const double certificate_end = facts_end_with_boxes() ? boxes_end : infinity;
  const Horizons horizons{boxes_end, certificate_end};
  const bool fresh = a.fresh(time_) && b.fresh(time_);
  const Promise sum{a.definition.velocity_error + b.definition.velocity_error,
                    a.largest_acceleration() + b.largest_acceleration()};
  std::optional<double> next_look = infinity;
  for_each_threshold(number, partner, [&](const Threshold& threshold) {
    ++counters_.certificates;
    const Outlook<Partner> outlook(book_.rule_of(threshold), threshold, bound, other, time_, horizons);
    const auto known = fresh ? judge(outlook, threshold, contact(EventKind::zeno_guard, number, partner), sum)
                             : outlook.until_reports();
    next_look = next_look && known ? std::optional(std::min(*next_look, *known)) : std::nullopt;
  });
  if (!fresh && *next_look <= time_) return false;
  unwatch(number, partner);
  if (next_look && *next_look <= certificate_end) watch(number, partner, *next_look);
  return true;
}

/// Holds fresh reports against the contact rule. Announces what is news; unless that is a begin or an end,
/// tells how long the threshold cannot be crossed.
template <class Partner>
std::optional<double> World::Engine::judge(const Outlook<Partner>& outlook, const Threshold& threshold,
                                           const Event& current, const Promise& promise) {
  Verdict verdict = outlook.judge(current, promise);
  if (verdict.change == ContactRule::Change::begin && !threshold.sensed && book_.is_jammed(current))
    verdict = outlook.put_off(current, promise);
  if (verdict.is_news()) {
    Event news = current;
    news.kind = kind_of(verdict.change, threshold.sensed, current.wall);
    news.distance = threshold.distance;
    book_.announce(news);
    return std::nullopt;
  }
  if (verdict.change == ContactRule::Change::release) book_.release(current);
  if (verdict.zeno_step) ++counters_.zeno_steps;
  if (verdict.breaks_tolerance) book_.announce(current);
  return verdict.next_look;
}

/// Records how long no wall contact of the body can begin or end.
Result<void> World::Engine::settle_walls(std::uint32_t number) {
  if (!walls_) {
    bodies_[number].wall_time = infinity;
    return {};
  }
  for (;;) {
    Body& body = bodies_[number];
    if (body.dirty) return {};
    body.wall_time = book_.walls_of(number) != 0
                         ? time_
                         : until_reports_of_walls(book_.rule(), body.bound, *walls_, time_, body.box_end);
    if (body.wall_time > time_) return {};
    if (body.fresh(time_)) break;
    if (auto probed = probe(std::span(&number, 1)); !probed) return probed;
  }
  Body& body = bodies_[number];
  double first = infinity;
  for (const Wall wall : walls) {
    if (!stands(*walls_, wall)) continue;
    const HalfSpace inside = half_space(*walls_, wall);
    const Threshold threshold{.within = book_.touches_wall(number, wall)};
    const Outlook<HalfSpace> outlook(book_.rule(), threshold, body.bound, inside, time_,
                                     {body.box_end, body.box_end});
    const Promise promise{body.definition.velocity_error, body.largest_acceleration()};
    const auto next_look =
        judge(outlook, threshold, wall_contact(EventKind::zeno_guard, number, wall), promise);
    if (next_look) first = std::min(first, *next_look);
  }
  body.wall_time = first;
  return {};
}

/// True when the body watches this partner, and not only until now.
bool World::Engine::has_watch(std::uint32_t number, std::uint32_t partner) const {
  const std::uint32_t epoch = bodies_[partner].epoch;
  const auto& watches = bodies_[number].watches;
  return std::any_of(watches.begin(), watches.end(), [=, this](const Watch& w) {
    return w.partner == partner && w.epoch == epoch && w.time > time_;
  });
}

/// Records a watch in place of an earlier one; at +infinity there is nothing to watch. A fixed body, which
/// may meet all the others, leaves it to its partner.
void World::Engine::watch(std::uint32_t number, std::uint32_t partner, double time) {
  unwatch(number, partner);
  if (time < infinity) bodies_[number].watches.push_back({time, partner, bodies_[partner].epoch});
}

void World::Engine::unwatch(std::uint32_t number, std::uint32_t partner) {
  std::erase_if(bodies_[number].watches, [=](const Watch& w) { return w.partner == partner; });
}

}  // namespace kinesphere
