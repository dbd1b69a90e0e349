// The default engine as a detector.
#include <utility>
#include <vector>

#include "kinesphere/inspection.hpp"
#include "simulation/detector/checked_detector.hpp"
#include "simulation/detector/detector.hpp"
#include "simulation/detector/numbered_event.hpp"

namespace kinesphere {
namespace {

/// NumberedMotionSource moves the bodies of a world by their numbers in a motion.
class NumberedMotionSource final : public MotionSource {
 public:
  /// `numbers` maps the index of an id to the number of the body. It must outlive the mover.
  NumberedMotionSource(Motion& motion, const std::vector<std::uint32_t>& numbers)
      : motion_(motion), numbers_(numbers) {}

  void states(std::span<const BodyId> ids, double time, std::span<State> states) override {
    for (std::size_t k = 0; k < ids.size(); ++k) states[k] = motion_.state(numbers_[ids[k].index], time);
  }
  MotionOrigin origin(BodyId body) const override { return motion_.origin(numbers_[body.index]); }
  void set_origin(BodyId body, const MotionOrigin& origin) override {
    motion_.set_origin(numbers_[body.index], origin).value();
  }

 private:
  Motion& motion_;
  const std::vector<std::uint32_t>& numbers_;
};

class WorldDetector final : public Detector {
 public:
  WorldDetector(World world, const Motion& motion)
      : world_(std::move(world)), motion_(motion), ids_(motion.size(), no_body) {}

  std::string_view name() const override { return "world"; }

  Result<void> add(std::uint32_t number, const BodyDefinition& definition) override {
    BodyDefinition numbered = definition;
    numbered.user_data = number;  // the number, for readers of a recording
    const auto id = world_.add(numbered);
    if (!id) return id.error();
    ids_[number] = *id;
    if (id->index >= numbers_.size()) numbers_.resize(id->index + 1);
    numbers_[id->index] = number;
    return {};
  }

  Result<void> remove(std::uint32_t number) override {
    // Contacts of the removed body still end, in events under its number.
    departed_.push_back({ids_[number], number});
    return world_.remove(ids_[number]);
  }

  Result<void> set_velocity(std::uint32_t number, const Vec3& velocity) override {
    return world_.set_velocity(ids_[number], velocity);
  }

  Result<std::optional<Event>> advance(double until) override {
    const auto probe = [this](std::span<const BodyId> ids, double time, std::span<State> states) {
      for (std::size_t k = 0; k < ids.size(); ++k) states[k] = motion_.state(numbers_[ids[k].index], time);
    };
    auto event = world_.advance(until, probe);
    if (event && *event) {
      number_bodies(**event, [this](BodyId id) { return number_of(id); });
    } else if (event) {
      departed_.clear();
    }
    return event;
  }

  Result<void> run(double until, Motion& motion, const ResponseFn& respond, const EventFn& sink,
                   Workers& workers) override {
    NumberedMotionSource source(motion, numbers_);
    const auto with_numbers = [this](Event event) {
      number_bodies(event, [this](BodyId id) { return number_of(id); });
      return event;
    };
    const auto answer = [&](const Event& event) {
      const Event event_with_numbers = with_numbers(event);
      Response answered = respond(event_with_numbers);
      if (event_with_numbers.first.index != number_of(event.first))
        std::swap(answered.first_velocity, answered.second_velocity);
      return answered;
    };
    auto gone = world_.run(
        until, source, answer, [&](const Event& event) { sink(with_numbers(event)); }, &workers);
    if (gone) departed_.clear();
    return gone;
  }

  double time() const override { return world_.time(); }
  DetectorCounters counters() const override { return {world_.counters()}; }
  Result<Bound> bound(std::uint32_t number) const override { return world_.body(ids_[number])->bound; }
  std::optional<AuditFinding> audit() const override { return world_.inspection().audit(); }
  std::optional<Memory> memory() const override { return world_.inspection().memory(); }
  Result<void> start_recording() override { return world_.start_recording(); }
  Result<std::vector<std::byte>> stop_recording() override { return world_.stop_recording(); }
  Result<void> set_profiling(bool on) override { return world_.set_profiling(on); }
  Result<std::vector<BusyBody>> busiest(std::size_t count) const override {
    auto busiest = world_.inspection().busiest(count);
    if (busiest)
      for (BusyBody& busy : *busiest) busy.body = {numbers_[busy.body.index], 0};
    return busiest;
  }

 private:
  struct Departed {
    BodyId id;
    std::uint32_t number;
  };

  std::uint32_t number_of(BodyId id) const {
    for (const Departed& departed : departed_)
      if (departed.id == id) return departed.number;
    return numbers_[id.index];
  }

  World world_;
  const Motion& motion_;
  std::vector<BodyId> ids_;             ///< ids by number
  std::vector<std::uint32_t> numbers_;  ///< numbers by the index of an id
  std::vector<Departed> departed_;
};

}  // namespace

Result<std::unique_ptr<Detector>> make_world_detector(const WorldDefinition& definition,
                                                      const Motion& motion) {
  return make_sensing_detector(definition, motion, {});
}

Result<std::unique_ptr<Detector>> make_sensing_detector(const WorldDefinition& definition,
                                                        const Motion& motion, const Sensor& sensor) {
  auto world = World::create(definition);
  if (!world) return world.error();
  // Sensor class 0 holds all bodies.
  if (auto set = world->set_sensor(0, sensor); !set) return set.error();
  if (auto reserved = world->reserve(motion.size()); !reserved) return reserved.error();
  return with_checked_input(std::make_unique<WorldDetector>(std::move(*world), motion), definition,
                            motion.size(), NewBodies::checked_by_itself);
}

}  // namespace kinesphere
