// Says what of a recording was not looked at.
#pragma once

#include <string>
#include <vector>

#include "scenes/summary.hpp"
#include "tracks/coverage.hpp"
#include "tracks/vanishings.hpp"

namespace kinesphere::program {

/// Adds rows for what was not looked at; none if there is nothing.
void add_coverage(Summary& summary, const Coverage& coverage, const TrackSet& track_set);
/// Adds a row if there are any.
void add_vanishings(Summary& summary, const std::vector<Vanishing>& vanishings, const TrackSet& track_set);

/// Adds a row if there are handovers. `left_out`: the number of approaches that are left out because of them.
void add_handovers(Summary& summary, const TrackSet& track_set, std::size_t left_out);
/// Precondition: there is a handover.
std::string warning_of_handovers(const TrackSet& track_set, std::size_t left_out);

/// Returns warnings, one line each: ids without a track, pairs that were never looked at, and time that was
/// not, if it is much or if `found_none`, so that "none" is never said without it.
std::vector<std::string> warnings_of(const Coverage& coverage, const TrackSet& track_set, bool found_none);

/// Returns a warning if there are any: that an approach was not found may be because a body had vanished.
std::vector<std::string> warnings_of(const std::vector<Vanishing>& vanishings, const TrackSet& track_set);

// Return members of a JSON object, without its braces.

/// `left_out` as for add_handovers().
std::string json_of_handovers(const TrackSet& track_set, std::size_t left_out);
std::string json_members_of(const Coverage& coverage, const TrackSet& track_set);
std::string json_members_of(const std::vector<Vanishing>& vanishings, const TrackSet& track_set);

}  // namespace kinesphere::program
