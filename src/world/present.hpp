// What is known of a body at the current time, in every state in which a caller may ask.
#pragma once

#include "bound/rounding.hpp"
#include "world/engine.hpp"

namespace kinesphere {

/// A sphere around `centre` with radius `outer` contains the body, and the body contains the one with radius
/// `inner`, if that is not negative. Rounding is allowed for.
struct Place {
  Vec3 centre;
  double outer;
  double inner;
};

inline Place place_of(const Body& body, double now) {
  const Bound& bound = body.bound;
  const double s = now - bound.time;
  const double outer = bound.radius_at(now);
  const double size =
      norm_one(bound.position) + (norm_one(bound.velocity) + norm_one(bound.planned_acceleration) * s) * s;
  const double deviation = outer - body.definition.radius + rounding::margin * (size + outer);
  return {bound.centre_at(now), body.definition.radius + deviation, body.definition.radius - deviation};
}

/// Contains the body from now on. A kick changes the velocity: the bound of a report before it tells only
/// where the body is now.
inline Bound present_bound(const Body& body, double now) {
  if (!body.kicked_since_report) return body.bound;
  const Place place = place_of(body, now);
  Bound bound = bound_of(body.definition, {place.centre, body.definition.velocity}, now);
  bound.radius = place.outer;
  return bound;
}

}  // namespace kinesphere
