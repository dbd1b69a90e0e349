// The clock: which body is due next, and the bodies' coming and going.
#include "world/engine.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "world/lookout.hpp"

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
      time_(definition.start_time) {}

void World::Engine::reserve(std::size_t bodies) {
  bodies_.reserve(bodies);
  marks_.reserve(bodies);
  sketches_.reserve(bodies);
  dirty_.reserve(bodies);
  if (space_.repeats()) {
    boxes_.reserve(bodies);
    homes_.reserve(bodies);
    images_.reserve(bodies);
  }
  book_.reserve(bodies);
  grid_.reserve(bodies);
  neighbours_.reserve(bodies);
  schedule_.reserve(bodies);
}

/// A body that lives and has nothing else yet.
std::uint32_t World::Engine::take_number() {
  std::uint32_t number;
  if (free_.empty()) {
    number = static_cast<std::uint32_t>(bodies_.size());
    bodies_.emplace_back();
    marks_.emplace_back();
    sketches_.emplace_back();
    if (space_.repeats()) {
      boxes_.emplace_back();
      homes_.emplace_back();
      images_.emplace_back();
    }
    neighbours_.make_room(bodies_.size());
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

/// The body is where `bound` says, for everyone to find. The next advance looks what it meets there.
void World::Engine::appear(std::uint32_t number, const Bound& bound) {
  Body& body = bodies_[number];
  body.bound = bound;
  body.box_end = body.wall_time = body.look_time = time_;
  set_box(number, bring_home(number, box_now(bound)));
  mark_dirty(number);
}

/// The body's contacts end, and nobody finds it any more.
void World::Engine::withdraw(std::uint32_t number) {
  book_.depart(
      number, time_, [this](std::uint32_t other) { return sphere(other); }, walls_);
  grid_.remove(number);
  neighbours_.remove_all(number);
  schedule_.remove(number);
  marks_[number].dirty = false;
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
  body = Body{};
  body.generation = generation;
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
  BodyView view{
      definition_of(number), body.bound,      box(number),      std::min(body.box_end, body.look_time), {},
      body.enabled,          body.is_fixed(), body.is_resting()};
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
  space_.for_each_overlap(grid_, box, [&](std::uint32_t other) {
    const Body& body = bodies_[other];
    const bool certain = other != id.index && !(extent.fixed && body.is_fixed()) &&
                         certainly_overlap(extent, this->extent(other)) &&
                         may_touch(id, definition, id_of(other), definition_of(other));
    if (certain && (!found || other < found->index)) found = id_of(other);
  });
  return found;
}

/// A registered box holds its body until box_end, which is not past; only a change or a broken promise leaves
/// a body outside, and dirty.
std::vector<std::uint32_t> World::Engine::bodies_in(const Box& box) const {
  std::vector<std::uint32_t> numbers;
  for (const std::uint32_t number : dirty_)
    if (marks_[number].dirty) numbers.push_back(number);
  space_.for_each_overlap(grid_, box, [&](std::uint32_t number) {
    if (!marks_[number].dirty) numbers.push_back(number);
  });
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

void World::Engine::set_velocity(BodyId id, const Vec3& velocity) {
  Body& body = bodies_[id.index];
  if (body.is_resting()) wake_island(id.index);
  body.turned = true;
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
    gathering_ = true;
    if (auto settled = settle_all(); !settled) return settled.error();
    gathering_ = false;
    if (!book_.pending().empty()) continue;
    if (schedule_.next_time() > until) {
      move_on_to(until);
      return std::optional<Event>();
    }
    move_on_to(schedule_.next_time());
    gathering_ = true;
  }
}

void World::Engine::move_on_to(double time) {
  if (time > time_) book_.start_instant();
  time_ = time;
}

/// Has the cache fetch what is kept of the body that is probably due next, which is somewhere in much memory.
std::optional<std::uint32_t> World::Engine::fetch_coming() const {
  constexpr std::size_t few = std::size_t{1} << 14;
  if (bodies_.size() <= few) return std::nullopt;
  const auto coming = schedule_.soon();
  if (coming) fetch(*coming);
  return coming;
}

/// Wakes all bodies that are due, so that every event of this instant is known before the first is delivered.
Result<void> World::Engine::gather() {
  const auto coming = fetch_coming();
  while (schedule_.next_time() <= time_) {
    if (auto woken = wake(schedule_.next_body()); !woken) return woken;
  }
  if (coming) neighbours_.fetch_sides(*coming);
  // Bodies whose boxes end at this instant may add to its events.
  if (auto settled = settle_all(); !settled) return settled;
  gathering_ = false;
  return {};
}

Result<void> World::Engine::wake(std::uint32_t number) {
  if (marks_[number].dirty) {
    schedule_.remove(number);
    return {};
  }
  ++counters_.wakes;
  if (bodies_[number].box_end <= time_) {
    ++counters_.box_ends;
    mark_dirty(number);
    schedule_.remove(number);
    return {};
  }
  const std::uint64_t checks_before = counters_.pair_checks + counters_.wall_checks;
  if (bodies_[number].wall_time <= time_) {
    ++counters_.wall_checks;
    if (auto settled = settle_walls(number); !settled) return settled;
  }
  if (bodies_[number].look_time <= time_) {
    ++counters_.pair_checks;
    if (auto settled = look_around(number); !settled) return settled;
  }
  double earliest_watch = 0.0;
  while ((earliest_watch = neighbours_.earliest_watch(number)) <= time_) {
    const Neighbours::Place place = neighbours_.place_of_watch(number, earliest_watch);
    const std::uint32_t partner = neighbours_.of(number)[place].partner;
    if (marks_[partner].dirty) {
      neighbours_.unwatch(number, place);
      continue;
    }
    if (const double until = Lookout(*this, number).left_alone_until(partner); until > time_) {
      neighbours_.watch(number, place, until);
      continue;
    }
    ++counters_.pair_checks;
    if (auto settled = settle_pair(number, place); !settled) return settled;
  }
  if (counters_.pair_checks + counters_.wall_checks == checks_before) ++counters_.stale_wakes;
  if (!marks_[number].dirty) reschedule(number, earliest_watch);
  return {};
}

void World::Engine::reschedule(std::uint32_t number, double earliest_watch) {
  const Body& body = bodies_[number];
  schedule_.set(number, std::min({body.box_end, body.wall_time, body.look_time, earliest_watch}));
}

}  // namespace kinesphere
