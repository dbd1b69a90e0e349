// Settling: after it, a fact is recorded for every pair that concerns a body.
#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>

#include "memory/prefetch.hpp"
#include "number/infinity.hpp"
#include "space/morton.hpp"
#include "space/radix_sort.hpp"
#include "world/engine.hpp"
#include "world/lookout.hpp"

namespace kinesphere {
namespace {

bool lies_inside(const Box& inner, const Box& outer) {
  return outer.lower.x < inner.lower.x && inner.upper.x < outer.upper.x && outer.lower.y < inner.lower.y &&
         inner.upper.y < outer.upper.y && outer.lower.z < inner.lower.z && inner.upper.z < outer.upper.z;
}

/// A round of all bodies leaves much memory that others do not need.
constexpr std::size_t most_kept = 1024;
void let_go(std::vector<std::uint32_t>& numbers) {
  if (numbers.size() < numbers.capacity() / 8) numbers.shrink_to_fit();
}

}  // namespace

/// The body must be settled before time moves on. Facts about it stay.
void World::Engine::mark_dirty(std::uint32_t number) {
  if (marks_[number].dirty) return;
  marks_[number].dirty = true;
  dirty_.push_back(number);
}

/// A discontinuity: nothing that was certified about the body holds any more.
void World::Engine::void_facts(std::uint32_t number) {
  neighbours_.unwatch_all(number);
  mark_dirty(number);
}

Result<void> World::Engine::settle_everything() {
  auto& changed = book_.changed();
  while (!changed.empty()) {
    const auto [a, b] = changed.back();
    if (auto settled = settle_changed(a, b); !settled) return settled;
    changed.pop_back();
  }
  // Settling may find broken promises, which make further bodies dirty.
  while (!dirty_.empty()) {
    round_.clear();
    round_.swap(dirty_);
    const auto in_disorder = std::adjacent_find(round_.begin(), round_.end(), std::greater_equal<>());
    if (in_disorder != round_.end()) {
      std::sort(round_.begin(), round_.end());
      round_.erase(std::unique(round_.begin(), round_.end()), round_.end());
    }
    // Some have been removed or disabled since.
    std::erase_if(round_, [this](std::uint32_t number) { return !marks_[number].dirty; });
    if (auto settled = settle_round(round_); !settled) return settled;
    for (auto* numbers : {&round_, &chosen_})
      if (numbers->capacity() > most_kept) let_go(*numbers);
  }
  return {};
}

/// Body and body, or a body and (itself) its walls. What is watched concerns the contact as it was.
Result<void> World::Engine::settle_changed(std::uint32_t a, std::uint32_t b) {
  const auto place = neighbours_.find(a, b);
  if (place) neighbours_.unwatch(a, *place);
  if (!bodies_[a].present() || !bodies_[b].present() || marks_[a].dirty || marks_[b].dirty) return {};
  if (a == b) {
    if (auto settled = settle_walls(a); !settled) return settled;
  } else if (place) {
    if (auto settled = settle_pair(a, *place); !settled) return settled;
  }
  if (!marks_[a].dirty) reschedule(a);
  return {};
}

/// A round that a bad answer breaks off has to be done again.
class World::Engine::RoundInProgress {
 public:
  RoundInProgress(Engine& engine, const std::vector<std::uint32_t>& round) : engine_(engine), round_(round) {}
  RoundInProgress(const RoundInProgress&) = delete;
  RoundInProgress& operator=(const RoundInProgress&) = delete;
  ~RoundInProgress() {
    for (const std::uint32_t number : round_) engine_.marks_[number].settled = false;
    if (done_) return;
    engine_.neighbours_.take_crowded();
    for (const std::uint32_t number : round_) {
      engine_.marks_[number].dirty = false;
      engine_.mark_dirty(number);
    }
  }
  void finish() { done_ = true; }

