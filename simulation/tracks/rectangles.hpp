// Bodies that are rectangles in the plane, or upright boxes, and turn as their tracks say.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "kinesphere/motion/motion.hpp"

namespace kinesphere {

/// A rectangle whose middle follows a track; or a sphere, as a disc where a heading is not known, or a point.
/// With a finite height it is an upright box, or an upright cylinder for a disc, around that middle.
struct RectangleBody {
  double length = 0.0, width = 0.0;  ///< along and across the heading; 0 for a sphere
  double radius = 0.0;               ///< of a sphere; 0 for a rectangle
  /// Upright, 0 for a plate. Infinite: z does not count beside a rectangle.
  double height = std::numeric_limits<double>::infinity();
  /// Times and headings, in radians counterclockwise from the x axis, each less than half a turn from the one
  /// before. Between two times the body turns steadily, and before the first and after the last not at all.
  std::vector<double> times, headings;

  /// Radius of a disc that covers the body, seen from above.
  double reach() const;
  /// Returns the heading at a time; 0 for a body without any.
  double heading_at(double t) const;
};

/// Where a body is, how it moves, and how it is turned.
struct RectanglePose {
  Vec3 position, velocity;
  double heading = 0.0;
};

/// Returns the distance of two bodies; where they overlap, less than 0: how far one has to be moved at least
/// until they only touch.
double gap_between(const RectangleBody& first, const RectanglePose& at, const RectangleBody& second,
                   const RectanglePose& other);

/// Returns the time after which the two touch if both go straight on and do not turn; 0 if they touch,
/// infinity if they never do.
double time_to_touch(const RectangleBody& first, const RectanglePose& at, const RectangleBody& second,
                     const RectanglePose& other);

/// A part of the way of one body on which it moves by one cubic and turns steadily.
struct RectanglePiece {
  double begin = 0.0, end = 0.0;
  Segment segment;
  double heading = 0.0, turn_rate = 0.0;  ///< at `begin`; radians / time

  RectanglePose pose(double t) const;
  /// Returns a bound on the speed of all points within `reach` of the middle, from `from` to `to`.
  double fastest(double reach, double from, double to) const;
};

/// Returns the pieces of a body from `begin` to `end`.
std::vector<RectanglePiece> pieces_of(const Motion& motion, std::uint32_t body, const RectangleBody& shape,
                                      double begin, double end);

}  // namespace kinesphere
