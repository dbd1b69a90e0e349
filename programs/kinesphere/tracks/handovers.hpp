// Bodies that go on under another id.
#pragma once

#include <cstddef>
#include <vector>

#include "simulation/tracks/approaches.hpp"
#include "tracks/track_set.hpp"

namespace kinesphere::program {

/// Returns the handovers of a track set, by time: an id begins where and when another one ends. Both are
/// there for at most 5 times the median interval of the one that ends, or neither is for at most 2.5 times
/// that. While both are there, they are within half of a step of each other (the mean of the longest of both
/// around that time); or the other one begins as near to where this one would be. They go as fast in the same
/// direction, to within half of a step in an interval. No third body is as near, both have five samples or
/// more there, and each id goes on as one other. Cost: O(ids log ids), O(pairs of ids of which one begins
/// when the other ends), and O(ids) for each handover.
std::vector<Handover> handovers_in(const TrackSet& track_set);

/// Removes the approaches between two ids that are one body, and returns their number.
std::size_t leave_out_handovers(std::vector<Approach>& approaches, const TrackSet& track_set);

}  // namespace kinesphere::program