 private:
  Engine& engine_;
  const std::vector<std::uint32_t>& round_;
  bool done_ = false;
};

/// Neighbours one soon after the other: they meet the same cells, and each other, while these are in the
/// cache. Few bodies fit into it in any order.
void World::Engine::order_in_space(std::vector<std::uint32_t>& round) {
  constexpr std::size_t few = 4096;
  if (round.size() <= few) return;
  std::vector<std::uint64_t> keys;
  keys.reserve(round.size());
  for (const std::uint32_t number : round) {
    const std::uint64_t key = morton_key(bodies_[number].bound.position, grid_.finest_edge());
    keys.push_back(key << 32 | number);
  }
  sort_by_high_halves(keys);
  std::transform(keys.begin(), keys.end(), round.begin(),
                 [](std::uint64_t key) { return static_cast<std::uint32_t>(key); });
}

/// What is kept of a body a few places after the k-th, and the neighbours of one between, where they stand
/// being known by then.
[[gnu::always_inline]] inline void World::Engine::fetch_ahead(const std::vector<std::uint32_t>& round,
                                                              std::size_t k) const {
  constexpr std::size_t ahead = 8;
  if (k + ahead < round.size()) fetch(round[k + ahead]);
  if (k + ahead / 2 < round.size()) neighbours_.fetch_sides(round[k + ahead / 2]);
}

Result<void> World::Engine::settle_round(std::vector<std::uint32_t>& round) {
  RoundInProgress in_progress(*this, round);
  chosen_.clear();
  bool any_new = false;
  for (const std::uint32_t number : round) {
    const Body& body = bodies_[number];
    if (!body.fresh(time_)) chosen_.push_back(number);
    any_new = any_new || !(body.horizon.is_chosen() || body.is_fixed());
  }
  if (!chosen_.empty()) {
    if (auto probed = probe(chosen_); !probed) return probed;
  }
  if (any_new) choose_first_horizons(round);
  order_in_space(round);
  chosen_.clear();
  for (std::size_t k = 0; k < round.size(); ++k) {
    const std::uint32_t number = round[k];
    fetch_ahead(round, k);
    marks_[number].dirty = false;
    if (renew_box(number)) chosen_.push_back(number);
    sketch_box(number);
  }
  if (any_new) shrink_first_boxes(chosen_);
  // All of them before the first look, which may meet a bad answer: a body keeps its new box when the round
  // is done again, and does not search then.
  for (std::size_t k = 0; k < chosen_.size(); ++k) {
    fetch_ahead(chosen_, k);
    find_neighbours(chosen_[k]);
  }
  for (std::size_t k = 0; k < round.size(); ++k) {
    fetch_ahead(round, k);
    if (auto settled = settle_body(round[k]); !settled) return settled;
  }
  in_progress.finish();
  shrink_boxes(neighbours_.take_crowded());
  return {};
}

/// A body whose neighbours are known.
Result<void> World::Engine::settle_body(std::uint32_t number) {
  if (!bodies_[number].is_fixed()) {
    if (auto settled = settle_walls(number); !settled) return settled;
  }
  if (auto settled = look_around(number); !settled) return settled;
  marks_[number].settled = true;
  if (!marks_[number].dirty) reschedule(number);
  return {};
}

/// Records facts between a body and its neighbours, as far as nobody watches them: the inner loop of the
/// engine.
Result<void> World::Engine::look_around(std::uint32_t number) {
  const std::span<const Unwatched> unsettled = unwatched(number);
  if (unsettled.empty()) {
    bodies_[number].look_time = infinity;
    return {};
  }
  const std::span<const Neighbour> all = neighbours_.of(number);
  Lookout lookout(*this, number);
  const Glances glances(*this, number);
  bool any_apart = false;
  for (std::size_t first = 0; first < unsettled.size(); first += lane_count) {
    const std::size_t count = std::min(lane_count, unsettled.size() - first);
    const Lanes apart = lookout.is_bare() ? glances.apart(&unsettled[first], lookout.enough()) : 0u;
    any_apart = any_apart || apart != 0;
    for (Lanes rest = ~apart & ((1u << count) - 1u); rest != 0; rest &= rest - 1) {
      const auto [place, partner] = unsettled[first + static_cast<std::size_t>(std::countr_zero(rest))];
      const Lookout::Look look = lookout.look_at(partner);
      if (look.apart) {
        any_apart = true;
        continue;
      }
      if (look.until > time_) {
        neighbours_.watch(number, place, look.until);
      } else {
        if (auto settled = settle_pair(number, place); !settled) return settled;
        if (marks_[number].dirty) return {};
      }
      lookout.expect(all[place].watch);
    }
  }
  // Not before: a bad answer may have broken it off, and then it is due still.
  bodies_[number].look_time = any_apart ? lookout.next_look() : infinity;
  return {};
}

/// Neighbours with whom a fact is to be recorded. Behind them the last one is repeated until lane_count of
/// them can be read from any place.
std::span<const World::Engine::Unwatched> World::Engine::unwatched(std::uint32_t number) {
  const std::span<const Neighbour> all = neighbours_.of(number);
  if (unwatched_.size() < all.size() + lane_count) unwatched_.resize(all.size() + lane_count);
  std::size_t count = 0;
  for (Neighbours::Place place = 0; place < all.size(); ++place) {
    const Neighbour& one = all[place];
    if (one.is_watched(time_) || settles_itself(one.partner) || !may_meet(number, one.partner)) continue;
    if (one.watch != Neighbour::nobody) neighbours_.unwatch(number, place);
    unwatched_[count++] = {place, one.partner};
  }
  if (count > 0) std::fill_n(&unwatched_[count], lane_count - 1, unwatched_[count - 1]);
  return std::span(unwatched_).first(count);
}

/// Reports that are not fresh tell no more of the two than Lookout::look_at().
bool World::Engine::lookout_tells_all(std::uint32_t number, std::uint32_t partner) const {
  if (!is_bare(number) || bodies_[partner].is_fixed()) return false;
  if (!sensors_.any()) return true;
  const Body& a = bodies_[number];
  const Body& b = bodies_[partner];
  const auto sensed = sensors_.next_inward(sensing_of(number), sensing_of(partner), {});
  return sensed == reach_of_pair(a, b);
}

/// Records a fact about a body and a neighbour that cannot be left alone, probing them as far as that needs.
Result<void> World::Engine::settle_pair(std::uint32_t number, Neighbours::Place place) {
  const auto [watch, partner, mirror] = neighbours_.of(number)[place];
  if (bodies_[number].is_fixed()) {
    // It may meet all the others, and leaves them to watch it.
    auto settled = settle_pair(partner, mirror);
    if (!marks_[partner].dirty) reschedule(partner);
    return settled;
  }
  while (!marks_[number].dirty && !marks_[partner].dirty) {
    const bool fresh = bodies_[number].fresh(time_) && bodies_[partner].fresh(time_);
    if (fresh || !lookout_tells_all(number, partner)) {
      const bool known = visit_pair(number, partner, [=, this](const Bound& bound, const auto& other) {
        return look_at_pair(number, place, bound, other);
      });
      if (known) return {};
    }
    if (auto probed = probe_staler(number, partner); !probed) return probed;
    if (const double until = Lookout(*this, number).left_alone_until(partner); until > time_) {
      if (!marks_[number].dirty && !marks_[partner].dirty) neighbours_.watch(number, place, until);
      return {};
    }
  }
  return {};  // a broken promise came up: its body settles all its pairs again
}

/// Records a fact from the reports that there are. False when they are too old for that.
template <class Partner>
bool World::Engine::look_at_pair(std::uint32_t number, Neighbours::Place place, const Bound& bound,
                                 const Partner& other) {
  const std::uint32_t partner = neighbours_.of(number)[place].partner;
  const Body& a = bodies_[number];
  const Body& b = bodies_[partner];
  const double boxes_end = std::min(a.box_end, b.box_end);
  const double certificate_end = facts_end_with_boxes() ? boxes_end : infinity;
  const Horizons horizons{boxes_end, certificate_end};
  const bool fresh = a.fresh(time_) && b.fresh(time_);
  const Promise sum{a.bound.growth_speed + b.bound.growth_speed,
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
  // At +infinity there is nothing to watch.
  neighbours_.watch(number, place, next_look && *next_look <= certificate_end ? *next_look : infinity);
  return true;
}

/// Holds fresh reports against the contact rule. Announces what is news; unless that is a begin or an end,
/// tells how long the threshold cannot be crossed.
template <class Partner>
std::optional<double> World::Engine::judge(const Outlook<Partner>& outlook, const Threshold& threshold,
                                           Event current, const Promise& promise) {
  Verdict verdict = outlook.judge(current, promise);
  if (verdict.change == ContactRule::Change::begin && !threshold.sensed && book_.is_jammed(current))
    verdict = outlook.put_off(current, promise);
  if (verdict.is_news()) {
    current.kind = kind_of(verdict.change, threshold.sensed, current.wall);
    current.distance = threshold.distance;
    book_.announce(current);
    return std::nullopt;
  }
  if (verdict.change == ContactRule::Change::release) book_.release(current);
  if (verdict.zeno_step) ++counters_.zeno_steps;
  if (verdict.breaks_tolerance) book_.announce(current);
  return verdict.next_look;
}

/// Records how long no wall contact of the body can begin or end.
Result<void> World::Engine::settle_walls(std::uint32_t number) {
  const bool touches = book_.walls_of(number) != 0;
  if (!walls_ || (!touches && lies_inside(box(number), *walls_))) {
    bodies_[number].wall_time = infinity;
    return {};
  }
  for (;;) {
    Body& body = bodies_[number];
    if (marks_[number].dirty) return {};
    body.wall_time =
        touches ? time_ : until_reports_of_walls(book_.rule(), body.bound, *walls_, time_, body.box_end);
    if (body.wall_time > time_) return {};
    if (body.fresh(time_)) break;
    if (auto probed = probe(std::span(&number, 1)); !probed) return probed;
  }
  bodies_[number].wall_time = judge_walls(number);
  return {};
}

/// Holds the fresh report of a body against each wall that it touches or may reach. The others cannot change
/// anything before its box ends.
double World::Engine::judge_walls(std::uint32_t number) {
  const Body& body = bodies_[number];
  const Promise promise{body.bound.growth_speed, body.largest_acceleration()};
  const Box near = walls_in_reach(book_.rule(), body.bound, *walls_, time_, body.box_end);
  double first = infinity;
  for (const Wall wall : walls) {
    const bool touches = book_.touches_wall(number, wall);
    if (!touches && !stands(near, wall)) continue;
    const HalfSpace inside = half_space(*walls_, wall);
    const Threshold threshold{.within = touches};
    const Outlook<HalfSpace> outlook(book_.rule(), threshold, body.bound, inside, time_,
                                     {body.box_end, body.box_end});
    const auto next_look =
        judge(outlook, threshold, wall_contact(EventKind::zeno_guard, number, wall), promise);
    if (next_look) first = std::min(first, *next_look);
  }
  return first;
}

}  // namespace kinesphere
