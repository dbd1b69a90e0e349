// Settling: after it, a fact is recorded for every pair that concerns a body.
#include <algorithm>
#include <cmath>

#include "world/engine.hpp"

namespace kinesphere {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double just_after(double time) { return std::nextafter(time, infinity); }

}  // namespace

/// The certificates of a body and its partner, another bound or a wall, from now on.
template <class Partner>
struct World::Engine::Outlook {
  const Bound& bound;
  const Partner& partner;
  double now;
  double meeting_horizon;
  double separation_horizon;

  double meeting(double gap) const { return earliest_meeting(bound, partner, now, meeting_horizon, gap); }
  double separation(double gap) const {
    return earliest_separation(bound, partner, now, separation_horizon, gap);
  }
  /// More than what rounding can hide of the present gap.
  double resolution() const {
    const GapLimits limits = gap_limits(bound, partner, now);
    return 1.25 * (limits.upper - limits.lower);
  }
};

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
  while (!changed_.empty()) {
    const auto [a, b] = changed_.back();
    if (bodies_[a].alive && bodies_[b].alive && !bodies_[a].dirty && !bodies_[b].dirty) {
      if (auto settled = a == b ? settle_walls(a) : settle_pair(a, b); !settled) return settled;
      if (!bodies_[a].dirty) reschedule(a);
    }
    changed_.pop_back();
  }
  // Settling may find broken promises, which make further bodies dirty.
  while (!dirty_.empty()) {
    std::vector<std::uint32_t> round;
    round.swap(dirty_);
    std::sort(round.begin(), round.end());
    round.erase(std::unique(round.begin(), round.end()), round.end());
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
    if (bodies_[number].horizon) continue;
    ++count;
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = std::min(lower[axis], bodies_[number].box.lower[axis]);
      upper[axis] = std::max(upper[axis], bodies_[number].box.upper[axis]);
    }
  }
  if (count == 0) return;
  const Vec3 size = upper - lower;
  const double spacing = std::ldexp(std::max({size.x, size.y, size.z}), -std::ilogb(count) / 3);
  const double way = spacing > 0.0 ? 0.25 * spacing : definition_.contact_tolerance;
  for (const std::uint32_t number : round)
    if (!bodies_[number].horizon)
      bodies_[number].horizon.emplace(way, 0x1p10 * definition_.contact_tolerance,
                                      0x1p40 * definition_.contact_tolerance);
}

void World::Engine::register_box(std::uint32_t number) {
  Body& body = bodies_[number];
  const double speed = norm(body.bound.velocity) + body.definition.velocity_error;
  body.box_end = just_after(time_ + body.horizon->length(speed, body.largest_acceleration()));
  body.box = swept_box(body.bound, time_, body.box_end);
  grid_.set(number, body.box);
}

/// Records facts between a body whose box is new and everything that its box meets.
Result<void> World::Engine::search(std::uint32_t number) {
  ++counters_.searches;
  std::erase_if(bodies_[number].watches,
                [this](const Watch& w) { return w.epoch != bodies_[w.partner].epoch; });
  partners_ = bodies_[number].touching;
  const std::size_t touching = partners_.size();
  grid_.for_each_overlap(bodies_[number].box, [&](std::uint32_t other) {
    if (other != number) partners_.push_back(other);
  });
  const std::size_t candidates = partners_.size() - touching;
  counters_.candidates += candidates;
  for (const std::uint32_t partner : partners_) {
    // A dirty partner will search itself; one that has searched in this round has found this body.
    const Body& other = bodies_[partner];
    if (other.dirty || other.searched || has_watch(number, partner) || has_watch(partner, number)) continue;
    if (auto settled = settle_pair(number, partner); !settled) return settled;
    if (bodies_[number].dirty) return {};
  }
  Body& body = bodies_[number];
  const Vec3 size = body.box.upper - body.box.lower;
  body.horizon->learn(candidates, std::max({size.x, size.y, size.z}), 2.0 * body.bound.radius);
  return settle_walls(number);
}

/// Records a fact about two bodies, probing them as far as that needs.
Result<void> World::Engine::settle_pair(std::uint32_t number, std::uint32_t partner) {
  for (;;) {
    const Body& a = bodies_[number];
    const Body& b = bodies_[partner];
    if (a.dirty || b.dirty) return {};  // a broken promise came up: its body searches again
    const bool touching = is_touching(number, partner);
    ++counters_.certificates;
    if (!a.fresh(time_) || !b.fresh(time_)) {
      const double time = touching
                              ? earliest_separation(a.bound, b.bound, time_, infinity, rule_.release_gap())
                              : earliest_meeting(a.bound, b.bound, time_, std::min(a.box_end, b.box_end));
      if (time > time_ && (time == infinity || is_far_from_change(number, partner, touching))) {
        watch(number, partner, time);
        return {};
      }
      if (auto probed = probe_staler(number, partner); !probed) return probed;
      continue;
    }
    const Event now = contact(EventKind::zeno_guard, number, partner);
    const std::optional<bool> touches = touching_now(touching, now);
    if (!touches) {
      unwatch(number, partner);
      return {};
    }
    if (touching && !*touches) set_touching(number, partner, false);
    const Promise sum{a.definition.velocity_error + b.definition.velocity_error,
                      a.largest_acceleration() + b.largest_acceleration()};
    const Outlook<Bound> outlook{a.bound, b.bound, time_, std::min(a.box_end, b.box_end), infinity};
    watch(number, partner, next_look(*touches, now, sum, outlook));
    return {};
  }
}

