// Simulation: a world with the motions of its bodies. It is moved and cloned as one value, for rollback.
//
//   Simulation game(World::create({.contact_tolerance = 1e-3}).value());
//   const auto players = game.add_motion(SteeredMotion::create(...).value());
//   const std::vector<BodyId> ids = game.add_all(players, {.radius = 0.5}).value();
//   std::deque<Simulation> past;  // one for each of the last frames
//   ...
//   past.push_back(game.clone().value());
//   for (const Event& event : game.events(frame_time)) game.set_velocity(event.first, ...).value();
//   ...
//   game = std::move(past.front());  // back to the first of these frames; all ids are still valid
#pragma once

#include <concepts>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "kinesphere/body.hpp"
#include "kinesphere/body_map.hpp"
#include "kinesphere/event_range.hpp"
#include "kinesphere/motion/frame_motion.hpp"
#include "kinesphere/motion/motion.hpp"
#include "kinesphere/result.hpp"
#include "kinesphere/run.hpp"
#include "kinesphere/world.hpp"

namespace kinesphere {

/// A motion of a simulation, and its class. Clones of the simulation have the same ids.
template <class Kind = Motion>
struct MotionId {
  std::uint32_t index = 0;

  /// An id of a motion of any class.
  operator MotionId<Motion>() const requires(!std::same_as<Kind, Motion>) { return {index}; }
  friend bool operator==(MotionId, MotionId) = default;
};

/// A body of a motion of a simulation, by its number in the motion.
struct SimulatedBody {
  MotionId<> motion;
  std::uint32_t number;

  friend constexpr bool operator==(const SimulatedBody&, const SimulatedBody&) = default;
};

/// Owns a world, the motions of its bodies, and the map between the two. A BodyMap refers to motions that
/// the caller must keep in place; a Simulation can be moved, and a clone shares nothing with its original.
///
/// Errors. A call that takes a body returns unknown_body for one that no motion of this simulation moves,
/// and one that takes a motion out_of_range for an id that this simulation did not issue. A moved-from
/// simulation may only be assigned to and destroyed: every other call fails with moved_from. Calls that
/// return no Result throw BadResult instead.
///
/// Threads and moves: as for World. Lifetimes: references to the world stay valid until the simulation is
/// moved, assigned to or destroyed, and those to motions until it is assigned to or destroyed.
class Simulation {
 public:
  /// Takes a world, whose bodies so far no motion moves.
  explicit Simulation(World world);
  Simulation(Simulation&&) noexcept = default;
  Simulation& operator=(Simulation&&) noexcept = default;

  /// Returns an independent copy that continues as this simulation does: equal responses give equal events,
  /// to the last bit. All ids stay valid. The copy is not recorded. Errors: those of World::clone();
  /// unsupported if Motion::clone() of a user-defined motion does not return its own class. Cost: O(n).
  Result<Simulation> clone() const;

  /// Adds a motion; no body is added to the world yet.
  template <std::derived_from<Motion> Kind>
  MotionId<Kind> add_motion(Kind motion) {
    return {own(std::make_unique<Kind>(std::move(motion)))};
  }
  /// Returns a motion, for the calls of its class: SteeredMotion::steer() and so on.
  template <class Kind>
  Kind& motion(MotionId<Kind> id) {
    return const_cast<Kind&>(std::as_const(*this).motion(id));
  }
  template <class Kind>
  const Kind& motion(MotionId<Kind> id) const {
    const auto* const found = dynamic_cast<const Kind*>(&known_motion(id.index));
    if (found == nullptr) refuse_motion(id.index);
    return *found;
  }

  /// The world, for all calls that concern no motion: static bodies, filters, sensors, sleep, queries.
  World& world() { return world_; }
  const World& world() const { return world_; }

  // Bodies: as the functions of BodyMap with these names, with the same errors.

  Result<BodyId> add(MotionId<> motion, std::uint32_t number, const BodyDefinition& like = {});
  Result<std::vector<BodyId>> add_all(MotionId<> motion, const BodyDefinition& like = {});
  template <std::convertible_to<std::span<const double>> Radii>
  Result<std::vector<BodyId>> add_all(MotionId<> motion, const Radii& radii,
                                      const BodyDefinition& like = {}) {
    return add_with_radii(motion, radii, like);
  }
  Result<void> set_velocity(BodyId body, const Vec3& velocity);
  Result<void> teleport(BodyId body, const State& state);
  Result<void> remove(BodyId body);
  Result<void> push(MotionId<FrameMotion> frames, std::span<const Vec3> positions,
                    std::optional<double> time = {});
  State state(BodyId body, double time) const;

  /// Returns the motion of a body and its number there, or nothing if no motion moves it.
  std::optional<SimulatedBody> find(BodyId body) const;
  /// Returns the body of the world that has this number in the motion, or nothing if there is none.
  std::optional<BodyId> body_of(MotionId<> motion, std::uint32_t number) const;

  // Time: as the functions of World with these names, where each body moves as its motion does.

  Result<std::optional<Event>> advance(double until);
  [[nodiscard]] EventRange events(double until) &;
  EventRange events(double until) && = delete;
  /// A body that a response removes leaves its motion, too, before the sink receives the event.
  Result<void> run(double until, const ResponseFn& respond, const EventFn& sink, Workers* workers = nullptr);
  /// Returns a probe for the predictions and queries of the world. It stays valid until the simulation is
  /// assigned to or destroyed.
  auto probe() const& { return known_bodies("probe").probe(); }
  void probe() const&& = delete;

 private:
  Result<std::vector<BodyId>> add_with_radii(MotionId<> motion, std::span<const double> radii,
                                             const BodyDefinition& like);
  std::uint32_t own(std::unique_ptr<Motion> motion);
  const Motion& known_motion(std::uint32_t index) const;
  [[noreturn]] void refuse_motion(std::uint32_t index) const;
  /// Return the error of a moved-from simulation, and of a motion that this simulation does not have.
  std::optional<Error> moved_from(std::string_view call) const;
  std::optional<Error> wrong_motion(std::string_view call, MotionId<> motion) const;
  const BodyMap& known_bodies(std::string_view call) const;
  void remember(MotionId<> motion, std::span<const BodyId> bodies);

  World world_;
  std::vector<std::unique_ptr<Motion>> motions_;  ///< by MotionId::index
  std::unique_ptr<BodyMap> bodies_;               ///< refers to motions_; null after a move
  /// Bodies of the world by MotionId::index and number; no_body for numbers that are not in the world.
  std::vector<std::vector<BodyId>> ids_;
};

}  // namespace kinesphere
