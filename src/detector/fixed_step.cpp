// Fixed steps: what most programs do. Every step all bodies are moved, and pairs that overlap then are
// contacts.
#include <algorithm>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "contact/contact_event.hpp"
#include "contact/contact_rule.hpp"
#include "detector/checked_detector.hpp"
#include "input/input_check.hpp"
#include "kinesphere/detector.hpp"
#include "space/hash_grid.hpp"

namespace kinesphere {
namespace {

class FixedStep final : public Detector {
 public:
  FixedStep(const WorldDefinition& definition, const Motion& motion, double step, FixedStepSearch search)
      : definition_(definition),
        rule_(definition),
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
    bodies_[number] = {.active = true,
                       .radius = definition.radius + definition.position_error,
                       .state = {definition.position, definition.velocity}};
    return {};
  }

  Result<void> remove(std::uint32_t number) override {
    for (auto pair = touching_.begin(); pair != touching_.end();) {
      const bool concerned = pair->first == number || pair->second == number;
      if (concerned && !rule_.impacts_only())
        pending_.push_back(
            contact_event(EventKind::contact_end, time_, sphere(pair->first), sphere(pair->second)));
      pair = concerned ? touching_.erase(pair) : std::next(pair);
    }
    for (const Wall wall : walls)
      if (bodies_[number].walls & wall_bit(wall) && !rule_.impacts_only())
        pending_.push_back(wall_event(EventKind::wall_end, time_, sphere(number), *definition_.box, wall));
    bodies_[number].active = false;
    if (search_ == FixedStepSearch::grid) grid_.remove(number);
    std::sort(pending_.begin(), pending_.end(), delivered_before);
    return {};
  }

  Result<void> kick(std::uint32_t number, const Vec3& velocity) override {
    bodies_[number].state.velocity = velocity;
    if (!rule_.impacts_only()) return {};
    std::erase_if(touching_, [=](const auto& pair) { return pair.first == number || pair.second == number; });
    bodies_[number].walls = 0;
    return {};
  }

  Result<std::optional<Event>> advance(double until) override {
    for (;;) {
      if (!pending_.empty()) {
        const Event event = pending_.front();
        pending_.erase(pending_.begin());
        ++counters_.events[static_cast<std::size_t>(event.kind)];
        return std::optional(event);
      }
      const double next = definition_.start_time + static_cast<double>(next_step_) * step_;
      if (next > until) {
        time_ = until;
        return std::optional<Event>();
      }
      time_ = next;
      ++next_step_;
      look();
    }
  }

  double time() const override { return time_; }
  Counters counters() const override { return counters_; }
  Result<Bound> bound(std::uint32_t number) const override {
    const auto& [active, radius, state, walls] = bodies_[number];
    return Bound{.time = time_, .position = state.position, .velocity = state.velocity, .radius = radius};
  }

 private:
  struct Body {
    bool active = false;
    double radius = 0.0;
    State state{};
    std::uint8_t walls = 0;
  };
  using Pair = std::pair<std::uint32_t, std::uint32_t>;

  Sphere sphere(std::uint32_t number) const {
    return {{number, 0}, bodies_[number].radius, bodies_[number].state};
  }

  void look() {
    for (std::uint32_t number = 0; number < bodies_.size(); ++number) {
      Body& body = bodies_[number];
      if (!body.active) continue;
      body.state = motion_.state(number, time_);
      ++counters_.probes;
      if (search_ == FixedStepSearch::grid) grid_.set(number, box_of(body));
    }
    for (std::uint32_t number = 0; number < bodies_.size(); ++number) {
      if (!bodies_[number].active) continue;
      for_each_neighbour(number, [&](std::uint32_t other) {
        if (other < number && !touching_.contains({other, number})) look_at_pair({other, number}, false);
      });
      if (definition_.box)
        for (const Wall wall : walls) look_at_wall(number, wall);
    }
    const std::vector<Pair> touching(touching_.begin(), touching_.end());
    for (const Pair& pair : touching) look_at_pair(pair, true);
    std::sort(pending_.begin(), pending_.end(), delivered_before);
    for (const Pair& pair : begun_) touching_.insert(pair);
    begun_.clear();
  }

  template <class Visit>
  void for_each_neighbour(std::uint32_t number, Visit visit) {
    if (search_ == FixedStepSearch::grid) {
      ++counters_.searches;
      grid_.for_each_overlap(box_of(bodies_[number]), visit);
      return;
    }
    for (std::uint32_t other = 0; other < number; ++other)
      if (bodies_[other].active) visit(other);
  }

  Box box_of(const Body& body) const {
    const double reach = body.radius + rule_.release_gap();
    const Vec3 half{reach, reach, reach};
    return {body.state.position - half, body.state.position + half};
  }

  void look_at_pair(const Pair& pair, bool touching) {
    ++counters_.certificates;
    Event event = contact_event(EventKind::contact_begin, time_, sphere(pair.first), sphere(pair.second));
    const auto change = rule_.decide(touching, event.gap, event.approach_speed);
    if (change == ContactRule::Change::none) return;
    if (touching) touching_.erase(pair);
    if (change == ContactRule::Change::release) return;
    if (change == ContactRule::Change::begin) begun_.push_back(pair);
    if (change == ContactRule::Change::end) event.kind = EventKind::contact_end;
    pending_.push_back(event);
  }

  void look_at_wall(std::uint32_t number, Wall wall) {
    const bool touching = (bodies_[number].walls & wall_bit(wall)) != 0;
    Event event = wall_event(EventKind::wall_begin, time_, sphere(number), *definition_.box, wall);
    const auto change = rule_.decide(touching, event.gap, event.approach_speed);
    if (change == ContactRule::Change::none) return;
    bodies_[number].walls ^= wall_bit(wall);
    if (change == ContactRule::Change::release) return;
    if (change == ContactRule::Change::end) event.kind = EventKind::wall_end;
    pending_.push_back(event);
  }

  WorldDefinition definition_;
  ContactRule rule_;
  const Motion& motion_;
  double step_;
  FixedStepSearch search_;
  double time_;
  std::uint64_t next_step_ = 0;
  std::vector<Body> bodies_;
  HashGrid grid_;
  std::set<Pair> touching_;
  std::vector<Pair> begun_;
  std::vector<Event> pending_;
  Counters counters_;
};

}  // namespace

Result<std::unique_ptr<Detector>> make_fixed_step_detector(const WorldDefinition& definition,
                                                           const Motion& motion, double step,
                                                           FixedStepSearch search) {
  if (auto valid = InputCheck("make_fixed_step_detector").positive({"step"}, step).result(); !valid)
    return valid.error();
  return make_checked<FixedStep>(definition, motion, step, search);
}

}  // namespace kinesphere
