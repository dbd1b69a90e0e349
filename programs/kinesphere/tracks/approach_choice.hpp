// Which approaches of a track set are wanted: a window of time, ids, a smallest duration.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

#include "simulation/tracks/approaches.hpp"
#include "tracks/track_set.hpp"

namespace kinesphere::program {

/// The choice of the command line. Without any of its members all approaches are wanted.
struct ApproachChoice {
  std::string from, until;             ///< times as in the file; empty for those of the track set
  std::vector<std::string> only;       ///< each an id or ids joined by commas
  std::optional<double> min_duration;  ///< seconds
};

/// `choice` must live until the command line has been parsed.
void add_choice_options(CLI::App& command, ApproachChoice& choice);

/// A span of the track set's own seconds.
struct TimeWindow {
  double from = 0.0, until = 0.0;
};

/// Approaches that the choice left out.
struct LeftOut {
  std::size_t by_ids = 0, by_duration = 0;
};

/// A choice that fits a track set.
class ApproachFilter {
 public:
  /// Throws ProgramError naming the option: for a time of another kind than the track set's, a window without
  /// a part of the track set, an id that has no track, a negative duration.
  ApproachFilter(const ApproachChoice& choice, const TrackSet& track_set);

  /// The chosen part of the track set; from < until unless all samples have one time.
  const TimeWindow& window() const { return window_; }
  /// What --from and --until say; infinite where they say nothing.
  const TimeWindow& asked() const { return asked_; }
  /// True if approaches of this id are wanted, with any other.
  bool wants(const Presence& presence) const {
    return only_.empty() || (presence.tracks > 0 && only_[presence.first_track]);
  }
  /// Removes approaches that are not wanted.
  LeftOut apply(std::vector<Approach>& approaches) const;

 private:
  TimeWindow asked_, window_;
  std::vector<bool> only_;  ///< by track; empty for all
  double min_duration_;
};

}  // namespace kinesphere::program
