// One call of World::run: phases of work, after each of which the sink is told what came of it.
#pragma once

#include <deque>
#include <optional>
#include <string_view>

#include "engine/engine.hpp"
#include "kinesphere/world.hpp"
#include "parallel/crew.hpp"

namespace kinesphere {

/// Events that were delivered, but have not gone all the way of an event of run().
struct World::Backlog {
  std::deque<Event> untold{};         ///< answered, in their order
  std::optional<Event> unanswered{};  ///< comes after them

  bool empty() const { return untold.empty() && !unanswered; }
  /// The first of them, which is gone then.
  std::optional<Event> take();
};

class World::Run final : private Answerer {
 public:
  /// Without mover and respond, events get no answer.
  Run(World& world, double until, const Probe& probe, const Sink& sink, Workers* workers)
      : world_(world), until_(until), probe_(probe), sink_(sink), shift_(workers) {}
  void answer_by(Mover& mover, const Respond& respond) {
    mover_ = &mover;
    respond_ = &respond;
  }

  /// The whole run.
  Result<void> go();

 private:
  class Unanswered;

  /// Does some work, and appends the events that came of it to the untold ones. True when the world has
  /// reached the end of the run. Needs all events before to have been told.
  Result<bool> work();
  Result<bool> phase();
  Result<bool> step();
  void tell();

  Result<std::optional<Event>> next();
  Result<void> answer_one(const Event& event);
  Result<Answer> answer(const Event& event) override;
  Result<void> turn(const Event& event, const Answer& answer) override {
    return kinesphere::turn(*mover_, world_.definition(), event, answer);
  }
  Departure departure(BodyId body) override { return mover_->departure(body); }
  void depart(BodyId body, const Departure& departure) override { mover_->depart(body, departure); }
  Result<void> check(const Event& event, const Answer& answer) const;
  Result<void> check_kick(const Event& event, BodyId body, const std::optional<Vec3>& velocity,
                          std::string_view argument) const;

  World& world_;
  double until_;
  const Probe& probe_;
  const Sink& sink_;
  Shift shift_;
  std::optional<Islands> islands_;  ///< where several threads work
  /// Where islands are not worth it: until this end of a phase.
  std::optional<double> one_by_one_{};
  Mover* mover_ = nullptr;
  const Respond* respond_ = nullptr;
};

}  // namespace kinesphere