/// Holds fresh reports against the contact rule. Announces a begin or an end, or tells whether the two touch.
std::optional<bool> World::Engine::touching_now(bool touching, const Event& now) {
  Event change = now;
  switch (rule_.decide(touching, now.gap, now.approach_speed)) {
    case ContactRule::Change::none:
      return touching;
    case ContactRule::Change::release:
      return false;
    case ContactRule::Change::begin:
      change.kind = now.wall == Wall::none ? EventKind::contact_begin : EventKind::wall_begin;
      break;
    case ContactRule::Change::end:
      change.kind = now.wall == Wall::none ? EventKind::contact_end : EventKind::wall_end;
      break;
  }
  announce(change);
  return std::nullopt;
}

/// How long whether they touch cannot change, given fresh reports.
template <class Partner>
double World::Engine::next_look(bool touches, const Event& now, const Promise& promise,
                                const Outlook<Partner>& outlook) {
  if (touches) return std::max(outlook.separation(rule_.release_gap()), just_after(time_));
  // A certificate cannot guard a gap that lies within its own rounding of the present one.
  const double gap = now.gap - outlook.resolution();
  double time = guarded_step(outlook.meeting(rule_.guarded_gap(gap)), promise, now);
  if (rule_.is_deep(gap)) time = std::min(time, outlook.separation(rule_.surface_gap()));
  return std::max(time, just_after(time_));
}

/// True when the bounds as they are keep away from where the contact changes. If they do not, a certificate
/// may be as short as one likes, and a second report is better: with two the rule decides, or the certificate
/// spans a tolerance.
bool World::Engine::is_far_from_change(std::uint32_t a, std::uint32_t b, bool touching) const {
  const GapLimits gap = gap_limits(bodies_[a].bound, bodies_[b].bound, time_);
  return touching ? gap.upper < rule_.separation_distance() : gap.lower > definition_.contact_tolerance;
}

/// As above, for a body that touches no wall.
bool World::Engine::is_far_from_walls(std::uint32_t number) const {
  const Vec3 tolerance = Vec3{1.0, 1.0, 1.0} * definition_.contact_tolerance;
  const Box inner{definition_.box->lower + tolerance, definition_.box->upper - tolerance};
  return earliest_exit(bodies_[number].bound, inner, time_, infinity) > time_;
}

/// The Zeno guard: makes sure that time moves on between two looks at a contact that does not approach.
double World::Engine::guarded_step(double certificate, const Promise& promise, const Event& now) {
  const double least = time_ + rule_.least_step(now.gap, promise.speed_error, promise.acceleration);
  if (certificate >= least) return certificate;
  ++counters_.zeno_steps;
  if (rule_.step_breaks_tolerance(now.gap)) announce(now);
  return least;
}

/// Records how long no wall contact of the body can begin or end.
Result<void> World::Engine::settle_walls(std::uint32_t number) {
  if (!definition_.box) {
    bodies_[number].wall_time = infinity;
    return {};
  }
  for (;;) {
    Body& body = bodies_[number];
    if (body.dirty) return {};
    body.wall_time =
        body.touching_walls != 0 ? time_ : earliest_exit(body.bound, *definition_.box, time_, body.box_end);
    if (body.wall_time == infinity) return {};
    if (body.wall_time > time_ && is_far_from_walls(number)) return {};
    if (body.fresh(time_)) break;
    if (auto probed = probe(std::span(&number, 1)); !probed) return probed;
  }
  Body& body = bodies_[number];
  double first = infinity;
  for (const Wall wall : walls) {
    const HalfSpace inside = half_space(*definition_.box, wall);
    const bool touching = (body.touching_walls & wall_bit(wall)) != 0;
    const Event now = wall_contact(EventKind::zeno_guard, number, wall);
    const std::optional<bool> touches = touching_now(touching, now);
    if (!touches) continue;
    if (touching && !*touches) body.touching_walls ^= wall_bit(wall);
    const Promise promise{body.definition.velocity_error, body.largest_acceleration()};
    const Outlook<HalfSpace> outlook{body.bound, inside, time_, body.box_end, body.box_end};
    first = std::min(first, next_look(*touches, now, promise, outlook));
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

/// Records a watch in place of an earlier one; at +infinity there is nothing to watch.
void World::Engine::watch(std::uint32_t number, std::uint32_t partner, double time) {
  unwatch(number, partner);
  if (time < infinity) bodies_[number].watches.push_back({time, partner, bodies_[partner].epoch});
}

void World::Engine::unwatch(std::uint32_t number, std::uint32_t partner) {
  std::erase_if(bodies_[number].watches, [=](const Watch& w) { return w.partner == partner; });
}

}  // namespace kinesphere
