// Preconditions of a world's public calls, checked before anything changes: the call itself, the bodies named
// in its arguments, and the space that the change needs.
#pragma once

#include <string_view>

#include "bodies/validation.hpp"
#include "engine/engine.hpp"
#include "kinesphere/world.hpp"

namespace kinesphere {

/// Checks for one call; its name begins every error message. Checks under "Space" require exists().
class World::Preconditions {
 public:
  Preconditions(const World& world, std::string_view call)
      : world_(world), engine_(world.engine_.get()), call_(call) {}

  // The call.

  /// The world has not been moved from (ErrorCode::moved_from).
  Result<void> exists() const;
  /// The world exists, and the call does not come from inside its own probe, pair filter or run().
  Result<void> idle() const;
  /// The world is idle, and every event of an interrupted run() has been delivered
  /// (ErrorCode::run_in_progress).
  Result<void> all_delivered() const;
  /// The world is idle, and the call does not come from the sink of its own run() either, to which a stop
  /// (Response::stop) opens the world.
  Result<void> may_advance() const;
  /// The world is idle, and `probe` is not empty (ErrorCode::null_probe).
  Result<void> may_ask(const Probe& probe) const;
  /// The world is idle, and the facet's probe, if it has one, is not empty.
  Result<void> may_ask(const Facet& facet) const { return facet.probing ? may_ask(facet.probe) : idle(); }

  // Bodies named in arguments.

  /// The world exists, and the body belongs to it and has not been removed (ErrorCode::foreign_body,
  /// stale_body or unknown_body).
  Result<void> known(BodyId body) const;
  /// Returns true if known() holds. Precondition: exists().
  bool is_known(BodyId body) const { return !is_foreign(body) && engine_->bodies().table().is_alive(body); }
  /// Returns true if can_turn() holds, as it nearly always does. Precondition: exists().
  bool may_turn(BodyId body) const {
    if (!is_known(body)) return false;
    const Body& record = engine_->bodies()[body.index];
    return record.enabled && !record.is_static();
  }
  /// Returns true if the body may turn to this velocity, as it nearly always may. Precondition: exists().
  bool may_have(BodyId body, const Vec3& velocity) const {
    return may_turn(body) && is_valid_velocity(velocity, definition());
  }
  /// The world is idle, and the body is known.
  Result<void> changeable(BodyId body) const;
  /// The body is changeable, and enabled or disabled as requested.
  Result<void> enabled(BodyId body, bool enabled) const;
  /// The body is changeable and not static.
  Result<void> moving(BodyId body) const;
  /// The body is changeable, not static, and enabled.
  Result<void> mobile(BodyId body) const;
  /// Like mobile(), but without idle(): for responses during run().
  Result<void> can_turn(BodyId body) const;
  /// Like can_turn(), for a ball or a moving shape whose size does not change with time
  /// (ErrorCode::unsupported).
  Result<void> can_sleep(BodyId body) const;
  /// The two bodies are different, and each is changeable.
  Result<void> pair(BodyId first, BodyId second) const;

  // Space. `id` is the id that the body has, or will have once added.

  /// If overlaps are forbidden, the body overlaps no other body at its position.
  Result<void> no_overlap(const BodyDefinition& body, BodyId id) const;
  Result<void> no_static_overlap(const StaticDefinition& added, BodyId id) const;
  Result<void> no_overlap(const MovingShape& added, BodyId id) const;
  /// A rigid body with this definition and rotation may be added, or be there.
  Result<void> new_rigid_body(const RigidBody& body, BodyId id) const;
  Result<void> room_for(const RigidBody& body, BodyId id) const;
  /// The body is rigid, and may be turned to this rotation at the present time.
  Result<void> turned(BodyId id, const Rotation& rotation) const;
  /// Like can_turn(), for a rigid body and its angular velocity.
  Result<void> can_spin(BodyId body, const Vec3& angular_velocity) const;
  /// The body may be changed so.
  Result<void> changed(BodyId id, const BodyChange& change) const;
  /// The body may be put into this state at the present time.
  Result<void> moved(BodyId id, const State& state) const;
  /// The body may grow at its present position: reach() holds, and if overlaps are forbidden, it overlaps
  /// neither a wall nor another body.
  Result<void> growth(const BodyDefinition& changed, BodyId id, std::string_view argument) const;
  /// The body and its sensor range fit into the period on periodic axes.
  Result<void> reach(const BodyDefinition& changed, BodyId id, std::string_view argument) const;
  /// The definition is valid for adding a body. `id` is its future id.
  Result<void> new_body(const BodyDefinition& body, BodyId id) const;
  /// The definition is valid for adding a static body. Returns it with its shape normalized, as the world
  /// stores it.
  Result<StaticDefinition> new_static(const StaticDefinition& added, BodyId id) const;
  /// The definition is valid for adding a moving shape. Returns it with its shape normalized, as the world
  /// stores it.
  Result<MovingShape> new_moving_shape(const MovingShape& added, BodyId id) const;
  /// The world is idle, the body is known, static or a moving shape, and it may have this shape. Returns the
  /// shape normalized, as the world stores it.
  Result<Shape> reshaped(BodyId id, const Shape& shape) const;

 private:
  const WorldDefinition& definition() const { return engine_->definition(); }
  /// Returns the definition of the world, without its walls for a body with a shape.
  WorldDefinition domain_of(bool has_shape) const;
  Result<void> no_overlap(const CollisionShape& shape, const BodyDefinition& body, BodyId id,
                          std::string_view argument) const;
  bool is_foreign(BodyId body) const;
  // Precondition: the body is known.
  Result<void> is_enabled(BodyId body, bool enabled) const;
  Result<void> is_moving(BodyId body) const;
  Error error_about(ErrorCode code, BodyId body, std::string_view what) const;

  const World& world_;
  const Engine* engine_;
  std::string_view call_;
};

}  // namespace kinesphere
