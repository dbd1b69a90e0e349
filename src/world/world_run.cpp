// World::run: a loop over advance() in which the response to each event is known in advance.
#include <string>
#include <utility>

#include "bodies/validation.hpp"
#include "engine/engine.hpp"
#include "number/scope_guard.hpp"
#include "processor/responses.hpp"
#include "world/changing.hpp"
#include "world/preconditions.hpp"
#include "world/remembering_source.hpp"
#include "world/undelivered_events.hpp"

namespace kinesphere {
namespace {

/// Replaces the call name "advance" in an engine error with "run".
Error renamed(Error error) {
  constexpr std::string_view inner = "advance:";
  if (error.message.rfind(inner, 0) == 0) error.message.replace(0, inner.size(), "run:");
  return error;
}

Result<void> check_given(bool given, std::string_view argument) {
  if (given) return {};
  return Error{ErrorCode::null_callback, std::string(argument), no_body,
               "run: " + std::string(argument) + " must be a function, but is empty"};
}

/// Returns the result of check(call) for a part of a response; an error names the part and the event.
/// Composing these for the message is the expensive part, so it is done only on failure.
template <class Check>
Result<void> check_argument(const Event& event, std::string_view argument, Check check) {
  if (check("run")) return {};
  Error error =
      check("run: respond: " + std::string(argument) + " at " + std::string(name_of(event.kind))).error();
  error.argument = argument;
  return error;
}

}  // namespace

/// One call of World::run: one event after the other, each delivered to the sink.
class World::Run {
 public:
  /// Without respond_by(), events get no response. The arguments must outlive the run.
  Run(World& world, double until, const Probe& probe, const EventFn& sink, Workers* workers)
      : world_(world), until_(until), probe_(probe), on_event_(sink), lease_(workers) {}
  void respond_by(RememberingSource& source, const ResponseFn& respond) {
    source_ = &source;
    respond_ = &respond;
  }

  /// Executes the run to its end, or to the first error.
  Result<void> go() {
    if (auto valid = check_time(until_, world_.time(), world_.definition()); !valid)
      return renamed(valid.error());
    if (!lease_) {
      return Error{ErrorCode::workers_busy, "workers", no_body,
                   "run: workers must not be at work in another run, but are"};
    }
    if (!world_.undelivered_) world_.undelivered_ = std::make_unique<UndeliveredEvents>();
    world_.undelivered_->ended = false;
    world_.running_ = true;
    const ScopeGuard stop([&] { world_.running_ = false; });
    world_.changeable().begin_call(until_);
    while (!world_.undelivered_->ended) {
      const auto event = next_answered();
      if (!event) return event.error();
      if (!*event) return {};
      deliver(**event);
    }
    return {};
  }

 private:
  /// Passes an event to the sink.
  void deliver(const Event& event) {
    UndeliveredEvents& undelivered = *world_.undelivered_;
    if (source_ != nullptr) source_->forget();
    world_.changeable().note_delivery();
    world_.open_ = std::exchange(stops_, false);
    undelivered.delivering = true;
    const ScopeGuard close([&] { world_.open_ = undelivered.delivering = false; });
    on_event_(event);
  }

  /// Processes the next event, with its response. Returns nullopt if there is none before the end of the run.
  Result<std::optional<Event>> next_answered() {
    auto event = next();
    if (!event) return renamed(event.error());
    if (!*event || respond_ == nullptr) return event;
    // Keeps the event unless its response is applied, also if the callback throws.
    ScopeGuard keep([&] { world_.undelivered_->unanswered = *event; });
    if (auto answered = answer_one(**event); !answered) return answered.error();
    keep.dismiss();
    return event;
  }

  Result<std::optional<Event>> next() {
    if (auto event = world_.undelivered_->take()) return event;
    if (!may_ask_on_threads()) return world_.engine_advance(until_, probe_);
    return world_.changeable().advance(until_, probe_, &lease_);
  }

  bool may_ask_on_threads() const { return lease_.count() > 1 && world_.may_probe_on_threads(); }

  Result<void> answer_one(const Event& event) {
    auto checked = respond(event);
    if (!checked) return checked.error();
    if (const Space& space = world_.engine_->bodies().space(); space.slides())
      move_to_images_of(*source_, space, event, *checked);
    if (auto turned = apply_response(*source_, world_.definition(), event, *checked); !turned) return turned;
    const auto parts = parts_of(event, *checked);
    for (const auto& [body, velocity, spin, action] : parts)
      if (velocity) world_.changing(step::SetVelocity{body, *velocity}).set_velocity(body, *velocity);
    for (const auto& [body, velocity, spin, action] : parts)
      if (spin) world_.changing(step::SetAngularVelocity{body, *spin}).set_angular_velocity(body, *spin);
    if (checked->pair_state) {
      world_.changing(step::SetPairState{event.first, event.second, *checked->pair_state})
          .set_pair_state(event.first, event.second, *checked->pair_state);
    }
    if (checked->turned_back) world_.changing(step::TurnBack::of(event)).turn_back(event);
    for (const auto& [body, velocity, spin, action] : parts) act(body, action);
    stops_ = checked->stop;
    return {};
  }

