// What the core asks of an event processor (core/host.hpp), and what it is told.
#include <atomic>

#include "bodies/body_bounds.hpp"
#include "processor/event_processor.hpp"

namespace kinesphere {

/// Returns the bound of a body as the core knows it: the ball around its shape, as far as it senses, less
/// what is common to all (left_out_of_extents()).
Bound EventProcessor::extent_of(std::uint32_t number) const {
  const Body& body = bodies()[number];
  Bound extent = body.is_static() ? ball_around_static(bodies(), number, time_) : body.bound;
  if (!body.is_static()) extent.radius += sensor_reach(bodies(), number);
  extent.radius -= left_out_of_extents(bodies());
  return extent;
}

void EventProcessor::enter_core(std::uint32_t number) {
  if (bodies().space().repeats()) bodies().wrap_to_primary(number, time_);
  core().enter(number, extent_of(number), bodies()[number].is_static(), bodies().meets_walls(number));
}

bool EventProcessor::rebuild_core() {
  for (std::uint32_t number = 0; number < core().balls().size(); ++number) {
    if (!core().contains(number)) continue;
    const core::Ball& ball = core().balls()[number];
    if (number >= bodies().numbers() || ball.is(core::Ball::passive) != bodies()[number].is_static())
      return false;
    if (ball.is(core::Ball::meets_walls) && !bodies().walls()) return false;
    // A changed filter is told to the core as the body is settled.
    if (ball.is(core::Ball::meets_walls) != bodies().meets_walls(number) &&
        !DirtyList::may_have_moved(bodies()[number]))
      return false;
  }
  return core().rebuild(time_);
}

/// Tells the core whether the body touches or senses anything, and whether it is plain (core::Ball).
void EventProcessor::set_kind_in_core(std::uint32_t number) {
  const Body& body = bodies()[number];
  const bool touches_walls = contacts().walls_of(number) != 0;
  const bool is_linked = touches_walls || !contacts().partners_of(number).empty() ||
                         !contacts().overlaps_of(number).empty() || contacts().pairs().has_turned(number);
  const bool is_plain = !body.is_shaped() && !body.is_sleeping() && body.change_number == Body::none &&
                        sensor_reach(bodies(), number) == 0.0 && bodies().radii.find(number) == nullptr;
  core().set_kind(number, is_linked, touches_walls, is_plain);
}

/// Tells the core how a rigid body turns, as far as it tells others (core::Ghosts).
void EventProcessor::note_rotation(std::uint32_t number) {
  const RigidRecord* const turning = bodies().rigid.find(bodies()[number]);
  if (turning == nullptr) return;
  const Rotation now = turning->at(time_);
  core().note_beside(number, now.orientation.w, now.orientation.x, now.orientation.y, now.orientation.z,
                     now.angular_velocity.x, now.angular_velocity.y, now.angular_velocity.z);
}

/// Tells the core of reports that have begun bounds anew.
void EventProcessor::note_reports(std::span<const std::uint32_t> numbers) {
  for (const std::uint32_t number : numbers) {
    if (!core().contains(number)) continue;
    if (bodies().radii.any())
      core().set_bound(number, extent_of(number));
    else
      core().report(number, {bodies()[number].bound.position, bodies()[number].bound.velocity});
  }
}

/// Delivered events have changed the contacts of pairs, or of bodies and the walls. Adds them to round_.
void EventProcessor::note_changed_contacts() {
  for (const auto& [a, b] : events_.changed()) {
    known_.forget(a, b);
    for (const std::uint32_t number : {a, b}) {
      if (!core().contains(number)) continue;
      set_kind_in_core(number);
      round_.push_back(number);
    }
  }
  events_.changed().clear();
}

/// Tells the core of a body of which nothing but the velocity has changed. Returns false, and does nothing,
/// if that is not so. Threads may call it for different bodies.
bool EventProcessor::tell_core_of_turn(std::uint32_t number) {
  Body& body = bodies()[number];
  if (!body.turned || body.is_shaped() || bodies().radii.any() || !core().contains(number)) return false;
  core().report(number, {body.bound.position, body.bound.velocity});
  body.mark_recertified();
  return true;
}

void EventProcessor::tell_core_of_change(std::uint32_t number) {
  Body& body = bodies()[number];
  if (body.relocated && core().contains(number)) core().leave(number);
  if (core().contains(number))
    core().set_bound(number, extent_of(number));
  else
    enter_core(number);
  set_kind_in_core(number);
  note_rotation(number);
  body.mark_recertified();
}

/// Tells the core of the bodies that have changed, and of those whose contacts have.
void EventProcessor::settle_core(PoolLease& lease) {
  for (const std::uint32_t number : round_) ++counters_of(number).restarts;
  std::atomic<bool> all_turned = true;
  lease.parallel_for(round_.size(), least_part, [&](std::size_t from, std::size_t to, std::size_t) {
    for (std::size_t k = from; k < to; ++k)
      if (!tell_core_of_turn(round_[k])) all_turned = false;
  });
  if (!all_turned)
    for (const std::uint32_t number : round_)
      if (bodies()[number].dirty) tell_core_of_change(number);
  dirty_.clear();
  note_changed_contacts();
  make_ascending(round_);
  if (!all_turned) std::erase_if(round_, [this](std::uint32_t number) { return !core().contains(number); });
  core().settle(round_, *this, lease);
}

/// What is known of shapes is kept, and a pair filter is the caller's.
bool EventProcessor::answers_threads() const {
  return bodies().are_balls() && !bodies().filters.has_pair_filter();
}

void EventProcessor::linked_with(std::uint32_t ball, std::vector<std::uint32_t>& linked) {
  linked.clear();
  for (const OverlapRecord& overlap : contacts().overlaps_of(ball))
    if (linked.empty() || linked.back() != overlap.partner) linked.push_back(overlap.partner);
  for (const ContactRecord& contact : contacts().partners_of(ball)) linked.push_back(contact.partner);
  for (const PairNote& record : contacts().pairs().of(ball))
    if (record.is_turned()) linked.push_back(record.partner);
  make_ascending(linked);
}

std::size_t EventProcessor::keep_partners(std::uint32_t ball, std::span<std::uint32_t> others) {
  if (!bodies().filters.any()) return others.size();
  const auto kept = std::remove_if(others.begin(), others.end(),
                                   [&](std::uint32_t other) { return !bodies().may_meet(ball, other); });
  return static_cast<std::size_t>(kept - others.begin());
}

double EventProcessor::unchanged_until(std::uint32_t a, std::uint32_t b) {
  if (const double known = known_.find(bodies(), a, b); known > time_) return known;
  const PairCertifier certifier = this->certifier();
  if (const PairLinks links = contacts().links_of(a, b); links.any())
    return certifier.unchanged_until(a, b, links);
  const double until = certifier.apart_until(a, b);
  if (until <= time_) return certifier.bounce_apart(a, b) ? infinity : time_;
  if (bodies()[a].is_shaped() || bodies()[b].is_shaped())
    known_.keep(bodies(), a, b, std::min(until, certifier.earlier_own_time(a, b)), time_);
  return until;
}

Result<double> EventProcessor::recheck(std::uint32_t a, std::uint32_t b) {
  if (!bodies().may_meet(a, b)) return infinity;
  const auto until = check_pair(a, b);
  if (!until) return until.error();
  return keep_time(a, b, *until, certifier().earlier_own_time(a, b));
}

double EventProcessor::walls_unchanged_until(std::uint32_t ball) {
  if (const double known = known_.find(bodies(), ball, ball); known > time_) return known;
  return certifier().walls_unchanged_until(ball);
}

Result<double> EventProcessor::recheck_walls(std::uint32_t ball) {
  const auto until = check_walls(ball);
  if (!until) return until.error();
  return keep_time(ball, ball, *until, certifier().own_time(ball));
}

/// Remembers the outcome of a recheck. If an event waits, that is until the contact has changed.
double EventProcessor::keep_time(std::uint32_t a, std::uint32_t b, const std::optional<double>& until,
                                 double end) {
  known_.keep(bodies(), a, b, until ? std::min(*until, end) : infinity, time_);
  return until.value_or(infinity);
}

Result<bool> EventProcessor::report(std::span<const std::uint32_t> balls, Reason reason) {
  const auto probed = probe(balls, reason == Reason::near ? ProbeCause::near : ProbeCause::region);
  if (!probed) return probed.error();
  return std::none_of(balls.begin(), balls.end(),
                      [this](std::uint32_t ball) { return bodies()[ball].dirty; });
}

void EventProcessor::note_image(std::uint32_t ball, const Vec3& centre) {
  Body& body = bodies()[ball];
  if (body.is_static()) {
    bodies().images[ball].middle = body.bound.position;
    return;
  }
  bodies().move_to_image_of(ball, centre, time_);
}

}  // namespace kinesphere
