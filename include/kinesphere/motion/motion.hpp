// How bodies really move: what a probe reads, and what no detector but the oracle may look into.
//
// Bodies are named by their number in the motion: 0, 1, 2, ... . In a world to which the bodies were added in
// the same order, and none removed, that is the index of their id, so `motion.probe()` can be handed to
// World::advance.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "kinesphere/body.hpp"
#include "kinesphere/motion/trajectory.hpp"

namespace kinesphere {

class Motion {
 public:
  virtual ~Motion() = default;

  virtual std::size_t size() const = 0;
  /// The body's promise (limit, plan, errors) and its state at time t; the radius is left at its default.
  virtual BodyDefinition definition(std::uint32_t body, double t) const = 0;
  /// State at time t, which may not lie before the body's last kick (or its start). The answer does not
  /// depend on which times were asked for before. It may be cached, so threads need clones of their own.
  virtual State state(std::uint32_t body, double t) const = 0;
  /// The exact motion during [begin, end], begin not before the last kick, as it will be if nobody kicks.
  /// The first segment begins at or before `begin`, the last one ends at `end`. Its states are those that
  /// state() gives, to the last bit.
  virtual Trajectory trajectory(std::uint32_t body, double begin, double end) const = 0;
  /// Gives the body a new velocity at time t. Returns false, and changes nothing, when t lies before its last
  /// kick, when a number is not finite, and for motions that cannot be changed (recordings).
  virtual bool set_velocity(std::uint32_t body, double t, const Vec3& velocity) = 0;
  /// An independent copy, kicks included.
  virtual std::unique_ptr<Motion> clone() const = 0;

  /// A callable for World::advance, for worlds whose id.index is the number in this motion.
  auto probe() const {
    return [this](std::span<const BodyId> ids, double time, std::span<State> states) {
      for (std::size_t k = 0; k < ids.size(); ++k) states[k] = state(ids[k].index, time);
    };
  }
};

}  // namespace kinesphere
