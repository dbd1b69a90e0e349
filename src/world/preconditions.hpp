// What a public call of a world checks before anything changes: the call itself, the bodies that it names,
// and the room for what it wants.
#pragma once

#include <optional>
#include <string_view>

#include "engine/engine.hpp"
#include "kinesphere/world.hpp"

namespace kinesphere {

/// The checks of one call, whose name begins all messages. Those of room need a world that passes exists().
class World::Preconditions {
 public:
  Preconditions(const World& world, std::string_view call)
      : world_(world), engine_(world.engine_.get()), call_(call) {}

  // Of the call.

  /// The world has not been moved from.
  Result<void> exists() const;
  /// It exists, and is not being asked from inside its own probe, pair filter or run.
  Result<void> idle() const;
  /// It is idle, and has told all events of a run() that was interrupted.
  Result<void> all_told() const;
  /// It is idle, and there is a probe to ask.
  Result<void> may_ask(const Probe& probe) const;

  // Of a body that an argument names.

  /// The world exists, and the body is one of its own and has not been removed.
  Result<void> known(BodyId body) const;
  /// The same as a plain answer, of a world that exists.
  bool is_known(BodyId body) const { return !is_foreign(body) && engine_->bodies().table().is_alive(body); }
  /// Known, and the world is idle.
  Result<void> changeable(BodyId body) const;
  /// Changeable, and enabled or disabled as the call needs it.
  Result<void> enabled(BodyId body, bool enabled) const;
  /// Changeable, and not fixed.
  Result<void> moving(BodyId body) const;
  /// Moving and enabled.
  Result<void> mobile(BodyId body) const;
  /// The same for an answer during a run: mobile, but for the world being idle.
  Result<void> can_turn(BodyId body) const;
  /// Two different bodies, both changeable.
  Result<void> pair(BodyId first, BodyId second) const;

  // Of room, by id as it is or is going to be.

  /// There is room for the body, where overlaps are not allowed.
  Result<void> room(const BodyDefinition& body, BodyId id) const;
  Result<void> static_room(const StaticDefinition& fixed, BodyId id) const;
  /// The body may be in this state now.
  Result<void> moved(BodyId id, const State& state) const;
  /// There is room for a body to grow where it is: where space repeats, and where overlaps are not allowed.
  Result<void> growth(const BodyDefinition& changed, BodyId id, std::string_view argument) const;
  /// There is room where space repeats for all that the body senses.
  Result<void> reach(const BodyDefinition& changed, BodyId id, std::string_view argument) const;
  /// Everything about a body that is to be added.
  Result<void> new_body(const BodyDefinition& body, BodyId id) const;
  /// The same of a fixed body: its definition as the world keeps it.
  Result<StaticDefinition> new_static(const StaticDefinition& fixed, BodyId id) const;

 private:
  const WorldDefinition& definition() const { return engine_->definition(); }
  bool is_foreign(BodyId body) const;
  // Of a body that is known.
  Result<void> is_enabled(BodyId body, bool enabled) const;
  Result<void> is_moving(BodyId body) const;
  Error error_about(ErrorCode code, BodyId body, std::string_view what) const;

  const World& world_;
  const Engine* engine_;
  std::string_view call_;
};

}  // namespace kinesphere
