// Fixed steps, as in most programs: at every step all bodies are moved, and pairs that overlap then are
// contacts.
#include <algorithm>
#include <utility>
#include <vector>

#include "bodies/validation.hpp"
#include "contact/contact_predictor.hpp"
#include "contact/pending_events.hpp"
#include "input/input_check.hpp"
#include "number/infinity.hpp"
#include "research/measures/box_grid.hpp"
#include "research/rivals/rivals.hpp"
#include "simulation/detector/checked_detector.hpp"
#include "simulation/detector/detector.hpp"

namespace kinesphere {
namespace {

class FixedStep final : public Detector {
 public:
  FixedStep(const WorldDefinition& definition, const Motion& motion, double step, FixedStepSearch search)
      : definition_(definition),
        contacts_(definition),
        motion_(motion),
        step_(step),
        search_(search),
        time_(definition.start_time) {
    bodies_.resize(motion.size());
  }

  std::string_view name() const override {
    return search_ == FixedStepSearch::grid ? "fixed-step" : "brute-force";
  }

  Result<void> add(std::uint32_t number, const BodyDefinition& definition) override {
    bodies_[number] = {.present = true,
                       .radius = definition.radius + definition.position_error,
                       .state = {definition.position, definition.velocity},
                       .seen = time_};
    contacts_.add(number, definition.acceleration_limit + norm(definition.planned_acceleration));
    return {};
  }

  Result<void> remove(std::uint32_t number) override {
    instant_.end_all_contacts(
        contacts_, number, time_, [this](std::uint32_t body) { return sphere(body); }, definition_.box);
    bodies_[number].present = false;
    return {};
  }

  Result<void> set_velocity(std::uint32_t number, const Vec3& velocity) override {
    bodies_[number].state.velocity = velocity;
    contacts_.turn_reported(number);
    return {};
  }

  Result<std::optional<Event>> advance(double until) override {
    for (;;) {
      if (std::optional<Event> event = deliver()) return event;
      const double next = definition_.start_time + static_cast<double>(next_step_) * step_;
      if (next > until) {
        move_on_to(until);
        return std::optional<Event>();
      }
      move_on_to(next);
      ++next_step_;
      if (auto moved = move_all(); !moved) return moved.error();
      look();
    }
  }

  double time() const override { return time_; }
  DetectorCounters counters() const override { return counters_; }
  Result<Bound> bound(std::uint32_t number) const override {
    const Body& body = bodies_[number];
    return Bound{.time = body.seen,
                 .position = body.state.position,
                 .velocity = body.state.velocity,
                 .radius = body.radius};
  }

 private:
  struct Body {
    bool present = false;
    double radius = 0.0;
    State state{};
    double seen = 0.0;  ///< time of the state
  };

  Sphere sphere(std::uint32_t number) const {
    return {{number, 0}, bodies_[number].radius, bodies_[number].state, nullptr, false, 0, 1.0,
            {},          definition_.contacts};
  }

  void move_on_to(double time) {
    if (time > time_) instant_.start();
    time_ = time;
  }

  std::optional<Event> deliver() {
    std::optional<Event> event = instant_.pop(
        contacts_, [this](BodyId id) { return bodies_[id.index].present; },
        [this](std::uint32_t number) { return sphere(number); }, [](const Event&) { return Senses::neither; },
        definition_.box);
    instant_.changed().clear();
    if (!event) return event;
    ++counters_.events[static_cast<std::size_t>(event->kind)];
    if (event->repeated) ++counters_.repeated_contacts;
    return event;
  }

  Result<void> move_all() {
    for (std::uint32_t number = 0; number < bodies_.size(); ++number) {
      Body& body = bodies_[number];
      if (!body.present) continue;
      const State state = motion_.state(number, time_);
      ++counters_.probes;
      if (auto valid = check_report(state, {number, 0}, time_, definition_); !valid) return valid;
      body.state = state;
      body.seen = time_;
    }
    return {};
  }

