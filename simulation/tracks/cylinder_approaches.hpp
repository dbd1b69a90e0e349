// Approaches by a cylinder: when two bodies are within a horizontal and within a vertical distance at once.
#pragma once

#include <vector>

#include "kinesphere/motion/motion.hpp"
#include "simulation/tracks/approaches.hpp"

namespace kinesphere {

/// A separation with two limits (length, both > 0); z is vertical.
struct CylinderLimits {
  double horizontal, vertical;
  /// How far outside of `horizontal` an approach may reach (length, > 0); outside of `vertical` it may reach
  /// as much in proportion.
  double tolerance;
};

/// The search for candidates by spheres: stretched by a power of two along z, the cylinder is about as high
/// as wide, and a sphere encloses it closely.
struct CylinderEnclosure {
  double stretch;   ///< factor of z, exact in binary
  double distance;  ///< radius of the sphere in stretched space; at most sqrt(3) times the horizontal limit
};
CylinderEnclosure enclosure_of(const CylinderLimits& limits);

/// Returns the approaches within the cylinder, sorted by begin. `enclosing` are approaches of spheres that
/// contain all of them. At every time at which both distances are within the limits an approach holds, and
/// while one holds, neither is outside by more than the tolerance. Each distance is followed along the exact
/// curves (GapCourse), and an approach is where both are within. Cost: proportional to the pieces of the
/// curves during the enclosing approaches.
std::vector<Approach> approaches_within(const CylinderLimits& limits, const Motion& motion,
                                        const std::vector<Approach>& enclosing);

}  // namespace kinesphere
