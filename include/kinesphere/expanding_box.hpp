// ExpandingBox: a periodic box that grows or shrinks with time, for balls in exact flight.
//
// Seen from the box, whose edges then stay as they are, such balls fly straight as well, if the clock is
// chosen for it, and their radii change at constant rates. A World knows such balls, so it needs nothing
// else: the caller adds the balls as the box sees them, and converts what the world tells
// (examples/compression.cpp).
//
// Two touch in the box if and only if they touch in the world, in the same order, and bounce() in the world
// is a bounce in the box of the same restitution. The coordinates are those of cosmology, called comoving.
#pragma once

#include <cstdint>

#include "kinesphere/body.hpp"
#include "kinesphere/event.hpp"
#include "kinesphere/result.hpp"

namespace kinesphere {

/// A box whose edges are scale(t) times as long as at the start, and the balls in it. "Real" are time, places
/// and velocities in this box, from the origin, which stays where it is. "Seen" is what the box sees, or a
/// world whose box has the edges of the start: places are divided by the scale, and the clock stands at 0 at
/// the start.
class ExpandingBox {
 public:
  /// How balls move between their contacts, while the box that they are in changes.
  enum class Flow : std::uint8_t {
    /// They keep their velocities, and know nothing of the box: scale(t) = 1 + rate t, as by pistons on all
    /// sides. An image that lies a period L away moves at rate L. A gas cools as it expands.
    free,
    /// They are carried along: a ball at x moves at rate x + v, where its velocity v against the flow (called
    /// peculiar) stays as it is; scale(t) = exp(rate t), a strain at a constant rate. States have v.
    carried,
  };
  /// How a box changes.
  struct Definition {
    /// Rate of the scale at the start (1 / time); negative for a box that shrinks.
    double rate = 0.0;
    Flow flow = Flow::free;
    /// Real time of the start, when the scale is 1.
    double start_time = 0.0;
  };
  /// Errors: not_finite for a number of the definition.
  static Result<ExpandingBox> create(const Definition& definition);

  /// Returns what create() was given.
  const Definition& definition() const { return of_; }

  /// Returns how many times as long as at the start an edge is at this real time; at most 0 from the time on
  /// at which a box in free flow that shrinks has no size any more.
  double scale(double time) const;
  /// Returns the same at a time of the clock.
  double scale_at(double clock) const { return 1.0 / (1.0 - of_.rate * clock); }

  /// Returns the clock at a real time. +infinity from the time on at which a box that shrinks has no size,
  /// and -infinity until the time at which one that grows has none.
  double clock(double time) const;
  /// Returns the real time at a time of the clock; +infinity if the clock never comes so far, as that of a
  /// box that grows, which ends at 1 / rate.
  double time(double clock) const;

  /// Returns the rate at which a ball of this real radius grows in the world, for its BodyDefinition (length
  /// / time of the clock). Its radius there is the same at the start; of one that is added at another time it
  /// is radius / scale(time), with the same rate.
  double growth_rate(double radius) const { return -of_.rate * radius; }

  /// Returns a real state at a real time as the box sees it.
  State seen(const State& real, double time) const;
  /// Returns the real state of one that is seen so when the clock stands there.
  State real(const State& seen, double clock) const;
  /// Returns an event of the world as one of the box: time, states, lengths and speeds.
  Event real(Event event) const;

 private:
  explicit ExpandingBox(const Definition& definition) : of_(definition) {}

  Definition of_;
};

}  // namespace kinesphere
