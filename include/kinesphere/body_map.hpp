// A world whose bodies are moved by one motion or several: which body of the world is which body of which
// motion.
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

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "kinesphere/body.hpp"
#include "kinesphere/motion/frame_motion.hpp"
#include "kinesphere/motion/motion.hpp"
#include "kinesphere/result.hpp"
#include "kinesphere/world.hpp"

namespace kinesphere {

/// A body of a motion.
struct MovedBody {
  Motion* motion;
  std::uint32_t number;
};

/// Motions must stay where they are as long as the map knows bodies of theirs. A change goes to the motion
/// first, then to the world. On an error of the motion nothing has changed; on one of the world the motion
/// has. One map may serve clones of a world, as ids are the same in them.
class BodyMap {
 public:
  /// Adds a body of a motion to the world: state and promise come from the motion, at world.time(); all else
  /// (radius, filter, solid, sensor class, user data) from `like`. Errors: unknown_body or
  /// stale_body, and those of World::add(). Throws BadResult as Motion::definition() for a time at which the
  /// motion does not know the body.
  Result<BodyId> add(World& world, Motion& motion, std::uint32_t number, const BodyDefinition& like = {});
  /// All bodies of the motion, in the order of their numbers. Errors: as add(), and then none is added.
  Result<std::vector<BodyId>> add_all(World& world, Motion& motion, const BodyDefinition& like = {});
  /// The same with a radius for each. Also out_of_range: another number of radii than of bodies.
  Result<std::vector<BodyId>> add_all(World& world, Motion& motion, std::span<const double> radii,
                                      const BodyDefinition& like = {});

  // Changes at world.time(), of a body of the world and of the motion that moves it. Errors: unknown_body for
  // a body that this map does not know, and those of the functions of the same name of Motion and World.

  Result<void> set_velocity(World& world, BodyId body, const Vec3& velocity);
  Result<void> teleport(World& world, BodyId body, const State& state);
  /// A motion that cannot remove bodies keeps it; nobody asks about it any more.
  Result<void> remove(World& world, BodyId body);

  /// Tells the world the velocity of each body that broke its promise in the frame that was pushed last
  /// (Frames::violations), so that nothing is missed; to be called after each push, with
  /// world.time() == frames.previous_time(). Bodies that this map does not know are passed over. Errors:
  /// out_of_range for another time; as World::set_velocity(). Cost: O(n) when there are violations.
  Result<void> report_violations(World& world, const FrameMotion& frames) const;

  /// Which body of which motion that is; nothing for a body that this map does not know.
  std::optional<MovedBody> find(BodyId body) const;
  /// From its motion. Throws BadResult: unknown_body, and as Motion::state().
  State state(BodyId body, double time) const;

  /// A callable for World::advance and all calls that take a probe: it asks each body's motion. It throws as
  /// state(), which World::advance lets pass.
  auto probe() const {
    return [this](std::span<const BodyId> ids, double time, std::span<State> states) {
      for (std::size_t k = 0; k < ids.size(); ++k) states[k] = state(ids[k], time);
    };
  }

  /// For World::run; the map must outlive it. It throws BadResult: unknown_body, and as state(), departure()
  /// and depart() of the motions.
  class MapSource final : public MotionSource {
   public:
    explicit MapSource(const BodyMap& bodies) : bodies_(bodies) {}
    void states(std::span<const BodyId> ids, double time, std::span<State> states) override;
    MotionOrigin origin(BodyId body) const override;
    void set_origin(BodyId body, const MotionOrigin& origin) override;

   private:
    const BodyMap& bodies_;
  };
  MapSource source() const { return MapSource(*this); }

 private:
  struct Entry {
    Motion* motion = nullptr;  ///< none: no body of this index is known
    std::uint32_t number = 0;
    std::uint32_t generation = 0;
  };

  /// Throws BadResult: unknown_body.
  const Entry& known(std::string_view call, BodyId body) const;
  void connect(BodyId body, Motion& motion, std::uint32_t number);
  const Entry* entry(BodyId body) const {
    if (body.index >= entries_.size()) return nullptr;
    const Entry& found = entries_[body.index];
    return found.motion != nullptr && found.generation == body.generation ? &found : nullptr;
  }

  std::vector<Entry> entries_;  ///< by index in the world
};

}  // namespace kinesphere
