// Certified predictions: what cannot happen before a time, whatever the bodies do within their motion limits.
//
//   SafeTime quiet = world.certificates().safe_until(ball).value();
//   // the ball begins to touch nothing before quiet.time
//   EarliestApproach near = world.certificates(probe).earliest_approach(drone, 50.0).value();
//   // nothing comes within 50 of the drone before near.time, and near.partner may be the first that does
//
// A certificate holds while bodies keep their motion limits and the caller changes nothing: setting a
// velocity or adding a body invalidates it. It follows from the reports and certificates that the world
// already has, so it is a lower bound of the true time. World::certificates(probe) first probes the bodies
// that limit the result, which is then as late as fresh reports allow. The world handles these reports like
// all others: it checks them, reports a violated bound as bound_violation at the next advance(), and later
// events may move within their tolerances.
//
// On periodic axes all images count, and the distance of two bodies is that of their nearest images. Two
// bodies that move relative to each other are then certified at most until they may have approached by two
// boxes. Where images slide (WorldDefinition::shear_rate) there are no certificates: unsupported.
#pragma once

#include <utility>

#include "kinesphere/event.hpp"
#include "kinesphere/world.hpp"

namespace kinesphere {

/// No contact begins before `time`.
struct SafeTime {
  /// In [World::time(), +infinity]: no contact_begin or wall_begin comes before it, so no gap falls below
  /// minus the contact tolerance. It is World::time() if a contact exists or may be within about the
  /// tolerance.
  double time;
  /// True if events have reported a contact that still exists; `time` is then World::time().
  bool touching;
  /// True if the call probed.
  bool probed;

  friend constexpr bool operator==(const SafeTime&, const SafeTime&) = default;
};

/// The first contact that a body may have.
struct EarliestContact {
  /// As SafeTime::time; +infinity if no contact is possible.
  double time;
  /// Partner of that contact or, if it is no_body, the wall; no_body and Wall::none if `time` is infinite.
  BodyId partner;
  Wall wall;
  /// True if that contact already exists.
  bool touching;
  bool probed;

  friend constexpr bool operator==(const EarliestContact&, const EarliestContact&) = default;
};

/// The first time at which a body or wall may be within a distance of a body, from surface to surface.
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

  friend constexpr bool operator==(const EarliestApproach&, const EarliestApproach&) = default;
};

/// Two surfaces are not within a distance of each other before `time`.
struct SafeSeparation {
  /// As EarliestApproach::time.
  double time;
  bool within;  ///< as EarliestApproach::within
  bool probed;

  friend constexpr bool operator==(const SafeSeparation&, const SafeSeparation&) = default;
};

/// The distance between the true surfaces (length; negative when they overlap) lies in [lower, upper].
/// Infinite limits mean that nothing is known.
struct DistanceLimits {
  double lower;
  double upper;
  bool probed;

  friend constexpr bool operator==(const DistanceLimits&, const DistanceLimits&) = default;
};

/// What World::certificates() returns: certified predictions of one world, with or without a probe. Each call
/// answers for the present state of the world. Copies cost little. The world must outlive it and keep its
/// address; so must a named probe (callback.hpp), whereas a temporary one is owned.
///
/// Errors of all calls: those of a call that names a body; probe_in_progress; with a probe null_probe, and
/// not_finite or out_of_range for an invalid state, which is discarded.
class [[nodiscard]] World::Certificates {
 public:
  /// Returns a time before which the two bodies do not begin to touch. Errors: out_of_range for the same
  /// body twice. Cost: O(certificates of the world); with a probe, at most two states.
  Result<SafeTime> safe_until(BodyId first, BodyId second) const;
  /// Returns a time before which the body begins to touch no other body and no wall. Cost: O(n), for most
  /// bodies a single comparison; with a probe, as much again for each state that limits the result.
  Result<SafeTime> safe_until(BodyId body) const;
  /// Returns a time before which no contact begins in this world. Cost: O(n) in a dense scene; O(n^2) if
  /// the first contact is far in the future. With a probe, as much again, at most 32 times.
  Result<SafeTime> safe_until() const;
  /// Returns a time before which the surfaces of the two bodies do not come within `distance` (length >= 0,
  /// at most limits::largest_query_length) of each other. The result depends on positions alone: filters
  /// and `solid` are ignored. For two static bodies that are not both balls nothing is known, and the
  /// result is the current time. Errors: as safe_until(first, second); not_finite or out_of_range for
  /// `distance`. Cost: O(1); with a probe, at most two states.
  Result<SafeSeparation> safe_until(BodyId first, BodyId second, double distance) const;
  /// Returns the result of safe_until(body) together with the partner or wall that may come first. Errors
  /// and cost: as safe_until(body).
  Result<EarliestContact> earliest_contact(BodyId body) const;
  /// Returns a time before which no partner of the body comes within `distance` of it, and the partner that
  /// may be the first. Partners are the walls and all bodies that the filters and the pair filter let the
  /// body meet, including bodies that are not solid. Two static bodies do not meet. Errors: as
  /// safe_until(body); not_finite or out_of_range for `distance`. Cost: O(n); with a probe, as much again
  /// for each state that limits the result.
  Result<EarliestApproach> earliest_approach(BodyId body, double distance) const;
  /// Returns lower and upper limits of the distance between the two bodies at `time` >= World::time(). For
  /// two static bodies that are not both balls nothing is known. Errors: as safe_until(first, second);
  /// not_finite or time_backwards for `time`. Cost: O(1); with a probe, at most two states.
  Result<DistanceLimits> distance_limits(BodyId first, BodyId second, double time) const;

  /// World::certificates() makes it.
  explicit Certificates(Facet facet) : facet_(std::move(facet)) {}

 private:
  template <class Answer, class Ask>
  Result<Answer> answer(std::string_view call, const Result<void>& valid, std::size_t max_rounds,
                        Ask ask) const;

  Facet facet_;
};

inline World::Certificates World::certificates() const& { return Certificates({this}); }
inline World::Certificates World::certificates(Probe probe) & {
  return Certificates({this, this, std::move(probe)});
}

}  // namespace kinesphere
