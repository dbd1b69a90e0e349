// Time to collision: how long until two bodies touch if both go straight on as they do now.
#pragma once

#include <vector>

#include "kinesphere/motion/motion.hpp"
#include "simulation/tracks/approaches.hpp"

namespace kinesphere {

/// Returns the time after which two spheres touch whose centres are `way` apart and move by `velocity`
/// relative to each other; 0 if they touch, infinity if they never do. Lengths, and lengths / time.
double time_to_collision(const Vec3& way, const Vec3& velocity, double radii);

struct LeastTimeToCollision {
  double at = 0.0;       ///< when it is least
  double seconds = 0.0;  ///< infinity if the two are never on a course of collision
};

/// Returns the least time to collision during an approach whose closest point is known, to within a
/// millionth; `radii` by track. Bernstein coefficients of the squared distance, the speed of approach and the
/// discriminant bound it from below on each part of the two curves; a part that can hold less than is known
/// is divided, down to 2^-30 of a piece. Cost: up to some thousand polynomials for each piece with a minimum
/// inside, a few for others.
LeastTimeToCollision least_time_to_collision(const Motion& motion, const Approach& approach,
                                             const std::vector<double>& radii);

}  // namespace kinesphere
