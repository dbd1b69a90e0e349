// One call of World::run: phases of work, after each of which the sink is told what came of it.
#pragma once

#include <deque>
#include <optional>
#include <string_view>

#include "engine/engine.hpp"
#include "kinesphere/world.hpp"
#include "parallel/thread_pool.hpp"

namespace kinesphere {

/// Events that were delivered, but have not gone all the way of an event of run().
struct World::UntoldEvents {
  std::deque<Event> events{};         ///< answered, in their order
  std::optional<Event> unanswered{};  ///< comes after them

  bool empty() const { return events.empty() && !unanswered; }
  /// The first of them, which is gone then.
  std::optional<Event> take();
};

class World::Run final : private ResponseHandler {
 public:
  /// Without mover and respond, events get no answer.
  Run(World& world, double until, const Probe& probe, const EventFn& sink, Workers* workers)
      : world_(world), until_(until), probe_(probe), on_event_(sink), lease_(workers) {}
  void respond_by(MotionSource& source, const ResponseFn& respond) {
    source_ = &source;
    respond_ = &respond;
  }

  /// The whole run.
  Result<void> go();

 private:
  class UnansweredGuard;

  /// Does some work, and appends the events that came of it to the untold ones. True when the world has
  /// reached the end of the run. Needs all events before to have been told.
  Result<bool> work();
  Result<bool> phase();
  Result<bool> step();
  void tell();

  Result<std::optional<Event>> next();
  Result<void> answer_one(const Event& event);
  Result<Response> respond(const Event& event) override;
  Result<void> apply(const Event& event, const Response& answer) override {
    return kinesphere::turn(*source_, world_.definition(), event, answer);
  }
  MotionOrigin origin(BodyId body) override { return source_->origin(body); }
  void set_origin(BodyId body, const MotionOrigin& origin) override { source_->set_origin(body, origin); }
  Result<void> check(const Event& event, const Response& answer) const;
  Result<void> check_kick(const Event& event, BodyId body, const std::optional<Vec3>& velocity,
                          std::string_view argument) const;

  World& world_;
  double until_;
  const Probe& probe_;
  const EventFn& on_event_;
  PoolLease lease_;
  std::optional<SpeculativeRunner> runner_;  ///< where several threads work
  /// Where islands are not worth it: until this end of a phase.
  std::optional<double> one_by_one_{};
  MotionSource* source_ = nullptr;
  const ResponseFn* respond_ = nullptr;
};

}  // namespace kinesphere
