// BodyMap: relates the bodies of a world to the bodies of one or several motions.
//
//   BodyMap bodies;
//   std::vector<BodyId> balls = bodies.add_all(world, frames, {.radius = 0.2}).value();
//   ...
//   // a bullet that flies by itself
//   std::uint32_t number = flight.add(world.time(), muzzle).value();       // Ballistic flight
//   BodyId bullet = bodies.add(world, flight, number, {.radius = 0.01}).value();
//   ...
//   while (auto event = world.advance(frames.latest_time(), bodies.probe()).value()) {
//     if (event->second == bullet) bodies.remove(world, bullet).value();
//     ...
//   }
#pragma once

#include <concepts>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "kinesphere/body.hpp"
#include "kinesphere/motion/frame_motion.hpp"
#include "kinesphere/motion/motion.hpp"
#include "kinesphere/result.hpp"
#include "kinesphere/run.hpp"
#include "kinesphere/world.hpp"

namespace kinesphere {

/// A body of a motion, by its number there.
struct MovedBody {
  Motion* motion;
  std::uint32_t number;

  friend constexpr bool operator==(const MovedBody&, const MovedBody&) = default;
};

/// Lifetimes: a motion must keep its address while the map refers to its bodies. A map cannot be moved or
/// copied, and neither can a struct that holds it beside its motions: the references would dangle. A
/// Simulation (simulation.hpp) owns world, motions and map, and can be moved and cloned. Errors: a call that
/// returns an error has changed neither the motion nor the world. One map serves one world, and clones of it,
/// because clones keep the ids: a body of another world takes the place of the one with its index, which the
/// map then no longer knows.
class BodyMap {
 public:
  BodyMap() = default;
  BodyMap(const BodyMap&) = delete;
  BodyMap& operator=(const BodyMap&) = delete;

  /// Adds a body of a motion to the world. State and motion limits come from the motion, at world.time();
  /// everything else (radius, filter, solid, sensor class, user data, mass) comes from `like`. Errors:
  /// unknown_body or stale_body, and those of World::add(). Throws BadResult as Motion::definition() for a
  /// time at which the motion does not know the body.
  Result<BodyId> add(World& world, Motion& motion, std::uint32_t number, const BodyDefinition& like = {});
  /// Adds all bodies of the motion in the order of their numbers or, on an error, none. Errors: as add().
  Result<std::vector<BodyId>> add_all(World& world, Motion& motion, const BodyDefinition& like = {});
  /// Adds all bodies of the motion with individual radii (length), a span or a container. Errors: as add();
  /// out_of_range if the number of radii differs from the number of bodies.
  template <std::convertible_to<std::span<const double>> Radii>
  Result<std::vector<BodyId>> add_all(World& world, Motion& motion, const Radii& radii,
                                      const BodyDefinition& like = {}) {
    return add_with_radii(world, motion, radii, like);
  }

  /// Adds a body of a motion that carries a shape. Of `like`, state and motion limits come from the motion.
  /// Errors: unknown_body or stale_body, and those of World::add_moving_shape(). Throws as add().
  Result<BodyId> add_moving_shape(World& world, Motion& motion, std::uint32_t number, MovingShape like);

  /// Adds a body of a motion as the position of a rigid body. Of `like.body`, state and motion limits come
  /// from the motion, and so does `like.rotation` if the motion knows how its bodies turn
  /// (Motion::rotation()). Errors: unknown_body or stale_body, and those of World::add_rigid_body();
  /// unsupported for moments of inertia other than 0 where the motion turns the body, as a contact would turn
  /// it otherwise. Throws as add().
  Result<BodyId> add_rigid_body(World& world, Motion& motion, std::uint32_t number, RigidBody like);

  /// Notes that a motion moves a body of a world, as add() does: for a world and motions that were restored
  /// from bytes. Errors: unknown_body or stale_body if the motion has no such body; unknown_body for no_body.
  Result<void> connect(BodyId body, Motion& motion, std::uint32_t number);
  /// Returns the bodies that this map knows, by rising index. Cost: O(n).
  std::vector<BodyId> bodies() const;

  // Changes at world.time() of a body in the world and in its motion. Errors of all: unknown_body for a
  // body that this map does not know, and those of the functions of equal name of Motion and World.

  Result<void> set_velocity(World& world, BodyId body, const Vec3& velocity);
  Result<void> teleport(World& world, BodyId body, const State& state);
  /// Removes the body. A motion that does not support removal keeps it, but is no longer queried for it. A
  /// body that the world has removed already, as by a response of World::run(), is removed from the rest.
  Result<void> remove(World& world, BodyId body);
  /// For the sink of World::run(): removes from map and motions those bodies of the event that its response
  /// has removed from the world. Numbers in the motions become free in the order of events. Calls `respond`
  /// only if a body of the event has gone.
  Result<void> remove_gone(World& world, const Event& event, const ResponseFn& respond);

