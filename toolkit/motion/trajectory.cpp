// Segment: evaluation of cubic pieces of motion.
#include "kinesphere/motion/trajectory.hpp"

namespace kinesphere {

State Segment::state_at(double t) const {
  const double s = t - begin;
  return {.position = position + s * (velocity + s * (0.5 * acceleration + s * (jerk / 6.0))),
          .velocity = velocity + s * (acceleration + s * (0.5 * jerk))};
}

}  // namespace kinesphere
