// Certified predictions: the results of World::safe_until, earliest_contact, earliest_approach and
// distance_limits.
//
//   SafeTime quiet = world.safe_until(ball).value();
//   // whatever the bodies do within their motion limits, the ball touches nothing before quiet.time
//   EarliestApproach near = world.earliest_approach(drone, 50.0).value();
//   // nothing comes within 50 of the drone before near.time, and near.partner may be the first that does
//
// A prediction holds while bodies keep their motion limits and the caller changes nothing: setting a
// velocity or adding a body invalidates it. It follows from the reports and certificates that the world
// already has, so it is a lower bound of the true time. The overloads that take a Probe first probe the
// bodies that limit the result, which is then as late as fresh reports allow. The world handles these
// reports like all others: it checks them, reports a violated bound as bound_violation at the next
// advance(), and later events may move within their tolerances.
//
// On periodic axes all images count, and the distance of two bodies is that of their nearest images. Two
// bodies that move relative to each other are then certified at most until they may have approached by two
// boxes.
#pragma once

#include "kinesphere/event.hpp"

namespace kinesphere {

/// Result of World::safe_until(): no contact begins before `time`.
struct SafeTime {
  /// In [World::time(), +infinity]: no contact_begin or wall_begin comes before it, so no gap falls below
  /// minus the contact tolerance. It is World::time() if a contact exists or may be within about the
  /// tolerance.
  double time;
  /// True if events have reported a contact that still exists; `time` is then World::time().
  bool touching;
  /// True if the call probed.
  bool probed;
};

/// Result of World::earliest_contact(): the first contact that a body may have.
struct EarliestContact {
  /// As SafeTime::time; +infinity if no contact is possible.
  double time;
  /// Partner of that contact or, if it is no_body, the wall; no_body and Wall::none if `time` is infinite.
  BodyId partner;
  Wall wall;
  /// True if that contact already exists.
  bool touching;
  bool probed;
};

/// Result of World::earliest_approach(): the first time at which a body or wall may be within a distance of
/// a body, from surface to surface.
struct EarliestApproach {
  /// In [World::time(), +infinity]: the distance is not reached before it. It is World::time() if the
  /// distance may already be reached.
  double time;
  /// Partner that may come first or, if it is no_body, the wall; no_body and Wall::none if `time` is
  /// infinite.
  BodyId partner;
  Wall wall;
  /// True if the partner is certainly within the distance now. If it is false and `time` is World::time(),
  /// the reports leave this undecided.
  bool within;
  bool probed;
};

/// Result of World::safe_until() with a distance: the two surfaces are not within it before `time`.
struct SafeSeparation {
  /// As EarliestApproach::time.
  double time;
  bool within;  ///< as EarliestApproach::within
  bool probed;
};

/// Result of World::distance_limits(): the distance between the true surfaces (length; negative when they
/// overlap) lies in [lower, upper]. Infinite limits mean that nothing is known.
struct DistanceLimits {
  double lower;
  double upper;
  bool probed;
};

}  // namespace kinesphere
