// GameBodies: the bodies of a GameWorld in arrays without gaps, and their free flight.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "kinesphere/result.hpp"
#include "kinesphere/run.hpp"
#include "kinesphere/world_definition.hpp"

namespace kinesphere {

/// Whether a body flies, or stands still where it is.
enum class GameMotion : std::uint8_t { flying, asleep, disabled };

/// Dense arrays of bodies: place k of each is that of ids()[k].
class GameBodies final : public MotionSource {
 public:
  /// Without bodies; to be read, for those of a saved game. `world` says which axes are periodic.
  GameBodies() = default;
  GameBodies(const WorldDefinition& world, const Vec3& gravity);
  static void serialize(auto& self, auto& archive) {
    archive(self.gravity_, self.ids_, self.origins_, self.own_, self.motions_);
  }
  /// Returns the error of a body that can move and is none of these.
  static Error not_moved(BodyId body);
  /// Completes what was read. Returns false for a body that is listed twice, and for numbers that are not
  /// finite or later than `time`.
  bool complete(const WorldDefinition& world, double time);

  const Vec3& gravity() const { return gravity_; }
  const std::vector<BodyId>& ids() const { return ids_; }
  /// Returns the acceleration beside the gravity.
  const Vec3& own_acceleration(std::size_t place) const { return own_[place]; }
  GameMotion motion(std::size_t place) const { return motions_[place]; }
  std::optional<std::size_t> find(BodyId body) const;

  /// Returns the state at a time that is not before the last change. Cost: O(1).
  State flight(std::size_t place, double time) const {
    const auto& [since, start] = origins_[place];
    const double s = time - since;
    const Vec3& acceleration = accelerations_[place];
    // As Segment::state_at() computes it.
    return {start.position + s * (start.velocity + s * (0.5 * acceleration)),
            start.velocity + s * acceleration};
  }
  /// Returns the state with the image of its position that lies in the box of a periodic world.
  State state(std::size_t place, double time) const {
    const State now = flight(place, time);
    return periodic_.any() ? State{wrapped(now.position), now.velocity} : now;
  }
  /// Of all bodies, as state(). Cost: O(n) for another time than that of the last call.
  const std::vector<Vec3>& positions(double time) const { return refreshed(time), positions_; }
  const std::vector<Vec3>& velocities(double time) const { return refreshed(time), velocities_; }

  // Changes at a time that is not before the last change of the body.

  void add(BodyId body, double time, const State& state, const Vec3& acceleration);
  /// Moves the last body to the place of this one.
  void remove(std::size_t place);
  void restart(std::size_t place, double time, const State& state);
  void set_velocity(std::size_t place, double time, const Vec3& velocity) {
    const bool known = told_at_ == time && !periodic_.any();
    origins_[place] = {time, {known ? positions_[place] : flight(place, time).position, velocity}};
    velocities_[place] = velocity;
    if (motions_[place] != GameMotion::flying) fly(place);
  }
  /// Lets a body stand still; restart() lets it fly again.
  void halt(std::size_t place, double time, GameMotion motion);
  void set_acceleration(std::size_t place, double time, const Vec3& acceleration);
  void set_gravity(double time, const Vec3& gravity);

  // The motion source of World::run(). All throw BadResult: unknown_body.

  void states(std::span<const BodyId> ids, double time, std::span<State> states) override;
  MotionOrigin origin(BodyId body) const override;
  void set_origin(BodyId body, const MotionOrigin& origin) override;

 private:
  static constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();

  std::size_t known(BodyId body) const {
    if (body.index >= places_.size() || places_[body.index] == nowhere) [[unlikely]]
      refuse(body);
    return places_[body.index];
  }
  [[noreturn, gnu::cold]] static void refuse(BodyId body);
  void refreshed(double time) const;
  void fly(std::size_t place) {
    motions_[place] = GameMotion::flying;
    accelerations_[place] = gravity_ + own_[place];
  }
  /// Returns the image of a position in the box.
  Vec3 wrapped(Vec3 position) const;
  void give_place(BodyId body, std::size_t place);
  void tell(std::size_t place, double time) const;

  Vec3 gravity_{};
  Axes periodic_{};
  Box box_{};
  std::vector<BodyId> ids_;
  std::vector<MotionOrigin> origins_;
  std::vector<Vec3> accelerations_;  ///< with the gravity; zero for what stands still
  std::vector<Vec3> own_;
  std::vector<GameMotion> motions_;
  std::vector<std::uint32_t> places_;  ///< by BodyId::index
  mutable std::vector<Vec3> positions_, velocities_;
  /// Time of positions_ and velocities_; NaN if they are to be computed.
  mutable double told_at_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace kinesphere
