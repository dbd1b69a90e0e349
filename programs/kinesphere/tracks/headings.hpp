// Which way the bodies of a recording point.
#pragma once

#include <optional>
#include <string>

#include "formats/tables/table_columns.hpp"
#include "simulation/tracks/rectangles.hpp"
#include "tracks/cleaning.hpp"
#include "tracks/coordinates.hpp"
#include "tracks/raw_samples.hpp"

namespace kinesphere::program {

/// How the headings of a file count.
struct HeadingScale {
  bool is_of_motion = true;  ///< the file has none, or they are not used
  double unit = 1.0;         ///< radians of one unit of the numbers
  bool is_from_north = false;
  std::string text;  ///< for the summary

  /// Returns the heading counterclockwise from the x axis, in radians.
  double radians(double heading) const;
};

/// Returns how headings count: as the option or the preset says, clockwise from north where they are courses,
/// else as fits the motion of the bodies. Throws ProgramError naming the option where that does not show it.
HeadingScale heading_scale_of(const RawTrackSet& raw, const TrackOptions& options,
                              const Coordinates& coordinates);

/// Returns the rectangle of a body with these samples, which are moved to its middle where `place` says that
/// they are not there; `size` has its length, width and height. Without headings in the file it points where
/// it goes, and backs as it came; a body that moves less than half its width, and has none, is a disc around
/// the rectangle. A size of 0 gives a point.
RectangleBody rectangle_of(Piece& piece, const RectangleBody& size, const HeadingScale& scale,
                           TableColumns::Place place);

}  // namespace kinesphere::program
