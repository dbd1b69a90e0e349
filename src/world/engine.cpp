// The clock: what is due next, and the bodies' coming and going.
#include "world/engine.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <tuple>

#include "number/infinity.hpp"

namespace kinesphere {

namespace {

std::uint32_t next_tag() {
  static std::atomic<std::uint32_t> count{0};
  const std::uint32_t tag = ++count;
  return tag == 0 ? next_tag() : tag;
}

}  // namespace

World::Engine::Engine(const WorldDefinition& definition)
    : definition_(definition),
      tag_(next_tag()),
      space_(definition),
      walls_(walls_of(definition)),
      book_(definition),
      time_(definition.start_time),
      windows_(space_),
      tempo_(longest_way(), definition.dimensions) {}

void World::Engine::reserve(std::size_t bodies) {
  bodies_.reserve(bodies);
  dirty_.reserve(bodies);
  if (space_.repeats()) {
    middles_.reserve(bodies);
    images_.reserve(bodies);
  }
  book_.reserve(bodies);
  windows_.reserve(bodies);
}

/// A body that lives and has nothing else yet.
std::uint32_t World::Engine::take_number() {
  std::uint32_t number;
  if (free_.empty()) {
    number = static_cast<std::uint32_t>(bodies_.size());
    bodies_.emplace_back();
    if (space_.repeats()) {
      middles_.emplace_back();
      images_.emplace_back();
    }
  } else {
    number = free_.back();
    free_.pop_back();
  }
  bodies_[number].alive = true;
  ++size_;
  return number;
}

BodyId World::Engine::add(const BodyDefinition& definition) {
  const std::uint32_t number = take_number();
  keep(number, definition);
  appear(number, bound_now(definition));
  book_.add(number, bodies_[number].largest_acceleration());
  return id_of(number);
}

/// All but its state and its promise.
void World::Engine::keep(std::uint32_t number, const BodyDefinition& definition) {
  Body& body = bodies_[number];
  body.radius = definition.radius;
  body.position_error = definition.position_error;
  body.solid = definition.solid;
  body.sensor_class = definition.sensor_class;
  body.user_data = definition.user_data;
  keep_filter(number, definition.filter);
  if (!definition.solid) filtering_ = true;
}

BodyId World::Engine::next_id(std::size_t additions_before) const {
  if (additions_before < free_.size()) return id_of(free_[free_.size() - 1 - additions_before]);
  return {static_cast<std::uint32_t>(bodies_.size() + (additions_before - free_.size())), 0, tag_};
}

/// The body is where `bound` says. The next advance looks what it meets there.
void World::Engine::appear(std::uint32_t number, const Bound& bound) {
  bodies_[number].bound = bound;
  if (windows_.contains(number)) windows_.leave(number);
  void_facts(number);
  if (definition_.allow_overlap) return;
  // Others that are added before then have to find it.
  const Window window =
      bodies_[number].is_fixed() ? Windows::endless() : Windows::window_at(time_, Windows::shortest);
  if (space_.repeats()) bring_home(number, 0.0);
  windows_.enter(number, roomy_bound(number), time_, window);
  windows_.tidy();
}

/// The body must be settled before time moves on. Facts about it stay.
void World::Engine::mark_dirty(std::uint32_t number) {
  if (bodies_[number].dirty) return;
  bodies_[number].dirty = true;
  dirty_.push_back(number);
}

/// A discontinuity: nothing that was certified about the body holds any more.
void World::Engine::void_facts(std::uint32_t number) {
  ++bodies_[number].stamp;
  mark_dirty(number);
}

/// The body's contacts end, and nobody finds it any more.
void World::Engine::withdraw(std::uint32_t number) {
  book_.depart(
      number, time_, [this](std::uint32_t other) { return sphere(other); }, walls_);
  if (windows_.contains(number)) windows_.leave(number);
  ++bodies_[number].stamp;
  bodies_[number].dirty = false;
}

void World::Engine::remove(BodyId id) {
  const std::uint32_t number = id.index;
  Body& body = bodies_[number];
  if (body.is_resting()) resume(number);
  wake_island(number);
  withdraw(number);
  if (body.is_fixed()) free_shapes_.push_back(body.shape_number);
  forget_change(number);
  keep_filter(number, {});
  if (space_.repeats()) images_[number] = {};
  const std::uint32_t generation = body.generation + 1;
  const std::uint32_t stamp = body.stamp;
  body = Body{};
  body.generation = generation;
  body.stamp = stamp;
  free_.push_back(number);
  --size_;
}

Bound World::Engine::bound_now(const BodyDefinition& body) const {
  return bound_of(body, {body.position, body.velocity}, time_);
}

GapLimits World::Engine::gap_now(const Extent& a, const Extent& b) const {
  const auto limits = [this](const Bound& bound, const auto& partner) {
    return gap_limits(bound, partner, time_);
  };
  if (!space_.repeats()) return visit_extents(a, b, limits);
  Bound nearest = b.bound;
  nearest.position += space_.shift_to_nearest(b.bound.centre_at(time_), a.bound.centre_at(time_));
  return limits(a.bound, nearest);
}

bool World::Engine::certainly_overlap(const Extent& a, const Extent& b) const {
  return gap_now(a, b).upper < -definition_.contact_tolerance;
}

BodyDefinition World::Engine::definition_of(std::uint32_t number) const {
  const Body& body = bodies_[number];
  const Bound& bound = body.bound;
  BodyDefinition definition{.radius = body.radius,
                            .acceleration_limit = bound.growth_acceleration,
                            .planned_acceleration = bound.planned_acceleration,
                            .position_error = body.position_error,
                            .velocity_error = bound.growth_speed,
                            .position = bound.position,
                            .velocity = bound.velocity,
                            .filter = filter_of(number),
                            .solid = body.solid,
                            .sensor_class = body.sensor_class,
                            .user_data = body.user_data};
  if (const Change* change = change_since_report(number)) {
    definition = with_motion_limits(definition, change->promise);
    definition.velocity = change->kicked_to.value_or(bound.velocity);
  }
  if (body.is_resting()) definition = with_motion_limits(definition, rests_[body.rest_number].limits);
  return definition;
}

/// The body with its last report in the primary box, wherever the engine keeps it.
BodyView World::Engine::view(std::uint32_t number) const {
  const Body& body = bodies_[number];
  BodyView view{definition_of(number), body.bound,       {}, time_, {}, body.enabled,
                body.is_fixed(),       body.is_resting()};
  if (windows_.contains(number)) {
    view.box = box(number);
    view.box_end = windows_.end_of(number);
  }
  if (!space_.repeats()) return view;
  const auto [position, images] = space_.wrapped(body.bound.position);
  const Vec3 shift = space_.shift_of(images);
  view.definition.position = view.bound.position = position;
  view.box = {view.box.lower - shift, view.box.upper - shift};
  for (int axis = 0; axis < 3; ++axis) {
    constexpr double limit = 0x1p62;
    view.image[static_cast<std::size_t>(axis)] =
        static_cast<std::int64_t>(std::clamp(images_[number][axis] + images[axis], -limit, limit));
  }
  return view;
}

std::optional<BodyId> World::Engine::certain_overlap(BodyId id, const Extent& extent,
                                                     const BodyDefinition& definition) const {
  std::optional<BodyId> found;
  const Box box = extent.shape ? box_of(*extent.shape) : box_now(extent.bound);
  Windows::Scratch scratch;
  for (const std::uint32_t other : windows_.in_box(box, time_, scratch)) {
    const Body& body = bodies_[other];
    const bool certain = other != id.index && !(extent.fixed && body.is_fixed()) &&
                         certainly_overlap(extent, this->extent(other)) &&
                         may_touch(id, definition, id_of(other), definition_of(other));
    if (certain && (!found || other < found->index)) found = id_of(other);
  }
  return found;
}

std::optional<std::pair<std::size_t, std::size_t>> World::Engine::first_overlap(
    std::span<const BodyDefinition> bodies) const {
  const auto ball_of = [&](std::uint32_t number) {
    const Bound bound = bound_now(bodies[number]);
    const Vec3 centre = space_.wrapped(bound.centre_at(time_)).position;
    const Bound ball{.time = time_, .position = centre, .radius = bound.radius};
    return RoomyBound{MovedBound(ball, time_), definition_.contact_tolerance};
  };
  Windows windows(space_);
  for (std::uint32_t number = 0; number < bodies.size(); ++number)
    windows.start(number, ball_of(number), time_, Windows::endless());
  windows.finish_start();
  std::optional<std::pair<std::size_t, std::size_t>> least;
  Windows::Scratch scratch;
  for (std::size_t k = 0; k < windows.started(); ++k) {
    for (const std::uint32_t other : windows.near_started(k, time_, ball_of, scratch)) {
      const auto [first, second] = std::minmax({windows.started_number(k), other});
      if (least && std::tie(least->second, least->first) <= std::tie(second, first)) continue;
      if (certainly_overlap({bound_now(bodies[first])}, {bound_now(bodies[second])}) &&
          may_touch(next_id(first), bodies[first], next_id(second), bodies[second]))
        least = {first, second};
    }
  }
  return least;
}

/// A capsule holds its body until its window ends, which is not past; only a change or a broken promise
/// leaves a body outside, and dirty.
std::vector<std::uint32_t> World::Engine::bodies_in(const Box& box) const {
  std::vector<std::uint32_t> numbers;
  for (const std::uint32_t number : dirty_)
    if (bodies_[number].dirty) numbers.push_back(number);
  Windows::Scratch scratch;
  for (const std::uint32_t number : windows_.in_box(box, time_, scratch))
    if (!bodies_[number].dirty) numbers.push_back(number);
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

std::size_t World::Engine::present_count() const {
  return static_cast<std::size_t>(
      std::count_if(bodies_.begin(), bodies_.end(), [](const Body& body) { return body.present(); }));
}

void World::Engine::set_velocity(BodyId id, const Vec3& velocity) {
  Body& body = bodies_[id.index];
  if (body.is_resting()) wake_island(id.index);
  if (body.fresh(time_)) {
    body.bound.velocity = velocity;
  } else {
    change_of(id.index).kicked_to = velocity;
  }
  if (definition_.contacts == ContactMode::impacts) book_.release_all(id.index);
  void_facts(id.index);
}

Result<std::optional<Event>> World::Engine::advance(double until, const Probe& probe) {
  probe_ = &probe;
  probing_call_ = "advance";
  for (;;) {
    if (gathering_) {
      if (auto gathered = gather(); !gathered) return gathered.error();
    }
    if (!book_.is_quiet()) {
      if (std::optional<Event> event = deliver()) return event;
    }
    if (auto settled = settle_all(); !settled) return settled.error();
    if (!book_.pending().empty()) continue;
    agenda_.open([this](const HotPair& pair) { return is_void(pair); });
    const double next = std::min(windows_.next_end(), agenda_.next_time());
    if (next > until) {
      move_on_to(until);
      return std::optional<Event>();
    }
    move_on_to(std::max(next, time_));
    gathering_ = true;
  }
}

void World::Engine::move_on_to(double time) {
  if (time > time_) book_.start_instant();
  time_ = time;
}

/// Looks at all pairs that are due, so that every event of this instant is known before the first is
/// delivered.
Result<void> World::Engine::gather() {
  for (;;) {
    if (windows_.next_end() <= time_) {
      if (auto started = start_windows(false); !started) return started;
    }
    if (auto settled = settle_all(); !settled) return settled;
    agenda_.open([this](const HotPair& pair) { return is_void(pair); });
    if (agenda_.next_time() > time_) break;
    const HotPair pair = agenda_.first();
    agenda_.drop_first();
    if (is_void(pair)) continue;
    if (auto looked = look(pair); !looked) return looked;
  }
  gathering_ = false;
  return {};
}

/// After it, all facts are as they should be.
Result<void> World::Engine::settle_all() {
  auto& changed = book_.changed();
  while (!changed.empty()) {
    const auto [a, b] = changed.back();
    settle_changed(a, b);
    changed.pop_back();
  }
  // Reports may show broken promises, which make further bodies dirty.
  while (!dirty_.empty()) {
    if (auto settled = settle_dirty(); !settled) return settled;
  }
  return {};
}

/// Body and body, or a body and (itself) its walls: what was certified concerns the contact as it was.
void World::Engine::settle_changed(std::uint32_t a, std::uint32_t b) {
  if (!bodies_[a].present() || !bodies_[b].present() || bodies_[a].dirty || bodies_[b].dirty) return;
  agenda_.add(hot_pair(time_, a, a == b ? HotPair::walls : b));
}

}  // namespace kinesphere
