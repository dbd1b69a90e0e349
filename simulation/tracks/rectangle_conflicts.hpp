// How near to a collision two rectangles came: time to collision, braking that avoids it, and the time
// between them in one place.
#pragma once

#include <vector>

#include "simulation/tracks/post_encroachment.hpp"
#include "simulation/tracks/rectangle_approaches.hpp"
#include "simulation/tracks/time_to_collision.hpp"

namespace kinesphere {

/// Collisions that straight motion would bring.
struct CollisionCourse {
  LeastTimeToCollision least;  ///< as for spheres, of the bodies as they are turned at that time
  /// The largest deceleration (length / time^2) of one relative to the other, along their relative velocity,
  /// that just avoids the collision: their relative speed over twice the time to collision. 0 if they are
  /// never on a course of collision, infinity if they touch while they move.
  double at = 0.0, deceleration = 0.0;
};

/// Returns what is worst during an approach whose closest point is known. It is looked for at times between
/// which the distance changes by a tenth of the smaller body at most, and from the worst of these on to
/// within rounding: a course of collision that comes and goes between two of them is not found.
CollisionCourse collision_course(const Motion& motion, const Approach& approach,
                                 const std::vector<RectangleBody>& bodies);

/// Returns the least post-encroachment time of all places that both take during an approach, coming in
/// directions at least 30 degrees apart: one that follows another in its lane enters no place of a conflict.
/// It is 0 for two that touch, and as exact as 2^-20 of the approach's duration. Branch and bound over the
/// times of both, least difference first, with bounds on the speed of their points.
PostEncroachment post_encroachment(const Motion& motion, const Approach& approach,
                                   const std::vector<RectangleBody>& bodies);

}  // namespace kinesphere
