// How close counts as an approach: --distance or --separation.
#pragma once

#include <optional>
#include <string>

#include "tracks/reading_policy.hpp"
#include "tracks/track_set.hpp"

namespace kinesphere::program {

/// A sphere, or a cylinder if there is a vertical distance. Lengths are in metres or, without a unit, in the
/// unit of the track set's lengths.
struct Closeness {
  double distance;  ///< the horizontal one of a cylinder
  std::optional<double> vertical;
  bool has_unit;              ///< a length has a unit
  std::string option, given;  ///< the option and its text
  std::string text;           ///< for the summary
};

/// Parses the texts of --distance and --separation, of which one is empty. Throws ProgramError.
Closeness closeness_of(const std::string& distance_text, const std::string& separation_text);
/// Throws ProgramError if a length has a unit although that of the track set is unknown, and for a cylinder
/// without heights or with sizes.
void check_closeness(const Closeness& closeness, const TrackSet& track_set);
/// Returns how files are read: a cylinder needs vertical heights, so on the earth it stands on a plane.
/// Throws ProgramError if another projection is asked for.
TrackOptions reading_for(const Closeness& closeness, TrackOptions reading);

}  // namespace kinesphere::program
