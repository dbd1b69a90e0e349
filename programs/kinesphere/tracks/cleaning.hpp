// Turns the samples of one id into pieces of motion: handles duplicates, impossible jumps and gaps.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "kinesphere/motion/recorded_tracks.hpp"
#include "tracks/raw_samples.hpp"

namespace kinesphere::program {

/// A sample. Units: seconds, and lengths of the track set's coordinates.
struct PlacedSample {
  TrackSample sample;
  Place place;
  std::optional<double> heading{};  ///< as the file has it
};

/// Samples of one body in order of time; all times differ.
using Piece = std::vector<PlacedSample>;

/// Sorts by time and keeps one sample for each time; counts the dropped ones. Throws ProgramError naming the
/// two rows under DuplicatePolicy::fail.
void leave_one_at_each_time(Piece& samples, const std::string& id, DuplicatePolicy policy,
                            const RawTrackSet& raw, Tally& duplicates);

/// Splits the samples into chains that can be travelled at `max_speed`: each sample joins the most recently
/// extended chain that can reach it. A single wrong position makes a chain of its own, and two bodies under
/// one id make two. If chains overlap in time, the one with the most samples is kept, and samples of the
/// others are counted as dropped. Chains are in order of time. Cost: for each sample, the 8 most recent
/// chains.
std::vector<Piece> split_by_speed(const Piece& samples, double max_speed, const RawTrackSet& raw,
                                  Tally& too_fast);

/// Returns the lower median of the times between consecutive samples; 0 if there is none.
double median_interval(std::vector<double> intervals);
void add_intervals(const Piece& piece, std::vector<double>& intervals);

/// Cuts the piece between two samples more than `max_gap` apart, or if one of `breaks` (sorted) lies at or
/// between them.
std::vector<Piece> split_at_gaps(const Piece& piece, double max_gap, std::span<const double> breaks);

}  // namespace kinesphere::program
