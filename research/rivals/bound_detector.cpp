#include "research/rivals/bound_detector.hpp"

#include <algorithm>
#include <utility>

#include "bodies/validation.hpp"
#include "bound/bound_violation.hpp"

namespace kinesphere {

Result<void> BoundDetector::add(std::uint32_t number, const BodyDefinition& definition) {
  Body& body = bodies_[number];
  body = {.definition = definition,
          .bound = bound_of(definition, {definition.position, definition.velocity}, time_),
          .present = true,
          .new_course = true};
  contacts_.add(number, body.largest_acceleration());
  new_courses_.push_back(number);
  bodies_added_ = true;
  return {};
}

Result<void> BoundDetector::remove(std::uint32_t number) {
  instant_.end_all_contacts(
      contacts_, number, time_, [this](std::uint32_t body) { return sphere(body); }, definition_.box);
  std::erase(new_courses_, number);
  bodies_[number] = Body{};
  on_removed(number);
  return {};
}

Result<void> BoundDetector::set_velocity(std::uint32_t number, const Vec3& velocity) {
  Body& body = bodies_[number];
  body.kicked_to = velocity;
  if (!fresh(number)) probe(number);
  body.bound.velocity = velocity;
  body.kicked_to.reset();
  contacts_.turn_reported(number);
  begin_new_course(number);
  return {};
}

void BoundDetector::begin_new_course(std::uint32_t number) {
  if (!bodies_[number].new_course) new_courses_.push_back(number);
  bodies_[number].new_course = true;
}

Result<std::optional<Event>> BoundDetector::advance(double until) {
  for (;;) {
    if (error_) return *error_;
    if (std::optional<Event> event = deliver()) return event;
    predict_changes();
    handle_all_due();
    if (error_ || !instant_.pending().empty()) continue;
    if (next_time() > until) {
      move_on_to(until);
      return std::optional<Event>();
    }
    move_on_to(next_time());
    handle_all_due();
  }
}

void BoundDetector::handle_all_due() {
  while (!error_ && next_time() <= time_) handle_next();
}

void BoundDetector::move_on_to(double time) {
  if (time > time_) instant_.start();
  time_ = time;
}

std::optional<Event> BoundDetector::deliver() {
  std::optional<Event> event = instant_.pop(
      contacts_, [this](BodyId id) { return bodies_[id.index].present; },
      [this](std::uint32_t number) { return sphere(number); }, [](const Event&) { return Senses::neither; },
      definition_.box);
  if (!event) return event;
  ++counters_.events[static_cast<std::size_t>(event->kind)];
  if (event->repeated) ++counters_.repeated_contacts;
  return event;
}

/// Starts the new courses and predicts the contacts that changed at this instant.
void BoundDetector::predict_changes() {
  if (bodies_added_) prepare();
  bodies_added_ = false;
  while (!new_courses_.empty()) {
    const std::uint32_t number = new_courses_.back();
    new_courses_.pop_back();
    if (!fresh(number)) probe(number);
    bodies_[number].new_course = false;
    on_new_course(number);
  }
  auto& changed = instant_.changed();
  while (!changed.empty()) {
    const auto [a, b] = changed.back();
    changed.pop_back();
    if (bodies_[a].present && bodies_[b].present) on_contact_change(a, b);
  }
}

Sphere BoundDetector::sphere(std::uint32_t number) const {
  const Bound& bound = bodies_[number].bound;
  return {{number, 0}, bound.radius, {bound.centre_at(time_), bound.velocity_at(time_)},
          nullptr,     false,        0,
          1.0,         {},           definition_.contacts};
}

State BoundDetector::report(std::uint32_t number) {
  ++counters_.probes;
  return motion_.state(number, time_);
}

void BoundDetector::probe(std::uint32_t number) {
  Body& body = bodies_[number];
  State state = report(number);
  if (auto valid = check_report(state, {number, 0}, time_, definition_); !valid) {
    if (!error_) error_ = valid.error();
    state = {body.bound.centre_at(time_), body.bound.velocity_at(time_)};
  }
  const Bound before = std::exchange(body.bound, bound_of(body.definition, state, time_));
  const auto broken = bound_violation(before, body.bound, body.definition.radius, body.kicked_to,
                                      definition_.contact_tolerance);
  if (!broken) return;
  instant_.queue(violation_event(time_, {.id = {number, 0}, .state = state}, *broken,
                                 body.definition.acceleration_limit));
  begin_new_course(number);
}

double BoundDetector::pair_outlook(std::uint32_t a, std::uint32_t b, double horizon) {
  ++counters_.certificates;
  const Body& first = bodies_[a];
  const Body& second = bodies_[b];
  const Threshold threshold = contacts_.contact_threshold(a, b, definition_.contacts);
  const ContactPredictor<Bound> predictor(rule(), threshold, first.bound, second.bound, time_,
                                          {horizon, horizon});
  if (!fresh(a) || !fresh(b)) return predictor.until_reports();
  const RelativeLimits sum{first.definition.velocity_error + second.definition.velocity_error,
                           first.largest_acceleration() + second.largest_acceleration()};
  return decide(predictor, threshold, contact_event(EventKind::zeno_guard, time_, sphere(a), sphere(b)), sum);
}

double BoundDetector::wall_outlook(std::uint32_t number, double horizon) {
  if (!definition_.box) return infinity;
  const Body& body = bodies_[number];
  const double time = contacts_.walls_of(number) != 0
                          ? time_
                          : until_reports_of_walls(rule(), body.bound, *definition_.box, time_, horizon);
  if (time > time_ || !fresh(number)) return time;
  double first = infinity;
  for (const Wall wall : walls) {
    const HalfSpace inside = half_space(*definition_.box, wall);
    const Threshold threshold = contacts_.wall_threshold(number, wall, definition_.contacts);
    const ContactPredictor<HalfSpace> predictor(rule(), threshold, body.bound, inside, time_,
                                                {horizon, horizon});
    const Event current = wall_event(EventKind::zeno_guard, time_, sphere(number), *definition_.box, wall);
    const RelativeLimits limits{body.definition.velocity_error, body.largest_acceleration()};
    first = std::min(first, decide(predictor, threshold, current, limits));
  }
  return first;
}

/// Applies the contact rule to fresh reports.
template <class Partner>
double BoundDetector::decide(const ContactPredictor<Partner>& predictor, const Threshold& threshold,
                             Event current, const RelativeLimits& limits) {
  ContactDecision verdict = predictor.decide(current, limits);
  if (verdict.change == ContactRule::Change::begin && contacts_.is_jammed(current))
    verdict = predictor.defer(current, limits);
  if (verdict.is_event()) {
    current.kind = kind_of(verdict.change, false, current.wall);
    instant_.queue(current);
    return infinity;
  }
  if (verdict.change == ContactRule::Change::release) contacts_.set_touching(current, false);
  if (verdict.zeno_step) ++counters_.zeno_steps;
  const bool stays = threshold.within && verdict.change != ContactRule::Change::release;
  ContactState state = stays ? threshold.state : ContactState{};
  if (verdict.breaks_tolerance && !state.guard_reported) {
    instant_.queue(current);
    state.guard_reported = true;
    contacts_.set_state(current, state);
  }
  return verdict.next_check;
}

}  // namespace kinesphere