  /// Appends the next frame to the frames (FrameMotion::push) and informs the world of the new velocities,
  /// so that no contact is missed. `time` is that of the frame; without it, the frame comes frames.interval()
  /// after the one before. Needs world.time() == frames.latest_time(). Errors, which leave frames and world
  /// unchanged: as FrameMotion::push(); unknown_body for a body with a new velocity that was not added to the
  /// world through this map. Cost: O(n).
  Result<void> push(World& world, FrameMotion& frames, std::span<const Vec3> positions,
                    std::optional<double> time = {}) const;
  /// Appends the next frame, with the orientations of the bodies, and informs the world of the new angular
  /// velocities of rigid bodies, too. Errors: as above.
  Result<void> push(World& world, FrameMotion& frames, std::span<const Vec3> positions,
                    std::span<const Quaternion> rotations, std::optional<double> time = {}) const;

  /// Returns the motion and the number of the body, or nothing if this map does not know it.
  std::optional<MovedBody> find(BodyId body) const;
  /// Returns the state that the body's motion gives. Throws BadResult: unknown_body, and as
  /// Motion::state().
  State state(BodyId body, double time) const;
  /// Returns the rotation that the body's motion gives. Throws BadResult: as state(); unsupported if the
  /// motion does not know how its bodies turn.
  Rotation rotation(BodyId body, double time) const;

  /// Returns a map of the same bodies, in which the motion to[k] stands for from[k]: for clones of a world
  /// and of its motions. Errors: out_of_range for another number of motions in `to`, and if `from` lacks a
  /// motion of this map. Cost: O(n).
  Result<std::unique_ptr<BodyMap>> with_motions(std::span<Motion* const> from,
                                                std::span<Motion* const> to) const;

  /// Returns a callable for World::advance() and all other calls that take a probe; it queries each body's
  /// motion. The callable throws as state(), and World::advance() lets the exception pass. The map must
  /// outlive it.
  auto probe() const& {
    return [this](std::span<const BodyId> ids, double time, std::span<State> states) {
      for (std::size_t k = 0; k < ids.size(); ++k) states[k] = state(ids[k], time);
    };
  }
  void probe() const&& = delete;
  /// Returns a RotationProbe of all rigid bodies of this map, for World::set_rotation_probe(): needed where
  /// one of the world's rigid bodies has an angular acceleration limit. It throws as rotation(). The map must
  /// outlive it.
  auto rotation_probe() const& {
    return [this](std::span<const BodyId> ids, double time, std::span<Rotation> rotations) {
      for (std::size_t k = 0; k < ids.size(); ++k) rotations[k] = rotation(ids[k], time);
    };
  }
  void rotation_probe() const&& = delete;

  /// Motion source for World::run(). The map must outlive it. It throws BadResult: unknown_body, and as
  /// state(), origin() and set_origin() of the motions.
  class MapSource final : public MotionSource {
   public:
    /// BodyMap::source() makes one.
    explicit MapSource(const BodyMap& bodies) : bodies_(bodies) {}
    void states(std::span<const BodyId> ids, double time, std::span<State> states) override;
    MotionOrigin origin(BodyId body) const override;
    void set_origin(BodyId body, const MotionOrigin& origin) override;

   private:
    const BodyMap& bodies_;
  };
  MapSource source() const& { return MapSource(*this); }
  MapSource source() const&& = delete;

 private:
  struct Entry {
    Motion* motion = nullptr;  ///< null if no body of this index is known
    std::uint32_t number = 0;
    std::uint32_t generation = 0;
    std::uint32_t world = 0;  ///< BodyId::world; 0 for any
  };

  Result<std::vector<BodyId>> add_with_radii(World& world, Motion& motion, std::span<const double> radii,
                                             const BodyDefinition& like);
  /// Returns the entry of the body. Throws BadResult: unknown_body.
  const Entry& known(std::string_view call, BodyId body) const;
  void note(BodyId body, Motion& motion, std::uint32_t number);
  const Entry* entry(BodyId body) const {
    if (body.index >= entries_.size()) return nullptr;
    const Entry& found = entries_[body.index];
    const bool is_same_world = found.world == body.world || found.world == 0 || body.world == 0;
    return found.motion != nullptr && found.generation == body.generation && is_same_world ? &found : nullptr;
  }

  std::vector<Entry> entries_;  ///< by BodyId::index
};

}  // namespace kinesphere