  void look() {
    find_near();
    auto pair = near_.begin();
    for (std::uint32_t number = 0; number < bodies_.size(); ++number) {
      if (!bodies_[number].present) continue;
      // Partners that have parted far may no longer be found by the search.
      const auto touched = contacts_.partners_of(number);
      const std::vector<ContactRecord> partners(touched.begin(), touched.end());
      for (const auto& [partner, state] : partners)
        if (partner < number) look_at_pair(partner, number);
      for (; pair != near_.end() && pair->first == number; ++pair)
        if (!contacts_.touch(pair->second, number)) look_at_pair(pair->second, number);
      if (definition_.box)
        for (const Wall wall : walls) look_at_wall(number, wall);
    }
  }

  /// Finds the pairs to look at.
  void find_near() {
    near_.clear();
    std::vector<BoxGrid::Entry> boxes;
    for (std::uint32_t number = 0; number < bodies_.size(); ++number)
      if (bodies_[number].present) boxes.push_back({box_of(bodies_[number]), number});
    if (search_ == FixedStepSearch::all_pairs) {
      for (std::size_t b = 0; b < boxes.size(); ++b)
        for (std::size_t a = 0; a < b; ++a) near_.emplace_back(boxes[b].body, boxes[a].body);
      return;
    }
    counters_.searches += boxes.size();
    grid_.build(boxes);
    grid_.for_each_pair([this](std::uint32_t a, std::uint32_t b) { near_.emplace_back(a, b); });
    std::sort(near_.begin(), near_.end());
  }

  Box box_of(const Body& body) const {
    const double reach = body.radius + contacts_.rule().release_gap();
    const Vec3 half{reach, reach, reach};
    return {body.state.position - half, body.state.position + half};
  }

  void look_at_pair(std::uint32_t a, std::uint32_t b) {
    ++counters_.certificates;
    const Sphere first = sphere(a);
    const Sphere second = sphere(b);
    const Event event = contact_event(EventKind::contact_begin, time_, first, second);
    const ContactTerms terms = terms_of(event, first, second);
    judge(event, approach_error(event, terms.arm, terms.rates));
  }

  void look_at_wall(std::uint32_t number, Wall wall) {
    const Event event = wall_event(EventKind::wall_begin, time_, sphere(number), *definition_.box, wall);
    judge(event, approach_error(event.first_state, event.second_state, infinity));
  }

  void judge(Event event, double error) {
    const Threshold threshold = contacts_.threshold_of(event, definition_.contacts);
    const auto change = contacts_.rule().decide(threshold, event.gap, event.approach_speed, error);
    if (change == ContactRule::Change::none) return;
    if (change == ContactRule::Change::release) return contacts_.set_touching(event, false);
    event.kind = kind_of(change, false, event.wall);
    instant_.queue(event);
  }

  WorldDefinition definition_;
  ContactGraph contacts_;
  PendingEvents instant_;
  const Motion& motion_;
  double step_;
  FixedStepSearch search_;
  double time_;
  std::uint64_t next_step_ = 0;
  std::vector<Body> bodies_;
  BoxGrid grid_;                                               ///< boxes of the bodies at the present step
  std::vector<std::pair<std::uint32_t, std::uint32_t>> near_;  ///< pairs to look at, the larger number first
  DetectorCounters counters_;
};

}  // namespace

Result<std::unique_ptr<Detector>> make_fixed_step_detector(const WorldDefinition& definition,
                                                           const Motion& motion, double step,
                                                           FixedStepSearch search) {
  if (auto valid = check_world(definition); !valid) return valid.error();
  if (auto valid = InputCheck("make_fixed_step_detector")
                       .positive({"step"}, step)
                       .require(definition.start_time + step > definition.start_time, ErrorCode::out_of_range,
                                {"step"}, "must be long enough for the clock to move", step)
                       .result();
      !valid)
    return valid.error();
  return make_checked<FixedStep>(definition, motion, step, search);
}

}  // namespace kinesphere
