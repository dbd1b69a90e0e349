// From the samples of one id to pieces of motion: duplicates, impossible jumps, gaps.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "kinesphere/motion/recorded_tracks.hpp"
#include "tracks/raw_samples.hpp"

namespace kinesphere::program {

/// A sample in seconds and lengths.
struct PlacedSample {
  TrackSample sample;
  Place place;
};

/// Samples of one body, by time, all times different.
using Piece = std::vector<PlacedSample>;

/// Sorts by time and leaves one sample at each time, counting the others. Throws ProgramError naming both
/// rows under DuplicatePolicy::fail.
void leave_one_at_each_time(Piece& samples, const std::string& id, DuplicatePolicy policy,
                            const RawRecording& raw, Tally& duplicates);

/// Sorts the samples into chains that can be travelled at `max_speed`: each sample goes to the chain that
/// was last reached and can reach it. Of chains that overlap in time the one of the most samples stays, as a
/// single wrong position makes a chain of its own, and two bodies under one id make two. Counts the others'
/// samples. Chains come by time.
/// Cost: O(n) chains of which the 8 last reached are looked at.
std::vector<Piece> split_by_speed(const Piece& samples, double max_speed, const RawRecording& raw,
                                  Tally& too_fast);

/// The lower median of the times between consecutive samples; zero where there is none.
double median_interval(std::vector<double> intervals);
void add_intervals(const Piece& piece, std::vector<double>& intervals);

/// Cuts where the time between two samples is longer than `max_gap`, or where one of `breaks` (by time) lies
/// between them or at one of them.
std::vector<Piece> split_at_gaps(const Piece& piece, double max_gap, std::span<const double> breaks);

}  // namespace kinesphere::program
