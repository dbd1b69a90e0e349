// One call of World::run: repeated work, each time followed by delivering the resulting events to the sink.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string_view>

#include "engine/engine.hpp"
#include "kinesphere/world.hpp"
#include "parallel/thread_pool.hpp"

namespace kinesphere {

/// Events that the engine has delivered, but that run() has not completely processed.
struct World::UndeliveredEvents {
  std::deque<Event> events{};         ///< responses applied, not yet delivered to the sink; in order
  std::optional<Event> unanswered{};  ///< response not applied; comes after `events`
  bool delivering = false;            ///< true inside the sink
  bool ended = false;                 ///< the sink has called World::end_run()

  bool empty() const { return events.empty() && !unanswered; }
  /// Removes and returns the first event, or nullopt if there is none.
  std::optional<Event> take();
};

class World::Run final : private ResponseHandler {
 public:
  /// Without respond_by(), events get no response. The arguments must outlive the run.
  Run(World& world, double until, const Probe& probe, const EventFn& sink, Workers* workers)
      : world_(world), until_(until), probe_(probe), on_event_(sink), lease_(workers) {}
  void respond_by(MotionSource& source, const ResponseFn& respond) {
    source_ = &source;
    respond_ = &respond;
  }

  /// Executes the run to its end, or to the first error.
  Result<void> go();

 private:
  /// Does some work, and appends the resulting events to undelivered_->events. Returns true when the world
  /// has reached the end of the run. Precondition: all earlier events in undelivered_->events have been
  /// delivered to the sink.
  Result<bool> work();
  Result<bool> step_batch();
  Result<bool> step(double until, PoolLease* sharing);
  bool deliver();
  bool shares_work() const;
  bool stands_back();
  Result<std::optional<Event>> next(double until, PoolLease* sharing);
  Result<void> answer_one(const Event& event);
  void act(BodyId body, BodyAction action);
  Result<Response> respond(const Event& event) override;
  Result<void> apply(const Event& event, const Response& answer) override {
    return apply_response(*source_, world_.definition(), event, answer);
  }
  MotionOrigin origin(BodyId body) override { return source_->origin(body); }
  void set_origin(BodyId body, const MotionOrigin& origin) override { source_->set_origin(body, origin); }
  void reduce(BodyId body, std::optional<Vec3>& velocity, std::optional<Vec3>& spin,
              BodyAction& action) const;
  Result<void> check(const Event& event, const Response& answer) const;
  Result<void> check_action(const Event& event, BodyId body, BodyAction action,
                            std::string_view argument) const;
  Result<void> check_velocity_change(const Event& event, BodyId body, const std::optional<Vec3>& velocity,
                                     std::string_view argument) const;
  Result<void> check_spin(const Event& event, BodyId body, const std::optional<Vec3>& spin,
                          std::string_view argument) const;

  World& world_;
  double until_;
  const Probe& probe_;
  const EventFn& on_event_;
  PoolLease lease_;
  ThreadGain* gain_ = nullptr;               ///< nullptr if the threads never stand back
  std::optional<SpeculativeRunner> runner_;  ///< created when several threads are used
  /// End of the epoch in which speculative execution does not pay off: until then, events are processed one
  /// by one.
  std::optional<double> one_by_one_{};
  /// Time of an instant whose events are processed one by one (SpeculativeRunner::exclusive).
  std::optional<double> exclusive_{};
  bool stops_ = false;  ///< the response to the last event has Response::stop, and the sink is still to come
  MotionSource* source_ = nullptr;
  const ResponseFn* respond_ = nullptr;
};

}  // namespace kinesphere