  void act(BodyId body, BodyAction action) {
    switch (action) {
      case BodyAction::none:
        return;
      case BodyAction::remove:
        return world_.changing(step::Remove{body}).remove(body);
      case BodyAction::disable:
        return world_.changing(step::Disable{body}).disable(body);
      case BodyAction::sleep:
        return world_.changing(step::SleepBody{body}).sleep(body);
    }
  }

  Result<Response> respond(const Event& event) const {
    Response answer = (*respond_)(event);
    reduce(event.first, answer.first_velocity, answer.first_angular_velocity, answer.first_action);
    reduce(event.second, answer.second_velocity, answer.second_angular_velocity, answer.second_action);
    if (auto valid = check(event, answer); !valid) return valid.error();
    if (!is_there(event.first) || !is_there(event.second)) {
      answer.pair_state = std::nullopt;
      answer.turned_back = false;
    }
    return answer;
  }

  /// Reduces what a response says of a body to what has an effect: a response cannot know which bodies
  /// earlier responses have removed, disabled or put to sleep.
  void reduce(BodyId body, std::optional<Vec3>& velocity, std::optional<Vec3>& spin,
              BodyAction& action) const {
    if (body == no_body || (!velocity && !spin && action == BodyAction::none)) return;
    const bool is_known = is_there(body);
    const Body& now = world_.engine_->bodies()[body.index];
    if (!is_known || !now.enabled) {
      velocity = spin = std::nullopt;
      if (!is_known || action != BodyAction::remove) action = BodyAction::none;
    } else if (action == BodyAction::sleep) {
      velocity = now.is_sleeping() ? std::optional<Vec3>() : Vec3{};
      if (now.is_sleeping()) action = BodyAction::none;
    }
  }

  /// Returns true if the body is one that has not been removed.
  bool is_there(BodyId body) const { return body != no_body && Preconditions(world_, "run").is_known(body); }

  Result<void> check(const Event& event, const Response& answer) const {
    auto valid = check_action(event, event.first, answer.first_action, "first_action");
    if (valid) valid = check_action(event, event.second, answer.second_action, "second_action");
    if (valid) valid = check_velocity_change(event, event.first, answer.first_velocity, "first_velocity");
    if (valid) valid = check_velocity_change(event, event.second, answer.second_velocity, "second_velocity");
    if (valid)
      valid = check_spin(event, event.first, answer.first_angular_velocity, "first_angular_velocity");
    if (valid)
      valid = check_spin(event, event.second, answer.second_angular_velocity, "second_angular_velocity");
    return valid ? check_pair_response(event, answer) : valid;
  }

  Result<void> check_action(const Event& event, BodyId body, BodyAction action,
                            std::string_view argument) const {
    if (action == BodyAction::none) return {};
    return check_argument(event, argument, [&](std::string_view call) {
      const Preconditions check(world_, call);
      return action == BodyAction::sleep ? check.can_sleep(body) : check.known(body);
    });
  }

  Result<void> check_velocity_change(const Event& event, BodyId body, const std::optional<Vec3>& velocity,
                                     std::string_view argument) const {
    if (!velocity || Preconditions(world_, "run").may_have(body, *velocity)) return {};
    return check_argument(event, argument, [&](std::string_view call) {
      auto valid = Preconditions(world_, call).can_turn(body);
      return valid ? check_velocity(*velocity, body, world_.definition(), call) : valid;
    });
  }

  Result<void> check_spin(const Event& event, BodyId body, const std::optional<Vec3>& spin,
                          std::string_view argument) const {
    if (!spin) return {};
    return check_argument(event, argument, [&](std::string_view call) -> Result<void> {
      auto valid = Preconditions(world_, call).can_spin(body, *spin);
      if (!valid || !world_.engine_->bodies().rigid.probe) return valid;
      return Error{ErrorCode::unsupported, std::string(argument), body,
                   std::string(call) + ": must be given by the rotation probe of the world"};
    });
  }

  World& world_;
  double until_;
  const Probe& probe_;
  const EventFn& on_event_;
  PoolLease lease_;
  bool stops_ = false;  ///< the response to the last event has Response::stop, and the sink is still to come
  RememberingSource* source_ = nullptr;
  const ResponseFn* respond_ = nullptr;
};

Result<void> World::run(double until, MotionSource& motions, const ResponseFn& respond, const EventFn& sink,
                        Workers* workers) {
  RememberingSource source(motions);
  const Probe probe = [&source](std::span<const BodyId> ids, double time, std::span<State> states) {
    source.states(ids, time, states);
  };
  auto valid = Preconditions(*this, "run").may_advance();
  if (valid) valid = check_given(static_cast<bool>(respond), "respond");
  if (valid) valid = check_given(static_cast<bool>(sink), "sink");
  if (!valid) return valid;
  Run run(*this, until, probe, sink, workers);
  run.respond_by(source, respond);
  return run.go();
}

Result<void> World::run(double until, const Probe& probe, const EventFn& sink, Workers* workers) {
  auto valid = Preconditions(*this, "run").may_advance();
  if (valid) valid = Preconditions(*this, "run").may_ask(probe);
  if (valid) valid = check_given(static_cast<bool>(sink), "sink");
  if (!valid) return valid;
  return Run(*this, until, probe, sink, workers).go();
}

void World::end_run() {
  if (undelivered_ && undelivered_->delivering) undelivered_->ended = true;
}

}  // namespace kinesphere
