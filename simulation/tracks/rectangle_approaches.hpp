// Approaches of rectangles: when two of them are close, and how close they come.
#pragma once

#include <vector>

#include "simulation/tracks/approaches.hpp"
#include "simulation/tracks/position_errors.hpp"
#include "simulation/tracks/rectangles.hpp"

namespace kinesphere {

/// Returns the approaches of the bodies (by track) within `distance`, sorted by begin. `enclosing` are those
/// of discs that cover them. While one holds, the two are not farther apart than the distance and half the
/// tolerance, and at all other times not nearer than the distance less half the tolerance; both are lengths
/// above 0. A bound on the speed of their points
/// decides about parts of time, which are divided until it does, or until that is the tolerance. With errors
/// an approach is where the two may be within the distance, and is certain if they are at some time of it
/// however they are off; `enclosing` has to hold all of that. Cost: up to some ten thousand distances for
/// each approach.
std::vector<Approach> approaches_of_rectangles(double distance, double tolerance, const Motion& motion,
                                               const std::vector<RectangleBody>& bodies,
                                               const std::vector<Approach>& enclosing,
                                               const PositionErrors& errors = {});

/// Sets `closest` of each approach. The distance is the least one to within `tolerance` (a length above 0).
void find_closest(const Motion& motion, std::vector<Approach>& approaches,
                  const std::vector<RectangleBody>& bodies, double tolerance);

/// Returns the local minima of the distance in each approach, by approach and time. They are looked for
/// between times at which the distance has changed by a tenth of the smaller body at most
/// (RectanglePair::parts_of()), and then to within rounding; one that comes and goes between two of these is
/// not found.
std::vector<DistanceMinimum> minima_in(const Motion& motion, const std::vector<Approach>& approaches,
                                       const std::vector<RectangleBody>& bodies);

/// Returns the distance of two bodies at a time.
double distance_at(const Motion& motion, const std::vector<RectangleBody>& bodies, std::uint32_t first,
                   std::uint32_t second, double time);

}  // namespace kinesphere
