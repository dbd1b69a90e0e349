// WorldEditor applies changes by the caller: bodies are added and removed, and change their position, shape,
// motion limits or filter.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "kinesphere/shape.hpp"
#include "kinesphere/world.hpp"
#include "processor/event_processor.hpp"
#include "processor/sleeping.hpp"
#include "processor/world_state.hpp"

namespace kinesphere {

/// Not thread-safe; must not be used during advance(). Precondition: the arguments have been validated
/// (world/preconditions.hpp).
class World::WorldEditor {
 public:
  WorldEditor(WorldState& state, EventProcessor& main) : state_(state), main_(main) {}

  void reserve(std::size_t bodies);
  BodyId add(const BodyDefinition& definition);
  BodyId add_static(const StaticDefinition& definition);
  BodyId add_moving_shape(const MovingShape& definition);
  BodyId add_rigid_body(const RigidBody& definition);
  void set_angular_velocity(BodyId id, const Vec3& angular_velocity);
  void set_rotation(BodyId id, const Rotation& rotation);
  void set_rotation_probe(RotationProbe probe) { state_.bodies.rigid.probe = std::move(probe); }
  void remove(BodyId id);
  void set_velocity(BodyId id, const Vec3& velocity) { main_.set_velocity(id.index, velocity); }
  void set_velocities(BodyIds ids, std::span<const Vec3> velocities, PoolLease& lease) {
    main_.set_velocities(ids, velocities, lease);
  }
  void teleport(BodyId id, const State& state);
  void set_radius(BodyId id, double radius);
  void set_radius_rate(BodyId id, double rate);
  void set_motion_limits(BodyId id, const MotionLimits& limits);
  void disable(BodyId id);
  void enable(BodyId id, const State& state);
  void sleep(BodyId id) { sleeping().sleep(id.index); }
  void wake_up(BodyId id) {
    if (bodies()[id.index].is_sleeping()) sleeping().wake(id.index);
  }
  void set_filter(BodyId id, const Filter& filter);
  void set_pair_filter(PairFilter filter);
  void refresh_filter(BodyId id);
  void set_solid(BodyId id, bool solid);
  void set_sensor(SensorClass sensor_class, const Sensor& sensor);
  void set_sensor_class(BodyId id, SensorClass sensor_class);
  /// `shape` is in normal form (normalized()).
  void set_shape(BodyId id, const Shape& shape);
  void set_mass(BodyId id, double mass) { state_.bodies.masses.keep(id.index, mass); }
  void set_user_data(BodyId id, std::uint64_t data) { state_.bodies[id.index].user_data = data; }
  void set_pair_state(BodyId first, BodyId second, std::int32_t state) {
    state_.contacts.pairs().set_state(first.index, second.index, state);
  }
  void turn_back(const Event& crossing) { main_.turn_back(crossing); }
  void schedule(const Timer& timer) { state_.timers.add(timer); }
  std::size_t unschedule(std::uint64_t user_data) { return state_.timers.remove(user_data); }

 private:
  const Bodies& bodies() const { return state_.bodies; }
  double time() const { return main_.time(); }
  Sleeping sleeping() { return {state_, main_}; }
  BodyId insert(const BodyDefinition& definition, auto give_form);
  void insert_at(std::uint32_t number, const Bound& bound);
  void register_anew(std::uint32_t number);
  void register_with_new_extent(std::uint32_t number);
  void note_common_reach(double reach);
  void set_common_reach(double reach);
  void replace(std::uint32_t number, const Bound& bound);
  void end_contacts_outside(std::uint32_t number, const CollisionShape& replacement);
  void end_contacts(std::uint32_t number, const std::function<bool(const Event&)>& ends);
  bool may_hold(const Event& event) const;

  WorldState& state_;
  EventProcessor& main_;
};

}  // namespace kinesphere
