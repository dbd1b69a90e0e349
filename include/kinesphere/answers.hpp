// What the world certifies about the future: World::safe_until, earliest_contact, earliest_approach and
// distance_limits.
//
//   SafeTime quiet = world.safe_until(ball).value();
//   // whatever the bodies do within their promises, the ball touches nothing before quiet.time
//   EarliestApproach near = world.earliest_approach(drone, 50.0).value();
//   // nothing comes within 50 of the drone before near.time, and near.partner may be the first that does
//
// An answer holds as long as bodies keep their promises and the caller changes nothing: a velocity that is
// set or a new body voids it. It follows from what the world knows already, reports and recorded facts, and
// so it is a lower bound of the truth. The calls that take a Probe ask for the states that limit the answer
// first: it is then as late as fresh reports allow. Those states are reports like any other. They are
// checked, a broken promise comes as a bound_violation event of the next advance(), and later events may move
// within their tolerances.
//
// Where space repeats, all images count, and the distance of two bodies is that of their nearest images. Two
// that move relative to each other are then certified at most until they may have come two boxes nearer.
#pragma once

#include "kinesphere/event.hpp"

namespace kinesphere {

/// No contact begins before `time`.
struct SafeTime {
  /// In [now, +infinity]: no contact_begin or wall_begin comes before it, so no gap falls below minus the
  /// contact tolerance. Now, where something touches already or may be within about the tolerance.
  double time;
  /// Something touches now, as events have told: `time` is now.
  bool touching;
  /// The probe was asked for this answer.
  bool probed;
};

/// The first contact that a body may come to.
struct EarliestContact {
  /// As SafeTime::time; +infinity when there can be none.
  double time;
  /// With whom or, if it is no_body, with which wall. Both are none when `time` is infinite.
  BodyId partner;
  Wall wall;
  /// It is a contact that lasts now.
  bool touching;
  bool probed;
};

/// The first time at which something may be within a distance of a body, from surface to surface.
struct EarliestApproach {
  /// In [now, +infinity]: the distance is not reached before it. Now, where it may be reached already.
  double time;
  /// By whom or, if it is no_body, by which wall. Both are none when `time` is infinite.
  BodyId partner;
  Wall wall;
  /// It certainly is within the distance now. When `time` is now and this is false, the reports leave it
  /// open.
  bool within;
  bool probed;
};

/// No two surfaces are within the distance that was asked for before `time`.
struct SafeSeparation {
  /// As EarliestApproach::time.
  double time;
  bool within;  ///< as EarliestApproach::within
  bool probed;
};

/// The distance between the true surfaces (length; negative when they overlap) lies in [lower, upper].
/// Infinite limits say that nothing is known.
struct DistanceLimits {
  double lower;
  double upper;
  bool probed;
};

}  // namespace kinesphere
